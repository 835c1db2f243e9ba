#include "scabo/result/solid/solid_sections.hpp"

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "scabo/base/cell_topology.hpp"
#include "scabo/geometry/facet_basis.hpp"

namespace scabo::result {

namespace {

struct Place {
  PlaceInCell at;
  Eigen::Vector3d x;
  int node = -1;  // of the cell; -1: the centre of a super-element
};
using Part = std::array<Place, 4>;

Vector lambda_of_node(int node) {
  if (node < 4) return Vector::Unit(4, node);
  const std::array<int, 2>& edge = geometry::SimplexBasis::of(3, 10).edges()[static_cast<std::size_t>(node - 4)];
  return 0.5 * (Vector::Unit(4, edge[0]) + Vector::Unit(4, edge[1]));
}

/// The tetrahedra between the nodes of one with 4 or 10 nodes.
std::vector<Part> parts_of_tetrahedron(const Matrix& nodes) {
  using Corners = std::array<int, 4>;
  static const std::vector<Corners> whole{{0, 1, 2, 3}}, eight{{0, 4, 6, 7}, {1, 4, 5, 8}, {2, 5, 6, 9}, {3, 7, 8, 9},
                                                               {6, 8, 4, 5}, {6, 8, 5, 9}, {6, 8, 9, 7}, {6, 8, 7, 4}};
  std::vector<Part> parts;
  for (const Corners& corners : nodes.cols() == 4 ? whole : eight) {
    Part& part = parts.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) part[k] = {{lambda_of_node(corners[k]), -1}, nodes.col(corners[k]), corners[k]};
  }
  return parts;
}

/// Those between the centre of a super-element and the triangles between the nodes of its facets.
std::vector<Part> parts_of_super_element(const Matrix& nodes) {
  using Corners = std::array<int, 3>;
  static const std::vector<Corners> of_triangle{{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}},
      of_square{{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}, {4, 5, 6}, {4, 6, 7}};
  const auto& topology = CellTopology::of(static_cast<std::size_t>(nodes.cols()));
  const Eigen::Vector3d centre = nodes.leftCols(static_cast<Eigen::Index>(topology.corners)).rowwise().mean();
  std::vector<Part> parts;
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    const std::vector<std::size_t> of_side = topology.nodes_of_side(side, true);
    const Matrix& places = geometry::FacetBasis::of(static_cast<int>(of_side.size())).places();
    const auto facet = static_cast<int>(side);
    for (const Corners& corners : of_side.size() == 6 ? of_triangle : of_square) {
      Part& part = parts.emplace_back();
      part[0] = {{Eigen::Vector3d::Zero(), facet}, centre, -1};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto node = static_cast<int>(of_side[static_cast<std::size_t>(corners[k])]);
        part[k + 1] = {{places.col(corners[k]).homogeneous(), facet}, nodes.col(node), node};
      }
    }
  }
  return parts;
}

std::vector<Part> parts_of(const Matrix& nodes) {
  return mesh::is_super_element(static_cast<std::size_t>(nodes.cols())) ? parts_of_super_element(nodes)
                                                                        : parts_of_tetrahedron(nodes);
}

Place between(const Place& a, const Place& b, double t) {
  return {{(1.0 - t) * a.at.lambda + t * b.at.lambda, a.at.facet}, (1.0 - t) * a.x + t * b.x};
}

/// Where a plane cuts a tetrahedron: three or four places around the section, or none. `height` above the plane; a
/// corner in it counts as above.
std::vector<Place> cut(const std::array<Place, 4>& corners, const std::array<double, 4>& height) {
  std::vector<std::size_t> above, below;
  for (std::size_t k = 0; k < 4; ++k) (height[k] >= 0.0 ? above : below).push_back(k);
  const auto crossing = [&](std::size_t a, std::size_t b) {
    return between(corners[a], corners[b], height[a] / (height[a] - height[b]));
  };
  if (above.empty() || below.empty()) return {};
  if (above.size() == 2)
    return {crossing(above[0], below[0]), crossing(above[0], below[1]), crossing(above[1], below[1]),
            crossing(above[1], below[0])};
  const std::vector<std::size_t>&one = above.size() == 1 ? above : below, &three = above.size() == 1 ? below : above;
  return {crossing(one[0], three[0]), crossing(one[0], three[1]), crossing(one[0], three[2])};
}

