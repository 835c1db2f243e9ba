#include "scabo/files/solid_abaqus.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/abaqus_sets.hpp"
#include "scabo/files/number_index.hpp"

namespace scabo::files {

namespace {

/// Nodes of an element type; 0 for one that is not read.
std::size_t nodes_of_solid(const std::string& type) {
  if (type == "C3D4") return 4;
  return type == "C3D10" || type == "C3D10M" ? 10 : 0;
}

/// Elements that bound solids in files of Gmsh, or join nodes.
bool is_not_solid(const std::string& type) {
  for (const char* start : {"CPS", "CPE", "S", "M3D", "T3D", "T2D", "B2", "B3", "DASHPOT", "GAP", "MASS", "DCOUP"})
    if (type.rfind(start, 0) == 0 && type.rfind("SC", 0) != 0) return true;
  return false;
}

class SolidReader {
 public:
  SolidReader(std::string_view text, const std::string& file, const ReadInclude& read_include)
      : builder_(file),
        lines_(text, file, read_include, builder_),
        most_entries_(1'000'000 + 20 * static_cast<std::int64_t>(text.size())) {}

  ImportedSolidMesh read();

 private:
  struct RawCell {
    std::vector<std::int64_t> nodes;
    FilePlace at;
  };
  struct SurfaceEntry {
    std::string of, side;  // element or set
    FilePlace at;
  };
  struct Surface {
    std::string name;
    std::vector<SurfaceEntry> entries;
  };

  void keyword(const AbaqusKeyword& key);
  void nodes(const AbaqusKeyword& key);
  void elements(const AbaqusKeyword& key);
  void set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter);
  void surface(const AbaqusKeyword& key);
  bool next_data(std::vector<std::string_view>& fields);
  std::int64_t integer(std::string_view field, const char* what) const;
  void add(AbaqusSet& target, std::int64_t number);
  void add_all(AbaqusSet& target, std::vector<std::int64_t> numbers);
  void check_numbers(const NumberIndex& numbers, const std::vector<FilePlace>& places, const char* what) const;
  void make_cells(const NumberIndex& nodes, ImportedSolidMesh& mesh) const;
  void make_sets(const NumberIndex& nodes, const NumberIndex& cells, const std::vector<int>& place,
                 ImportedSolidMesh& mesh) const;
  SolidSideSet sides_of(const Surface& surface, const NumberIndex& cells) const;

