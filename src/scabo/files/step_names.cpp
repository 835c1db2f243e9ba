#include "scabo/files/step_names.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <map>
#include <set>

namespace scabo::files {

namespace {

struct StepEntity {
  std::string_view type, arguments;
};

/// `#12 = TYPE(...);` by its number; without complex entities, which have several types.
class StepFile {
 public:
  explicit StepFile(std::string_view text);

  const StepEntity* find(long number) const {
    const auto at = entities_.find(number);
    return at == entities_.end() ? nullptr : &at->second;
  }
  const std::map<long, StepEntity>& entities() const { return entities_; }

 private:
  void add(std::string_view statement);
  std::map<long, StepEntity> entities_;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

StepFile::StepFile(std::string_view text) {
  std::size_t start = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') in_text = !in_text;
    if (in_text || text[i] != ';') continue;
    add(text.substr(start, i - start));
    start = i + 1;
  }
}

void StepFile::add(std::string_view statement) {
  statement = trimmed(statement);
  const std::size_t equal = statement.find('='), open = statement.find('(');
  if (statement.empty() || statement.front() != '#' || equal == std::string_view::npos ||
      open == std::string_view::npos || open < equal || statement.back() != ')')
    return;
  long number = 0;
  const std::string_view digits = trimmed(statement.substr(1, equal - 1));
  if (std::from_chars(digits.data(), digits.data() + digits.size(), number).ec != std::errc()) return;
  entities_[number] = {trimmed(statement.substr(equal + 1, open - equal - 1)),
                       statement.substr(open + 1, statement.size() - open - 2)};
}

/// Numbers of the entities that are named.
std::vector<long> references(std::string_view arguments) {
  std::vector<long> numbers;
  bool in_text = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == '\'') in_text = !in_text;
    if (in_text || arguments[i] != '#') continue;
    long number = 0;
    std::from_chars(arguments.data() + i + 1, arguments.data() + arguments.size(), number);
    numbers.push_back(number);
  }
  return numbers;
}

/// The text that begins the arguments; two apostrophes in it are one.
std::string first_text(std::string_view arguments) {
  std::string text;
  arguments = trimmed(arguments);
  for (std::size_t i = 1; !arguments.empty() && arguments.front() == '\'' && i < arguments.size(); ++i) {
    if (arguments[i] == '\'' && (i + 1 >= arguments.size() || arguments[++i] != '\'')) break;
    text += arguments[i];
  }
  return std::string(trimmed(text));
}

/// `'', (1.0, 2.0, 3.0)`; a number that is none, or too large for one, as it is.
Eigen::Vector3d point_of(std::string_view arguments) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::size_t at = arguments.rfind('(');
  for (int k = 0; k < 3 && at != std::string_view::npos; ++k) {
    point[k] = std::strtod(std::string(arguments.substr(at + 1, 40)).c_str(), nullptr);
    at = arguments.find(',', at + 1);
  }
  return point;
}

/// Place of an entity between a face and its vertices: one only leads to others further down.
int rank_of(std::string_view type) {
  if (type == "FACE_BOUND" || type == "FACE_OUTER_BOUND") return 1;
  if (type == "EDGE_LOOP" || type == "VERTEX_LOOP") return 2;
  if (type == "ORIENTED_EDGE") return 3;
  if (type == "EDGE_CURVE") return 4;
  return type == "VERTEX_POINT" ? 5 : 0;
}

/// Every entity is followed once, whatever circles and repetitions a broken file has. `seen`: those that were followed.
void add_vertices(const StepFile& file, long number, int above, std::set<long>& seen,
                  std::vector<Eigen::Vector3d>& vertices) {
  const StepEntity* entity = file.find(number);
  const int rank = entity == nullptr ? 0 : rank_of(entity->type);
  if (rank <= above || !seen.insert(number).second) return;
  for (const long next : references(entity->arguments)) {
    const StepEntity* point = file.find(next);
    if (rank < 5)
      add_vertices(file, next, rank, seen, vertices);
    else if (point != nullptr && point->type == "CARTESIAN_POINT")
      if (const Eigen::Vector3d at = point_of(point->arguments); at.allFinite()) vertices.push_back(at);
  }
}

/// Of a shell, or of one that is turned over. `seen`: shells and faces that were followed.
void add_faces(const StepFile& file, long shell, std::set<long>& seen, std::vector<StepFace>& faces) {
  const StepEntity* entity = file.find(shell);
  if (entity == nullptr || !seen.insert(shell).second) return;
  if (entity->type == "ORIENTED_CLOSED_SHELL")
    for (const long next : references(entity->arguments)) add_faces(file, next, seen, faces);
  if (entity->type != "CLOSED_SHELL") return;
  for (const long number : references(entity->arguments)) {
    const StepEntity* of = file.find(number);
    if (of == nullptr || (of->type != "ADVANCED_FACE" && of->type != "FACE_SURFACE")) continue;
    if (!seen.insert(number).second) continue;
    std::set<long> of_face;
    faces.push_back({first_text(of->arguments), {}});
    for (const long bound : references(of->arguments)) add_vertices(file, bound, 0, of_face, faces.back().vertices);
  }
}

}  // namespace

std::vector<std::vector<StepFace>> step_solids(std::string_view text) {
  const StepFile file(text);
  std::vector<std::vector<StepFace>> solids;
  for (const auto& [number, entity] : file.entities()) {
    if (entity.type != "MANIFOLD_SOLID_BREP" && entity.type != "BREP_WITH_VOIDS") continue;
    solids.emplace_back();
    std::set<long> seen;
    for (const long shell : references(entity.arguments)) add_faces(file, shell, seen, solids.back());
  }
  return solids;
}

}  // namespace scabo::files