class Cutting {
 public:
  Cutting(const analysis::SolidModel& model, const model::SpaceSection& section) : model_(model), plane_(section) {}

  void add(std::size_t body) {
    const mesh::SolidMesh& mesh = model_.bodies[body].mesh;
    Vector height = (mesh.nodes.colwise() - plane_.point).transpose() * plane_.normal;
    const double size = (mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff()).norm();
    constexpr double rounding = 1e-9;
    for (double& h : height)
      if (std::abs(h) < rounding * size) h = 0.0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) add_cell(body, c, height);
  }
  std::vector<SolidSection::Point> points;

 private:
  void add_cell(std::size_t body, std::size_t number, const Vector& height) {
    const mesh::SolidMesh& mesh = model_.bodies[body].mesh;
    const std::vector<int>& cell = mesh.cells[number];
    const auto count = static_cast<Eigen::Index>(CellTopology::of(cell.size()).corners);
    const double at_centre = height(cell).head(count).mean();
    for (const Part& part : parts_of(mesh::nodes_of(mesh, cell))) {
      std::array<double, 4> heights{};
      for (std::size_t k = 0; k < 4; ++k)
        heights[k] = part[k].node < 0 ? at_centre : height[cell[static_cast<std::size_t>(part[k].node)]];
      const std::vector<Place> around = cut(part, heights);
      for (std::size_t k = 2; k < around.size(); ++k)
        add_triangle({body, number, {}, {}, 0.0}, {around[0], around[k - 1], around[k]});
    }
  }
  /// By the middles of its sides.
  void add_triangle(SolidSection::Point point, const std::array<Place, 3>& corners) {
    point.area = (corners[1].x - corners[0].x).cross(corners[2].x - corners[0].x).norm() / 6.0;
    if (point.area == 0.0) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const Place middle = between(corners[k], corners[(k + 1) % 3], 0.5);
      point.at = middle.at;
      point.x = middle.x;
      points.push_back(point);
    }
  }

  const analysis::SolidModel& model_;
  const model::SpaceSection& plane_;
};

}  // namespace

SolidSection section_of(const analysis::SolidModel& model, const model::SpaceSection& section) {
  Cutting cutting(model, section);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if ((section.body < 0 || section.body == static_cast<int>(b)) && !model.bodies[b].rigid_at) cutting.add(b);
  SolidSection found{std::move(cutting.points), section.normal, Eigen::Vector3d::Zero()};
  double area = 0.0;
  for (const SolidSection::Point& point : found.points) {
    area += point.area;
    found.about += point.area * point.x;
  }
  found.about = section.about.value_or(area > 0.0 ? Eigen::Vector3d(found.about / area) : Eigen::Vector3d::Zero());
  return found;
}

SolidResultant resultant_of(const analysis::SolidModel& model, const analysis::SolidIncrement& increment,
                            const SolidSection& section) {
  std::optional<SolidStress> stress;
  std::optional<CellField> field;
  SolidResultant sum;
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    const SolidSection::Point &point = section.points[i], &before = section.points[i > 0 ? i - 1 : 0];
    if (increment.is_absent(point.body)) continue;
    if (i == 0 || point.body != before.body) stress.emplace(model, increment, point.body);
    if (i == 0 || point.body != before.body || point.cell != before.cell) field = stress->field_of(point.cell);
    const Eigen::Vector3d force = point.area * (tensor_of(stress->at(point.cell, *field, point.at)) * section.normal);
    sum.force += force;
    sum.moment += (point.x - section.about).cross(force);
  }
  return sum;
}

}  // namespace scabo::result
