#include "scabo/model/cad_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <type_traits>

#include "scabo/base/error.hpp"
#include "scabo/files/cad.hpp"
#include "scabo/files/solid_cad.hpp"
#include "scabo/model/cad_frame.hpp"

namespace scabo::model {

namespace {

using Eigen::Vector3d;
using files::SolidCad;

template <class... Each>
struct Overloaded : Each... {
  using Each::operator()...;
};
template <typename... Each>
Overloaded(Each...) -> Overloaded<Each...>;

/// The files of a shape.
void add_files(const AnyShape& shape, std::vector<std::string>& paths) {
  const auto* cad = std::get_if<CadShape>(&shape);
  if (cad == nullptr) return;
  if (const auto* file = std::get_if<CadFile>(cad)) paths.push_back(file->path);
  if (const auto* combined = std::get_if<SolidCombination>(cad))
    for (const SolidOperand& operand : combined->of) add_files(operand.shape, paths);
}

/// 1000 for STEP files, whose lengths become mm; 1 for others; without a file that which makes the largest side of the
/// shape's box 100.
double factor_of(const CadShape& shape, const std::string& file) {
  std::vector<std::string> paths;
  add_files(shape, paths);
  const auto steps = std::count_if(paths.begin(), paths.end(), files::has_unit);
  if (steps > 0 && static_cast<std::size_t>(steps) < paths.size())
    throw InputError(file,
                     {{{}, "STEP files, whose unit is known, cannot be combined with others: write all as STEP"}});
  if (std::any_of(paths.begin(), paths.end(), files::is_stl_file) && !std::holds_alternative<CadFile>(shape))
    throw InputError(file,
                     {{{}, "the triangles of an STL file cannot be combined with other shapes: use a STEP file"}});
  if (!paths.empty()) return steps > 0 ? 1000.0 : 1.0;
  return 100.0 / box_of(shape).sizes().maxCoeff();
}

class Making {
 public:
  explicit Making(SolidCad& cad) : cad_(cad) {}

  SolidCad::Solids made(const AnyShape& shape) {
    return std::visit([this](const auto& of) { return std::visit(*this, of); }, shape);
  }

  SolidCad::Solids operator()(const SolidBox& box) { return cad_.box(box.corner, box.size); }
  SolidCad::Solids operator()(const SolidCylinder& of) { return cad_.cylinder(of.from, of.to, of.radius); }
  SolidCad::Solids operator()(const SolidTube& tube) {
    return cad_.cut(cad_.cylinder(tube.from, tube.to, tube.outer), cad_.cylinder(tube.from, tube.to, tube.inner));
  }
  SolidCad::Solids operator()(const SolidSphere& sphere) {
    const SolidCad::Solids whole = cad_.sphere(sphere.centre, sphere.radius);
    if (sphere.kept == std::array<int, 3>{0, 0, 0}) return whole;
    Vector3d low, size;
    for (int k = 0; k < 3; ++k) {
      const int kept = sphere.kept[static_cast<std::size_t>(k)];
      low[k] = sphere.centre[k] - (kept > 0 ? 0.0 : 2.0 * sphere.radius);
      size[k] = (kept == 0 ? 4.0 : 2.0) * sphere.radius;
    }
    return cad_.common(whole, cad_.box(low, size));
  }
  SolidCad::Solids operator()(const SolidExtrusion& of) {
    const PlaneFrame frame{of.axes};
    return cad_.drawn(loops_of(of.outline, frame, of.from), frame.at({0.0, 0.0}, of.to - of.from));
  }
  SolidCad::Solids operator()(const SolidRevolution& of) {
    const PlaneFrame frame{of.axes};
    const Vector3d from = frame.at(of.from, 0.0), along = frame.at(of.to, 0.0) - from;
    return cad_.turned(loops_of(of.outline, frame, 0.0), from, along.normalized(), of.angle * std::numbers::pi / 180.0);
  }
  SolidCad::Solids operator()(const CadFile& of) {
    return files::is_stl_file(of.path) ? cad_.of_stl(of.path) : cad_.of_file(of.path);
  }
  SolidCad::Solids operator()(const SolidCombination& of) {
    SolidCad::Solids all = made(of.of.front().shape);
    for (std::size_t i = 1; i < of.of.size() && !all.empty(); ++i) {
      const SolidCad::Solids next = made(of.of[i].shape);
      all = of.kind == SolidCombination::Kind::united ? cad_.united(all, next)
            : of.kind == SolidCombination::Kind::cut  ? cad_.cut(all, next)
                                                      : cad_.common(all, next);
    }
    return all;
  }