  MeshBuilder builder_;  // knows the files
  AbaqusLines lines_;
  std::int64_t most_entries_, entries_ = 0;  // of all sets together: sets of sets grow faster than the file
  std::vector<std::int64_t> node_numbers_, cell_numbers_;
  std::vector<FilePlace> node_places_, cell_places_;
  std::vector<double> coordinates_;
  std::vector<RawCell> cells_;
  AbaqusSets node_sets_, element_sets_;
  std::vector<Surface> surfaces_;
  std::vector<std::string> remarks_;
  std::set<std::string> left_out_;  // types
};

bool SolidReader::next_data(std::vector<std::string_view>& fields) {
  do {
    if (!lines_.next_data(fields)) return false;
  } while (fields.empty());
  return true;
}

std::int64_t SolidReader::integer(std::string_view field, const char* what) const {
  std::int64_t value = 0;
  if (!parse_number(field, value)) builder_.fail(lines_.at(), fmt::format("'{}' is not {}", printable(field), what));
  return value;
}

void SolidReader::add(AbaqusSet& target, std::int64_t number) {
  if (++entries_ > most_entries_)
    builder_.fail(lines_.at(), "the sets of the file are too many and too large to be meant");
  target.numbers.push_back(number);
}

void SolidReader::add_all(AbaqusSet& target, std::vector<std::int64_t> numbers) {
  for (const std::int64_t number : numbers) add(target, number);
}

void SolidReader::nodes(const AbaqusKeyword& key) {
  if (key.has("SYSTEM") && upper(key.value("SYSTEM")) != "R")
    builder_.fail(key.at, "coordinates in a cylindrical or spherical SYSTEM are not read; write rectangular ones");
  if (key.has("INPUT")) lines_.insert(key);
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers;
  while (next_data(fields)) {
    numbers.push_back(integer(fields[0], "the number of a node"));
    for (std::size_t k = 1; k <= 3; ++k) {
      double x = 0.0;  // what is not given is zero
      if (k < fields.size() && !fields[k].empty() && !parse_number(fields[k], x))
        builder_.fail(lines_.at(), fmt::format("'{}' is not a coordinate", printable(fields[k])));
      if (!std::isfinite(x))
        builder_.fail(lines_.at(),
                      fmt::format("node {} has a coordinate that is not finite; correct it", numbers.back()));
      coordinates_.push_back(x);
    }
    node_places_.push_back(lines_.at());
  }
  node_numbers_.insert(node_numbers_.end(), numbers.begin(), numbers.end());
  if (key.has("NSET")) add_all(node_sets_.named(key.value("NSET")), std::move(numbers));
}

void SolidReader::elements(const AbaqusKeyword& key) {
  const std::string type = upper(key.value("TYPE"));
  if (type.empty()) builder_.fail(key.at, "*ELEMENT has no TYPE; write for example TYPE=C3D10");
  const std::size_t wanted = nodes_of_solid(type);
  if (wanted == 0 && !is_not_solid(type))
    builder_.fail(key.at, fmt::format("elements of type {} are not read; use tetrahedra, C3D4 or C3D10, and take "
                                      "others out of the file",
                                      printable(type)));
  if (wanted == 0 && left_out_.insert(type).second)
    remarks_.push_back(fmt::format("{}:{}: elements of type {} are no solids and are left out", builder_.file(key.at),
                                   key.at.line, printable(type)));
  if (key.has("INPUT")) lines_.insert(key);
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers;
  while (next_data(fields)) {
    if (wanted == 0) continue;
    RawCell cell{{}, lines_.at()};
    const std::int64_t number = integer(fields[0], "the number of an element");
    for (std::size_t first = 1; true; first = 0) {
      for (std::size_t i = first; i < fields.size(); ++i)
        cell.nodes.push_back(integer(fields[i], "the number of a node"));
      if (cell.nodes.size() >= wanted || !next_data(fields)) break;
    }
    if (cell.nodes.size() != wanted)
      builder_.fail(cell.at, fmt::format("cell {} has {} nodes, but type {} has {}; correct the type or the line",
                                         number, cell.nodes.size(), type, wanted));
    numbers.push_back(number);
    cell_places_.push_back(cell.at);
    cells_.push_back(std::move(cell));
  }
  cell_numbers_.insert(cell_numbers_.end(), numbers.begin(), numbers.end());
  if (key.has("ELSET") && wanted > 0) add_all(element_sets_.named(key.value("ELSET")), std::move(numbers));
}

void SolidReader::set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter) {
  const std::string name = key.value(parameter);
  if (name.empty())
    builder_.fail(key.at, fmt::format("*{} has no name; write *{}, {}=name", parameter, parameter, parameter));
  if (key.has("INPUT")) lines_.insert(key);
  sets.named(name);
  std::vector<std::string_view> fields;
  while (next_data(fields)) {
    if (key.has("GENERATE")) {
      const std::int64_t first = integer(fields[0], "the first number of GENERATE");
      const std::int64_t last = fields.size() > 1 ? integer(fields[1], "the last number of GENERATE") : first;
      const std::int64_t step = fields.size() > 2 ? integer(fields[2], "the increment of GENERATE") : 1;
      if (first < 0 || last < first || step < 1)
        builder_.fail(lines_.at(),
                      "GENERATE needs a first number, a last one that is not smaller, and a positive increment");
      for (std::int64_t k = 0; k <= (last - first) / step; ++k) add(sets.named(name), first + k * step);
      continue;
    }
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      const std::string entry = without_quotes(field);
      std::int64_t number = 0;
      if (parse_number(std::string_view(entry), number)) {
        add(sets.named(name), number);
      } else if (const AbaqusSet* other = sets.find(entry)) {
        add_all(sets.named(name), std::vector(other->numbers));
      } else {
        builder_.fail(lines_.at(),
                      fmt::format("'{}' is neither a number nor the name of a set before this line", printable(field)));
      }
    }
  }
}

