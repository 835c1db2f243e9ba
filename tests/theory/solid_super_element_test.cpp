// Super-elements in space on the field of a point force outside of a block (Kelvin): more exact than finite elements
// with the same nodes, and by which order.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "scabo/element/space/solid_cell.hpp"
#include "scabo/geometry/facet_basis.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "support/decompositions.hpp"
#include "support/solid_blocks.hpp"

namespace scabo::element {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of a force in a body without end, E = 1.
struct PointForce {
  double poisson;
  Vector3d at{0.4, 0.3, -0.5}, force{0.3, -0.5, 1.0};

  Vector3d displacement(const Vector3d& x) const {
    const Vector3d r = x - at;
    const double R = r.norm(), G = 0.5 / (1.0 + poisson);
    return ((3.0 - 4.0 * poisson) * force / R + r * r.dot(force) / (R * R * R)) /
           (16.0 * std::numbers::pi * G * (1.0 - poisson));
  }
  Vector3d traction(const Vector3d& x, const Vector3d& normal) const {
    const Vector3d r = x - at;
    const double R = r.norm(), rp = r.dot(force);
    const Matrix3d stress = (1.0 - 2.0 * poisson) *
                                (r * force.transpose() + force * r.transpose() - rp * Matrix3d::Identity()) /
                                std::pow(R, 3) +
                            3.0 * rp * r * r.transpose() / std::pow(R, 5);
    return -(stress * normal) / (8.0 * std::numbers::pi * (1.0 - poisson));
  }
};

/// 144 places of a facet.
geometry::FacetRule many_places(std::size_t corners) {
  constexpr int along = 12;
  if (corners == 3) return geometry::triangle_rule(along);
  const geometry::GaussRule line = geometry::gauss_rule(along);
  geometry::FacetRule rule{Matrix(2, along * along), Vector(along * along)};
  for (int i = 0; i < along * along; ++i) {
    const auto k = static_cast<std::size_t>(i % along), j = static_cast<std::size_t>(i / along);
    rule.places.col(i) << line.points[k], line.points[j];
    rule.weights[i] = line.weights[k] * line.weights[j];
  }
  return rule;
}

/// Nodal forces of the tractions, and the energy.
struct Loaded {
  Vector forces;
  double energy = 0.0;
};
Loaded loaded(const mesh::SolidMesh& mesh, const PointForce& field) {
  Loaded of{Vector::Zero(3 * mesh.nodes.cols())};
  for (const mesh::SolidFacet& facet : mesh::boundary_facets(mesh)) {
    const Matrix x = mesh::nodes_of(mesh, facet);
    const auto& basis = geometry::FacetBasis::of(static_cast<int>(facet.size()));
    const geometry::FacetRule rule = many_places(mesh::corners_of(facet));
    for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
      const Vec2 place = rule.places.col(i);
      const Vector N = basis.values(place);
      const Eigen::Matrix<double, 3, 2> tangents = x * basis.derivatives(place);
      const Vector3d area = Vector3d(tangents.col(0)).cross(Vector3d(tangents.col(1))), point = x * N;
      const Vector3d force = rule.weights[i] * area.norm() * field.traction(point, area.normalized());
      of.energy += 0.5 * force.dot(field.displacement(point));
      for (std::size_t k = 0; k < facet.size(); ++k)
        of.forces.segment<3>(3 * facet[k]) += N[static_cast<Eigen::Index>(k)] * force;
    }
  }
  return of;
}

/// The finite element with the same nodes, by 64 points: written out here, as nothing else of Scabo has it.
Matrix brick_stiffness(const Matrix& nodes, const Mat6& D) {
  const mesh::SolidMesh unit = test::solid_block({-1, -1, -1}, {1, 1, 1}, {1, 1, 1}, 20);
  const Matrix places = mesh::nodes_of(unit, unit.cells[0]);
  const auto value = [&](Eigen::Index i, const Vector3d& at) {
    const Vector3d to = places.col(i), plus = (1.0 + to.array() * at.array()).matrix();
    for (int k = 0; k < 3; ++k)
      if (to[k] == 0.0) return 0.25 * (1.0 - at[k] * at[k]) * plus[(k + 1) % 3] * plus[(k + 2) % 3];
    return 0.125 * plus.prod() * (to.dot(at) - 2.0);
  };
  const geometry::GaussRule rule = geometry::gauss_rule(4);
  Matrix K = Matrix::Zero(60, 60);
  for (int point = 0; point < 64; ++point) {
    const auto i = static_cast<std::size_t>(point % 4), j = static_cast<std::size_t>(point / 4 % 4),
               k = static_cast<std::size_t>(point / 16);
    const Vector3d at(rule.points[i], rule.points[j], rule.points[k]);
    Matrix slopes(20, 3);
    constexpr double step = 1e-3;  // of polynomials of degree 2 in each coordinate: exact but for rounding
    for (Eigen::Index n = 0; n < 20; ++n)
      for (int axis = 0; axis < 3; ++axis)
        slopes(n, axis) =
            (value(n, at + step * Vector3d::Unit(axis)) - value(n, at - step * Vector3d::Unit(axis))) / (2.0 * step);
    const Matrix3d J = nodes * slopes;
    const Matrix by_x = slopes * J.inverse();
    Matrix B = Matrix::Zero(6, 60);
    for (Eigen::Index n = 0; n < 20; ++n)
      for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3;
        B(axis, 3 * n + axis) = by_x(n, axis);
        B(3 + axis, 3 * n + axis) = by_x(n, next);
        B(3 + axis, 3 * n + next) = by_x(n, axis);
      }
    K += rule.weights[i] * rule.weights[j] * rule.weights[k] * J.determinant() * (B.transpose() * D * B);
  }
  return K;
}