 private:
  SolidCad& cad_;
};

/// Sides of a side set lie on a face if all their nodes do.
bool lies_on(const files::ImportedSolidMesh& mesh, const files::SolidSideSet& set, const AnyShape& shape,
             const std::string& name, double tolerance) {
  for (const files::SolidSide& side : set.sides)
    for (const int node : files::nodes_of_side(mesh.cells[static_cast<std::size_t>(side.cell)], side.side))
      if (!(distance_to_face(shape, name, mesh.nodes.col(node)) <= tolerance)) return false;
  return true;
}

/// The given names instead of the numbers of faces.
void name_faces(const CadShape& shape, double tolerance, files::ImportedSolidMesh& mesh) {
  std::vector<files::SolidSideSet> named, others;
  const std::vector<std::string> names = face_names(shape);
  for (const std::string& name : names)
    if (std::none_of(named.begin(), named.end(), [&](const auto& set) { return set.name == name; }))
      named.push_back({name, {}});
  for (files::SolidSideSet& set : mesh.side_sets) {
    bool has_name = false;
    for (files::SolidSideSet& face : named) {
      if (!lies_on(mesh, set, shape, face.name, tolerance)) continue;
      face.sides.insert(face.sides.end(), set.sides.begin(), set.sides.end());
      has_name = true;
    }
    if (!has_name) others.push_back({fmt::format("face_{}", others.size() + 1), std::move(set.sides)});
  }
  mesh.side_sets.clear();
  for (auto* sets : {&named, &others})
    for (files::SolidSideSet& set : *sets)
      if (!set.sides.empty()) mesh.side_sets.push_back(std::move(set));
}

}  // namespace

std::vector<std::string> files_of(const CadShape& shape) {
  std::vector<std::string> paths;
  add_files(shape, paths);
  return paths;
}

std::vector<std::string> face_names(const CadShape& shape) {
  return std::visit(Overloaded{[](const CadFile&) { return std::vector<std::string>{}; },
                               [](const SolidRevolution& of) {
                                 std::vector<std::string> names;
                                 if (!of.is_whole()) names = {"start", "end"};
                                 for (const geometry::Edge& edge : of.outline.edges)
                                   names.insert(names.end(), edge.names.begin(), edge.names.end());
                                 return names;
                               },
                               [](const SolidCombination& of) {
                                 std::vector<std::string> names;
                                 for (const SolidOperand& operand : of.of) {
                                   const auto own =
                                       std::visit([](const auto& s) { return face_names(s); }, operand.shape);
                                   for (const std::string& name : own) names.push_back(operand.name + "_" + name);
                                 }
                                 return names;
                               }},
                    shape);
}

files::ImportedSolidMesh divided_cad_shape(const CadShape& shape, const SolidSizes& sizes, const std::string& file) {
  for (const std::string& path : files_of(shape)) files::check_cad_file(path);
  const auto* alone = std::get_if<CadFile>(&shape);
  SolidCad cad(alone != nullptr ? alone->path : file, factor_of(shape, file));
  if (Making(cad).made(shape).empty())
    throw InputError(file, {{{}, "nothing is left of the shapes: see where they lie"}});
  files::SolidCadSizes of;
  of.size = sizes.size;
  for (const SolidSizes::Near& near : sizes.near) of.near.push_back({near.point, near.size, near.growth});
  files::ImportedSolidMesh mesh = cad.mesh(of);
  if (alone != nullptr) return mesh;
  const Vector3d extent = mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff();
  name_faces(shape, 1e-6 * extent.maxCoeff(), mesh);
  return mesh;
}

}  // namespace scabo::model