void SolidReader::surface(const AbaqusKeyword& key) {
  const std::string name = key.value("NAME"), type = upper(key.value("TYPE"));
  if (name.empty()) builder_.fail(key.at, "*SURFACE has no name; write *SURFACE, NAME=name");
  if (!type.empty() && type != "ELEMENT") {
    remarks_.push_back(fmt::format("{}:{}: the surface '{}' of TYPE={} has no sides of cells and is left out",
                                   builder_.file(key.at), key.at.line, printable(name), printable(type)));
    return;
  }
  surfaces_.push_back({name, {}});
  std::vector<std::string_view> fields;
  while (next_data(fields))
    surfaces_.back().entries.push_back(
        {without_quotes(fields[0]), fields.size() > 1 ? upper(fields[1]) : std::string(), lines_.at()});
}

void SolidReader::keyword(const AbaqusKeyword& key) {
  if (key.name == "NODE") return nodes(key);
  if (key.name == "ELEMENT") return elements(key);
  if (key.name == "NSET") return set(key, node_sets_, "NSET");
  if (key.name == "ELSET") return set(key, element_sets_, "ELSET");
  if (key.name == "SURFACE") return surface(key);
  for (const char* assembly : {"PART", "INSTANCE"})
    if (key.name == assembly)
      builder_.fail(key.at,
                    "parts and instances of solids are not read; save the mesh without them, a file for a body");
  for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"})
    if (key.name == maker)
      builder_.fail(key.at, fmt::format("{} makes nodes or elements and is not read; write them out", key.written));
}

void SolidReader::check_numbers(const NumberIndex& numbers, const std::vector<FilePlace>& places,
                                const char* what) const {
  if (!numbers.repeated()) return;
  const auto [first, second] = *numbers.repeated();
  builder_.fail(places[static_cast<std::size_t>(second)],
                fmt::format("this number is also that of the {} in line {}; number every one differently", what,
                            places[static_cast<std::size_t>(first)].line));
}

void SolidReader::make_cells(const NumberIndex& nodes, ImportedSolidMesh& mesh) const {
  const Eigen::Map<const Matrix> x(coordinates_.data(), 3, static_cast<Eigen::Index>(node_numbers_.size()));
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    ImportedSolidCell cell{{}, static_cast<long>(cell_numbers_[c])};
    for (const std::int64_t number : cells_[c].nodes) {
      const int node = nodes.find(number);
      if (node < 0)
        builder_.fail(cells_[c].at, fmt::format("cell {} has the node {}, which the file does not contain; correct the "
                                                "number or add the node",
                                                cell.number, number));
      cell.nodes.push_back(node);
    }
    const Eigen::Vector3d start = x.col(cell.nodes[0]), a = x.col(cell.nodes[1]) - start,
                          b = x.col(cell.nodes[2]) - start, along = x.col(cell.nodes[3]) - start;
    const double size = std::max({a.norm(), b.norm(), along.norm()});
    if (!(a.cross(b).dot(along) > 1e-12 * size * size * size))
      builder_.fail(cells_[c].at,
                    fmt::format("cell {} is flat or turned over: seen from node 4, the nodes 1, 2, 3 must "
                                "be counter-clockwise; write the mesh again",
                                cell.number));
    mesh.cells.push_back(std::move(cell));
  }
}

