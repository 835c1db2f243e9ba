#include "scabo/mesh/extruded_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scabo/base/cell_topology.hpp"
#include "scabo/mesh/plane/many_cells.hpp"

namespace scabo::mesh {

namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;  // corners in the plane, the smaller number first

Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<double> layers_of(const model::SolidExtrusion& extrusion, const model::SolidSizes& sizes) {
  std::vector<SizeAt> near;
  for (const model::SolidSizes::Near& of : sizes.near)
    near.push_back({of.point[extrusion.axes[2]], of.size, of.growth});
  return divided(extrusion.from, extrusion.to, sizes.size, near, 1);
}

/// A node of the plane and a level: even on the lines between layers, odd in their middles.
struct Place {
  int node = -1, level = 0;
  bool operator<(const Place& other) const { return std::pair(level, node) < std::pair(other.level, other.node); }
};

class Extruding {
 public:
  Extruding(const model::SolidExtrusion& extrusion, std::vector<double> layers, const BodyMesh& plane, bool wedges);
  ShapedSolid made();

 private:
  void add_prism(std::array<int, 3> triangle, int layer);
  void add_cell(std::vector<Place> corners);
  void add_to_faces(const std::vector<Place>& corners, const SolidFacet& facet);
  Place middle(const Place& a, const Place& b) const;
  Vector3d position(const Place& at) const;
  int node(const Place& at);

  const model::SolidExtrusion& extrusion_;
  std::vector<double> layers_;
  const BodyMesh& plane_;
  bool wedges_;
  int top_;
  std::map<Edge, int> middles_;        // nodes in the middle of edges
  std::map<Edge, std::size_t> edges_;  // those of the outline, and the edges of it that they are part of
  std::map<Place, int> numbers_;
  std::vector<Vector3d> positions_;
  ShapedSolid made_;
};

Extruding::Extruding(const model::SolidExtrusion& extrusion, std::vector<double> layers, const BodyMesh& plane,
                     bool wedges)
    : extrusion_(extrusion),
      layers_(std::move(layers)),
      plane_(plane),
      wedges_(wedges),
      top_(2 * (static_cast<int>(layers_.size()) - 1)) {
  for (const Cell& cell : plane.cells)
    for (const LineElement& side : cell.boundary)
      middles_[edge_of(side.nodes.front(), side.nodes.back())] = side.nodes[1];
  for (std::size_t e = 0; e < plane.edges.size(); ++e)
    for (const LineElement& side : plane.edges[e]) edges_[edge_of(side.nodes.front(), side.nodes.back())] = e;
}

Place Extruding::middle(const Place& a, const Place& b) const {
  return {a.node == b.node ? a.node : middles_.at(edge_of(a.node, b.node)), (a.level + b.level) / 2};
}

Vector3d Extruding::position(const Place& at) const {
  const auto below = static_cast<std::size_t>(at.level / 2);
  const Vec2& x = plane_.nodes[static_cast<std::size_t>(at.node)];
  Vector3d made;
  made[extrusion_.axes[0]] = x.x();
  made[extrusion_.axes[1]] = x.y();
  made[extrusion_.axes[2]] = at.level % 2 == 0 ? layers_[below] : 0.5 * (layers_[below] + layers_[below + 1]);
  return made;
}

int Extruding::node(const Place& at) {
  const auto [found, is_new] = numbers_.try_emplace(at, static_cast<int>(positions_.size()));
  if (is_new) positions_.push_back(position(at));
  return found->second;
}

void Extruding::add_to_faces(const std::vector<Place>& corners, const SolidFacet& facet) {
  for (const int level : {0, top_})
    if (std::all_of(corners.begin(), corners.end(), [&](const Place& c) { return c.level == level; }))
      made_.faces[level == 0 ? "start" : "end"].push_back(facet);
  int first = corners[0].node, second = first;
  for (const Place& corner : corners) {
    if (corner.node == first || corner.node == second) continue;
    if (second != first) return;  // three nodes of the plane
    second = corner.node;
  }
  if (const auto edge = edges_.find(edge_of(first, second)); edge != edges_.end())
    for (const std::string& name : extrusion_.outline.edges[edge->second].names) made_.faces[name].push_back(facet);
}

/// Corners as in CellTopology, or turned over.
void Extruding::add_cell(std::vector<Place> corners) {
  const bool is_wedge = corners.size() == 6;
  const auto& topology = CellTopology::of(corners.size());
  const Vector3d x0 = position(corners[0]);
  Eigen::Matrix3d sides;
  for (int k = 0; k < 3; ++k) sides.col(k) = position(corners[static_cast<std::size_t>(k + 1)]) - x0;
  if (sides.determinant() < 0.0) {
    if (is_wedge)
      std::swap_ranges(corners.begin(), corners.begin() + 3, corners.begin() + 3);
    else
      std::swap(corners[2], corners[3]);
  }
  std::vector<int> cell;
  for (const Place& corner : corners) cell.push_back(node(corner));
  for (const auto& [a, b] : topology.edges) cell.push_back(node(middle(corners[a], corners[b])));
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    std::vector<Place> of_side;
    for (const std::size_t corner : topology.sides[side]) of_side.push_back(corners[corner]);
    add_to_faces(of_side, facet_of(cell, static_cast<int>(side)));
  }
  made_.mesh.cells.push_back(std::move(cell));
}