/// Of the energy norm, relative, of a body whose cells have these stiffnesses.
double error_of(const mesh::SolidMesh& mesh, const PointForce& field, const std::function<Matrix(std::size_t)>& K_of) {
  const Eigen::Index size = 3 * mesh.nodes.cols();
  Matrix K = Matrix::Zero(size, size);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    std::vector<int> dofs;
    for (const int node : mesh.cells[c])
      for (int k = 0; k < 3; ++k) dofs.push_back(3 * node + k);
    K(dofs, dofs) += K_of(c);
  }
  Matrix R = Matrix::Zero(size, 6);  // springs against the rigid motions, which the balanced loads do not feel
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    R.block<3, 3>(3 * i, 0).setIdentity();
    for (int k = 0; k < 3; ++k) R.block<3, 1>(3 * i, 3 + k) = Vector3d::Unit(k).cross(Vector3d(mesh.nodes.col(i)));
  }
  const Loaded load = loaded(mesh, field);
  const Vector balanced = load.forces - R * test::solve_cholesky(R.transpose() * R, R.transpose() * load.forces);
  const Vector u = test::solve_cholesky(K + R * R.transpose(), balanced);
  return std::sqrt(std::max(0.0, 1.0 - 0.5 * balanced.dot(u) / load.energy));
}

TEST(SuperElementsInSpace, AreMoreExactThanFiniteElementsWithTheSameNodes) {
  for (const double poisson : {0.3, 0.49999}) {
    const PointForce field{poisson};
    const Mat6 D = elasticity_in_space(1.0, poisson);
    std::array<double, 2> of_super{}, of_finite{};
    for (const int n : {2, 4}) {
      const mesh::SolidMesh block = test::solid_block({0, 0, 0}, {1, 1, 1}, {n, n, n}, 20);
      const SuperElements solved = solve_super_elements(block, D);
      const std::size_t at = n == 2 ? 0 : 1;
      of_super[at] = error_of(block, field, [&](std::size_t c) { return solved[c]->K(); });
      of_finite[at] = error_of(block, field,
                               [&](std::size_t) { return brick_stiffness(mesh::nodes_of(block, block.cells[0]), D); });
    }
    // Of the second order; those of the finite elements grow where the volume hardly changes.
    EXPECT_GT(std::log2(of_super[0] / of_super[1]), 1.95);
    EXPECT_LT(of_super[1], poisson < 0.4 ? 2.5e-2 : 3.6e-2);
    EXPECT_LT(of_super[0], (poisson < 0.4 ? 0.85 : 0.7) * of_finite[0]);
    EXPECT_LT(of_super[1], (poisson < 0.4 ? 0.8 : 0.45) * of_finite[1]);
  }
}

/// Wedges beside tetrahedra of the same corners.
TEST(SuperElementsInSpace, AreOfTheSecondOrderAlsoAsWedges) {
  const PointForce field{0.3};
  const Mat6 D = elasticity_in_space(1.0, 0.3);
  std::array<double, 2> of_wedges{}, of_tetrahedra{};
  for (const int n : {2, 4}) {
    const mesh::SolidMesh wedges = test::solid_block({0, 0, 0}, {1, 1, 1}, {n, n, n}, 15, 0.1);
    const SuperElements solved = solve_super_elements(wedges, D);
    const std::size_t at = n == 2 ? 0 : 1;
    of_wedges[at] = error_of(wedges, field, [&](std::size_t c) { return solved[c]->K(); });
    const mesh::SolidMesh parts = test::solid_block({0, 0, 0}, {1, 1, 1}, {n, n, n}, 10, 0.1);
    of_tetrahedra[at] = error_of(
        parts, field, [&](std::size_t c) { return tetrahedron_stiffness(mesh::nodes_of(parts, parts.cells[c]), D); });
  }
  EXPECT_GT(std::log2(of_wedges[0] / of_wedges[1]), 1.85);
  EXPECT_LT(of_wedges[0], 0.75 * of_tetrahedra[0]);
  EXPECT_LT(of_wedges[1], 0.6 * of_tetrahedra[1]);
}

}  // namespace
}  // namespace scabo::element
