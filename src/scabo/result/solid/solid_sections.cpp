#include "scabo/result/solid/solid_sections.hpp"

#include <Eigen/Geometry>
#include <array>
#include <map>

#include "scabo/result/solid/solid_stress.hpp"

namespace scabo::result {

namespace {

using Corners = std::array<int, 4>;

/// The tetrahedra between the nodes of one with 4 or 10 nodes.
const std::vector<Corners>& parts_of(std::size_t nodes) {
  static const std::vector<Corners> whole{{0, 1, 2, 3}}, eight{{0, 4, 6, 7}, {1, 4, 5, 8}, {2, 5, 6, 9}, {3, 7, 8, 9},
                                                               {6, 8, 4, 5}, {6, 8, 5, 9}, {6, 8, 9, 7}, {6, 8, 7, 4}};
  return nodes == 4 ? whole : eight;
}

struct Place {
  Vector lambda;
  Eigen::Vector3d x;
};

Place between(const Place& a, const Place& b, double t) {
  return {(1.0 - t) * a.lambda + t * b.lambda, (1.0 - t) * a.x + t * b.x};
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
    for (const Corners& part : parts_of(cell.size())) {
      std::array<Place, 4> corners;
      std::array<double, 4> heights{};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto node = static_cast<std::size_t>(part[k]);
        corners[k] = {lambda_of(part[k]), mesh.nodes.col(cell[node])};
        heights[k] = height[cell[node]];
      }
      const std::vector<Place> around = cut(corners, heights);
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
      point.lambda = middle.lambda;
      point.x = middle.x;
      points.push_back(point);
    }
  }
  static Vector lambda_of(int node) {
    if (node < 4) return Vector::Unit(4, node);
    const std::array<int, 2>& edge = geometry::SimplexBasis::of(3, 10).edges()[static_cast<std::size_t>(node - 4)];
    return 0.5 * (Vector::Unit(4, edge[0]) + Vector::Unit(4, edge[1]));
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
  std::map<std::size_t, SolidStress> stresses;  // of the bodies
  SolidResultant sum;
  for (const SolidSection::Point& point : section.points) {
    const SolidStress& stress = stresses.try_emplace(point.body, model, increment, point.body).first->second;
    const Eigen::Vector3d force = point.area * (tensor_of(stress.at(point.cell, point.lambda)) * section.normal);
    sum.force += force;
    sum.moment += (point.x - section.about).cross(force);
  }
  return sum;
}

}  // namespace scabo::result
