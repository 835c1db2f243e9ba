// The mesh of a SolidCad: its sizes, and the names of solids and faces.
#ifdef SCABO_GMSH
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

#include "scabo/base/error.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/solid_cad_session.hpp"
#include "scabo/files/solid_gmsh.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

using Eigen::Vector3d;

/// The largest distance of two points.
double widest(const std::vector<Vector3d>& points) {
  double width = 0.0;
  for (const Vector3d& a : points)
    for (const Vector3d& b : points) width = std::max(width, (a - b).norm());
  return width;
}

/// Names of volumes are `Shapes/assembly/part`.
std::string last_part(const std::string& name) { return name.substr(name.rfind('/') + 1); }

}  // namespace

/// Regular tetrahedra of the size have 8.5 cells, and so 11.6 quadratic nodes, in a cube of it; 7 of them were counted
/// in cubes and spheres of 10 sizes, as real ones are larger.
void SolidCad::Session::check_count(const SolidCadSizes& sizes) {
  double volume = stl_volume;
  for (const auto& [dimension, tag] : stl_volume > 0.0 ? GmshSession::DimTags{} : session.entities(3)) {
    double mass = 0.0;
    int error = 0;
    solids.mass(dimension, tag, &mass, &error);
    if (error == 0) volume += mass;
  }
  const double nodes = 7.0 * volume / std::pow(sizes.size * factor_, 3);
  if (!(nodes <= most_solid_nodes))
    fail_in_file(session.file(), 0, 0,
                 fmt::format("with 'size' {:g} the mesh would have about {:.2g} nodes, more than the {:.7g} allowed: "
                             "use a larger 'size'",
                             sizes.size, nodes, most_solid_nodes));
}

void SolidCad::Session::set_sizes(const SolidCadSizes& sizes) {
  if (sizes.near.empty()) return;
  std::vector<double> fields;
  int error = 0;
  for (const SolidCadSizes::Near& near : sizes.near) {
    const Vector3d at = scaled(near.point);
    const int field = solids.add_field("MathEval", -1, &error);
    const std::string size = fmt::format(
        "{:.17f} + {:.17f} * Sqrt((x - ({:.17f}))^2 + (y - ({:.17f}))^2 + (z - "
        "({:.17f}))^2)",
        scaled(near.size), near.growth, at.x(), at.y(), at.z());
    solids.set_field_text(field, "F", size.c_str(), &error);
    fields.push_back(field);
  }
  const int least = solids.add_field("Min", -1, &error);
  solids.set_field_numbers(least, "FieldsList", fields.data(), fields.size(), &error);
  solids.use_field(least, &error);
  session.check(error, "Gmsh cannot refine the mesh");
  session.set("Mesh.MeshSizeExtendFromBoundary", 0);
  session.set("Mesh.MeshSizeFromPoints", 0);  // a tenth of the model's size, where none is given
}

std::map<int, std::string> SolidCad::Session::names_of_solids() {
  std::map<int, std::string> names;
  std::set<std::string> taken;
  for (const auto& [dimension, tag] : session.entities(3)) {
    char* text = nullptr;
    int error = 0;
    solids.name(dimension, tag, &text, &error);
    std::string name = error == 0 && text != nullptr ? last_part(text) : "";
    if (text != nullptr) gmsh.free(text);
    if (name.rfind("Open CASCADE STEP translator", 0) == 0) name.clear();  // given by the writer to unnamed parts
    if (name.empty()) name = fmt::format("solid_{}", names.size() + 1);
    const std::string wanted = name;
    for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}_{}", wanted, k);
    names[tag] = name;
  }
  return names;
}

/// Ascending.
std::vector<int> SolidCad::Session::boundary_of(int dimension, int tag, bool points) {
  std::array<int, 2> of{dimension, tag};
  int* values = nullptr;
  std::size_t count = 0;
  int error = 0;
  gmsh.get_boundary(of.data(), 2, &values, &count, 0, 0, points ? 1 : 0, &error);
  std::set<int> tags;
  for (const auto& [of_dimension, other] : session.taken(values, count)) tags.insert(other);
  return {tags.begin(), tags.end()};
}

double SolidCad::Session::width_of(int surface) {
  std::vector<Vector3d> points;
  for (const int point : boundary_of(2, surface, true)) {
    double* at = nullptr;
    std::size_t count = 0;
    int error = 0;
    gmsh.get_value(0, point, nullptr, 0, &at, &count, &error);
    if (error == 0 && count == 3) points.emplace_back(at[0], at[1], at[2]);
    gmsh.free(at);
  }
  return widest(points);
}

/// Whether the widths of all faces, the largest distances of their vertices, have one ratio, whatever the unit of the
/// file and the place of the solid.
bool SolidCad::Session::matches(const std::vector<int>& surfaces, const std::vector<StepFace>& faces) {
  if (surfaces.size() != faces.size()) return false;
  double ratio = 0.0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double here = width_of(surfaces[i]), there = widest(faces[i].vertices);
    if (ratio == 0.0 && here > 0.0) ratio = there / here;
    if (std::abs(there - ratio * here) > 1e-6 * there) return false;
  }
  return true;
}

/// OpenCASCADE keeps the order of the faces of a solid, not always that of the solids.
bool SolidCad::Session::name_faces(std::map<int, std::string>& names) {
  const std::vector<std::vector<StepFace>> of_file = step_solids(bytes_of_file(step_file).value_or(""));
  bool all = true;
  for (const auto& [dimension, tag] : session.entities(3)) {
    const std::vector<int> surfaces = boundary_of(3, tag, false);
    const auto found =
        std::find_if(of_file.begin(), of_file.end(), [&](const auto& faces) { return matches(surfaces, faces); });
    const bool has_names = std::any_of(of_file.begin(), of_file.end(), [](const auto& faces) {
      return std::any_of(faces.begin(), faces.end(), [](const StepFace& face) { return !face.name.empty(); });
    });
    if (found == of_file.end()) all = all && !has_names;
    for (std::size_t i = 0; found != of_file.end() && i < surfaces.size(); ++i)
      if (!(*found)[i].name.empty()) names[surfaces[i]] = (*found)[i].name;
  }
  return all;
}

