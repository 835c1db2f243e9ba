#include "scabo/files/split_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scabo/base/cell_topology.hpp"

namespace scabo::files {

namespace {

using Number = std::int64_t;
using Corners = std::vector<std::size_t>;

using Shape = CellTopology;

std::vector<std::array<Number, 3>> triangles_of(std::span<const Number> nodes, const Corners& face) {
  std::vector<Number> ring;
  for (const std::size_t corner : face) ring.push_back(nodes[corner]);
  return triangles_of_facet(std::move(ring));
}

/// Of an edge between two corners of a cell with middle nodes; of one without them there are none.
class Middles {
 public:
  Middles(std::span<const Number> nodes, const Shape& shape, SplitSolid& split)
      : nodes_(nodes), shape_(shape), split_(split) {
    if (nodes.size() == shape.corners) return;
    for (std::size_t e = 0; e < shape.edges.size(); ++e) middle_[edge_at(e)] = nodes[shape.corners + e];
  }

  Number of(Number a, Number b) {
    const auto [at, is_new] = middle_.try_emplace(std::minmax(a, b), 0);
    if (is_new) at->second = added(a, b);
    return at->second;
  }

 private:
  std::pair<Number, Number> edge_at(std::size_t e) const {
    return std::minmax(nodes_[shape_.edges[e][0]], nodes_[shape_.edges[e][1]]);
  }

  /// In the middle of the face that has both, or of the cell.
  Number added(Number a, Number b) {
    Corners face;
    for (const Corners& of : shape_.sides) {
      const auto has = [&](Number n) {
        return std::any_of(of.begin(), of.end(), [&](std::size_t corner) { return nodes_[corner] == n; });
      };
      if (of.size() == 4 && has(a) && has(b)) face = of;
    }
    const bool whole = face.empty();
    for (std::size_t k = 0; whole && k < shape_.corners; ++k) face.push_back(k);
    AddedNode node;
    for (const std::size_t corner : face) node.corners.push_back(nodes_[corner]);
    std::sort(node.corners.begin(), node.corners.end());
    node.ends = {a, b};
    for (std::size_t e = 0; e < shape_.edges.size(); ++e) {
      const auto in = [&](std::size_t corner) { return std::find(face.begin(), face.end(), corner) != face.end(); };
      if (!in(shape_.edges[e][0]) || !in(shape_.edges[e][1])) continue;
      node.edges.push_back({nodes_[shape_.edges[e][0]], nodes_[shape_.edges[e][1]], nodes_[shape_.corners + e]});
    }
    split_.added.push_back(std::move(node));
    return -static_cast<Number>(split_.added.size());
  }

  std::span<const Number> nodes_;
  const Shape& shape_;
  SplitSolid& split_;
  std::map<std::pair<Number, Number>, Number> middle_;
};

}  // namespace

std::optional<std::size_t> nodes_of_split(const std::string& type) {
  for (const std::size_t nodes : {6u, 8u, 15u, 20u}) {
    const std::string name = "C3D" + std::to_string(nodes);
    if (type.rfind(name, 0) == 0 && type.find_first_not_of("RIH", name.size()) == std::string::npos) return nodes;
  }
  return {};
}

std::vector<std::array<Number, 3>> triangles_of_facet(std::vector<Number> ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  std::vector<std::array<Number, 3>> triangles;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    if (ring[0] != ring[k] && ring[k] != ring[k + 1] && ring[0] != ring[k + 1])
      triangles.push_back({ring[0], ring[k], ring[k + 1]});
  return triangles;
}

SplitSolid split_solid(std::span<const Number> nodes) {
  const Shape& shape = Shape::of(nodes.size());
  SplitSolid split;
  Middles middles(nodes, shape, split);
  const Number top = *std::min_element(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(shape.corners));
  for (const Corners& face : shape.sides) {
    if (std::any_of(face.begin(), face.end(), [&](std::size_t corner) { return nodes[corner] == top; })) continue;
    for (const auto& [a, b, c] : triangles_of(nodes, face)) {
      std::vector<Number> cell{a, c, b, top};
      if (nodes.size() > shape.corners)
        for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}})
          cell.push_back(middles.of(cell[static_cast<std::size_t>(i)], cell[static_cast<std::size_t>(j)]));
      split.tetrahedra.push_back(std::move(cell));
    }
  }
  return split;
}

Eigen::Vector3d place_of(const AddedNode& added, const std::function<Eigen::Vector3d(Number)>& at) {
  const bool in_a_face = added.corners.size() == 4;
  const Eigen::Vector3d start = at(added.ends[0]), end = at(added.ends[1]);
  const double size = (end - start).norm();
  constexpr double tolerance = 1e-5;  // as of faces in contact
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  bool straight = true;
  for (const AddedNode::Edge& edge : added.edges) {
    const Eigen::Vector3d middle = at(edge.middle);
    place += (in_a_face ? 0.5 : 0.25) * middle;
    straight = straight && (middle - 0.5 * (at(edge.start) + at(edge.end))).norm() <= tolerance * size;
  }
  std::vector<Eigen::Vector3d> corners;
  for (const std::int64_t corner : added.corners) corners.push_back(at(corner));
  for (const Eigen::Vector3d& corner : corners) place -= 0.25 * corner;
  const bool warped =
      in_a_face && std::abs((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0])) >
                       tolerance * size * size * size;
  return straight && !warped ? 0.5 * (start + end) : place;
}

std::vector<std::vector<Number>> triangles_of_side(std::span<const Number> nodes, int side) {
  const Shape& shape = Shape::of(nodes.size());
  if (side < 1 || side > static_cast<int>(shape.sides.size())) return {};
  std::vector<std::vector<Number>> triangles;
  for (const auto& t : triangles_of(nodes, shape.sides[static_cast<std::size_t>(side - 1)]))
    triangles.push_back({t[0], t[1], t[2]});
  return triangles;
}

}  // namespace scabo::files