SolidSideSet SolidReader::sides_of(const Surface& surface, const NumberIndex& cells) const {
  SolidSideSet set{surface.name, {}};
  std::set<std::pair<int, int>> known;
  for (const SurfaceEntry& entry : surface.entries) {
    const bool is_side = entry.side.size() == 2 && entry.side[0] == 'S' && entry.side[1] >= '1' && entry.side[1] <= '4';
    if (!is_side)
      builder_.fail(entry.at, fmt::format("surface '{}': '{}' is no side of a tetrahedron; write S1, S2, S3 or S4",
                                          printable(surface.name), printable(entry.side)));
    std::vector<std::int64_t> numbers(1, 0);
    if (!parse_number(std::string_view(entry.of), numbers[0])) {
      const AbaqusSet* of = element_sets_.find(entry.of);
      if (of == nullptr)
        builder_.fail(entry.at, fmt::format("surface '{}': there is no element set '{}'; correct its name",
                                            printable(surface.name), printable(entry.of)));
      numbers = of->numbers;
    }
    for (const std::int64_t number : numbers) {
      const SolidSide side{cells.find(number), entry.side[1] - '1'};
      if (side.cell < 0)
        builder_.fail(entry.at, fmt::format("surface '{}': there is no cell {}; correct its number",
                                            printable(surface.name), number));
      if (known.emplace(side.cell, side.side).second) set.sides.push_back(side);
    }
  }
  return set;
}

/// `place`: of each node of the file, its index in the mesh; -1 without a cell.
void SolidReader::make_sets(const NumberIndex& nodes, const NumberIndex& cells, const std::vector<int>& place,
                            ImportedSolidMesh& mesh) const {
  for (const AbaqusSet& set : node_sets_.all()) {
    std::set<int> kept;
    for (const std::int64_t number : set.numbers)
      if (const int node = nodes.find(number); node >= 0 && place[static_cast<std::size_t>(node)] >= 0)
        kept.insert(place[static_cast<std::size_t>(node)]);
    if (!kept.empty()) mesh.node_sets.push_back({set.name, {kept.begin(), kept.end()}});
  }
  for (const AbaqusSet& set : element_sets_.all()) {
    std::set<int> kept;
    for (const std::int64_t number : set.numbers)
      if (const int cell = cells.find(number); cell >= 0) kept.insert(cell);
    if (!kept.empty()) mesh.cell_sets.push_back({set.name, {kept.begin(), kept.end()}});
  }
  for (const Surface& surface : surfaces_)
    if (SolidSideSet set = sides_of(surface, cells); !set.sides.empty()) mesh.side_sets.push_back(std::move(set));
}

ImportedSolidMesh SolidReader::read() {
  AbaqusKeyword key;
  while (lines_.next_keyword(key)) keyword(key);
  if (cells_.empty())
    fail_in_file(builder_.file({}), 0, 0, "the file has no solid elements; save the mesh with C3D4 or C3D10 elements");
  const NumberIndex nodes(node_numbers_), cells(cell_numbers_);
  check_numbers(nodes, node_places_, "node");
  check_numbers(cells, cell_places_, "cell");
  ImportedSolidMesh mesh;
  make_cells(nodes, mesh);
  std::vector<int> place(node_numbers_.size(), -1);
  for (const ImportedSolidCell& cell : mesh.cells)
    for (const int node : cell.nodes) place[static_cast<std::size_t>(node)] = 0;
  int count = 0;
  for (int& at : place)
    if (at == 0) at = count++;
  mesh.nodes.resize(3, count);
  for (std::size_t i = 0; i < place.size(); ++i)
    for (Eigen::Index k = 0; place[i] >= 0 && k < 3; ++k)
      mesh.nodes(k, place[i]) = coordinates_[3 * i + static_cast<std::size_t>(k)];
  for (ImportedSolidCell& cell : mesh.cells)
    for (int& node : cell.nodes) node = place[static_cast<std::size_t>(node)];
  make_sets(nodes, cells, place, mesh);
  mesh.remarks = remarks_;
  return mesh;
}

}  // namespace

ImportedSolidMesh parse_solid_abaqus(std::string_view text, const std::string& file, const ReadInclude& read_include) {
  return SolidReader(text, file, read_include).read();
}

}  // namespace scabo::files