namespace {

/// The number at the end of `surface_7`; nothing of another name.
std::optional<int> tag_of(const std::string& name, const std::string& kind) {
  if (name.rfind(kind + "_", 0) != 0) return {};
  return std::atoi(name.c_str() + kind.size() + 1);
}

/// Faces without a name are numbered within their solid, by their tags: the number counts all its faces.
std::vector<SolidSideSet> numbered_faces(const ImportedSolidMesh& mesh, const std::map<int, std::string>& names) {
  std::vector<int> solid_of(mesh.cells.size(), 0);
  for (std::size_t s = 0; s < mesh.cell_sets.size(); ++s)
    for (const int cell : mesh.cell_sets[s].cells) solid_of[static_cast<std::size_t>(cell)] = static_cast<int>(s);
  std::map<std::pair<int, int>, std::vector<SolidSide>> sides;  // by solid and tag
  for (const SolidSideSet& set : mesh.side_sets)
    if (const auto tag = tag_of(set.name, "surface"))
      for (const SolidSide& side : set.sides)
        sides[{solid_of[static_cast<std::size_t>(side.cell)], *tag}].push_back(side);
  std::map<int, int> faces_of;
  std::vector<SolidSideSet> numbered;
  for (const auto& [key, of] : sides) {
    const int number = ++faces_of[key.first];
    const auto given = names.find(key.second);
    const std::string name = given == names.end() ? fmt::format("face_{}", number) : given->second;
    auto set =
        std::find_if(numbered.begin(), numbered.end(), [&](const SolidSideSet& one) { return one.name == name; });
    if (set == numbered.end()) set = numbered.insert(set, {name, {}});
    set->sides.insert(set->sides.end(), of.begin(), of.end());
  }
  return numbered;
}

/// Whether the Jacobian of a quadratic cell is not positive at one of its nodes.
bool is_folded(const ImportedSolidMesh& mesh, const ImportedSolidCell& cell) {
  constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  const auto jacobian_at = [&](const Eigen::Vector4d& at) {  // barycentric
    Eigen::Matrix<double, 3, 4> along = Eigen::Matrix<double, 3, 4>::Zero();
    for (int k = 0; k < 4; ++k)
      along.col(k) = (4.0 * at[k] - 1.0) * mesh.nodes.col(cell.nodes[static_cast<std::size_t>(k)]);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto middle = mesh.nodes.col(cell.nodes[4 + e]);
      const auto [a, b] = edges[e];
      along.col(a) += 4.0 * at[b] * middle;
      along.col(b) += 4.0 * at[a] * middle;
    }
    return (along.rightCols<3>().colwise() - along.col(0)).determinant();
  };
  for (int k = 0; k < 4; ++k)
    if (!(jacobian_at(Eigen::Vector4d::Unit(k)) > 0.0)) return true;
  return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return !(jacobian_at(0.5 * (Eigen::Vector4d::Unit(edge[0]) + Eigen::Vector4d::Unit(edge[1]))) > 0.0);
  });
}

bool has_folded_cells(const ImportedSolidMesh& mesh) {
  return std::any_of(mesh.cells.begin(), mesh.cells.end(),
                     [&](const ImportedSolidCell& cell) { return cell.nodes.size() == 10 && is_folded(mesh, cell); });
}

}  // namespace

ImportedSolidMesh SolidCad::mesh(const SolidCadSizes& sizes) {
  Session& of = *session_;
  int error = 0;
  if (of.stl_volume == 0.0) of.solids.synchronize(&error);
  of.session.check(error, "Gmsh cannot use the solid");
  of.check_count(sizes);
  of.set_sizes(sizes);
  const std::map<int, std::string> names = of.names_of_solids();
  double least = sizes.size;
  for (const SolidCadSizes::Near& near : sizes.near) least = std::min(least, near.size);
  of.session.generate(3, of.scaled(least), of.scaled(sizes.size), of.stl_volume > 0.0 ? 1 : 2);
  ImportedSolidMesh mesh = parse_solid_gmsh(of.session.written(true), of.session.file());
  if (has_folded_cells(mesh)) {  // a cell that stays folded is found with its body
    of.solids.optimize("HighOrder", 0, 1, nullptr, 0, &error);
    of.session.forget_errors();
    mesh = parse_solid_gmsh(of.session.written(true), of.session.file());
    mesh.remarks.push_back(
        "a curved face would fold cells of this size, and Gmsh has moved nodes of their edges, not by the same amounts "
        "in every run: a smaller 'size' makes runs repeat to the last digit");
  }
  mesh.nodes /= of.factor();
  mesh.node_sets.clear();
  for (CellSet& set : mesh.cell_sets)
    if (const auto tag = tag_of(set.name, "volume")) set.name = names.at(*tag);
  std::map<int, std::string> names_of_faces;
  const bool told = of.step_file.empty() || of.name_faces(names_of_faces);
  mesh.side_sets = of.stl_volume > 0.0 ? std::vector<SolidSideSet>{} : numbered_faces(mesh, names_of_faces);
  if (!told)
    mesh.remarks.push_back(
        fmt::format("{}: the names of its faces cannot be told apart, as OpenCASCADE has changed "
                    "them: they are face_1, face_2 and so on",
                    of.step_file));
  return mesh;
}

}  // namespace scabo::files
#endif