void Extruding::add_prism(std::array<int, 3> triangle, int layer) {
  const int below = 2 * layer, above = below + 2;
  if (!wedges_) std::sort(triangle.begin(), triangle.end());
  const auto [i, j, k] = triangle;
  if (wedges_) return add_cell({Place{i, below}, {j, below}, {k, below}, {i, above}, {j, above}, {k, above}});
  add_cell({Place{i, below}, {j, below}, {k, below}, {k, above}});
  add_cell({Place{i, below}, {j, below}, {j, above}, {k, above}});
  add_cell({Place{i, below}, {i, above}, {j, above}, {k, above}});
}

ShapedSolid Extruding::made() {
  for (const std::string& name : model::face_names(extrusion_)) made_.faces[name];
  for (int layer = 0; 2 * layer < top_; ++layer)
    for (const Cell& cell : plane_.cells)
      add_prism({cell.boundary[0].nodes.front(), cell.boundary[1].nodes.front(), cell.boundary[2].nodes.front()},
                layer);
  made_.mesh.nodes.resize(3, static_cast<Eigen::Index>(positions_.size()));
  for (std::size_t i = 0; i < positions_.size(); ++i)
    made_.mesh.nodes.col(static_cast<Eigen::Index>(i)) = positions_[i];
  return std::move(made_);
}

}  // namespace

double count_nodes(const model::SolidExtrusion& extrusion, const model::SolidSizes& sizes) {
  const double triangles = 4.0 / std::numbers::sqrt3 * extrusion.outline.area() / (sizes.size * sizes.size);
  const double nodes = 2.0 * triangles + 4.0, corners = 0.25 * nodes,
               layers = static_cast<double>(layers_of(extrusion, sizes).size()) - 1.0;
  return (layers + 1.0) * nodes + layers * (sizes.hexahedra ? corners : nodes);
}

std::variant<ShapedSolid, Diagnostic> extruded_solid(const model::SolidExtrusion& extrusion,
                                                     const model::SolidSizes& sizes, double most_nodes) {
  std::vector<double> layers = layers_of(extrusion, sizes);
  model::Body body;
  body.material = 0;
  body.outline = extrusion.outline;
  body.outline.rectangle = false;  // triangles
  body.mesh.kind = model::MeshKind::fem;
  body.mesh.size = sizes.size;
  for (const model::SolidSizes::Near& of : sizes.near) {
    model::LocalSize local;
    local.near = Vec2(of.point[extrusion.axes[0]], of.point[extrusion.axes[1]]);
    local.size = of.size;
    local.growth = of.growth;
    body.mesh.refine.push_back(local);
  }
  auto plane = divide_into_cells(body, {}, most_nodes / (2.0 * static_cast<double>(layers.size()) - 1.0));
  if (auto* wrong = std::get_if<Diagnostic>(&plane)) return std::move(*wrong);
  return Extruding(extrusion, std::move(layers), std::get<BodyMesh>(plane), sizes.hexahedra).made();
}

}  // namespace scabo::mesh
