// Points condensed to the boundary: the rows N and B against the field itself, and where they are known in closed form.
#include "scabo/element/plane/point_operator.hpp"

#include <gtest/gtest.h>

#include "scabo/element/sbfem/radial_table.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

std::vector<ScaledPoint> points_of(const Ring& ring, std::mt19937& random) {
  std::vector<ScaledPoint> points;
  for (const double xi : {0.0, 1e-6, 0.01, 0.3, 0.7, 0.97, 1.0})
    points.push_back({xi, whole(random, 0, static_cast<int>(ring.elements.size()) - 1), uniform(random, -1.0, 1.0)});
  return points;
}

/// Against RadialField, for random boundary displacements: no theory in common but S and A.
void expect_the_field(const Ring& ring, const Mat3& D, std::mt19937& random) {
  const auto solution = solve_super_element(ring, D, 0.7);
  const ModalSolution modal = modal_solution(solution);
  const PointCondensation condensation(ring, solution);
  const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
  const Vector u = Vector::NullaryExpr(n, [&] { return uniform(random, -1.0, 1.0); });
  const RadialField field(solution, modal, u, {});
  for (const ScaledPoint& point : points_of(ring, random)) {
    const PointOperator rows = condensation.at(point);
    const PointValues values = point_values(ring, field.at(point.xi), D, point.element, point.eta);
    EXPECT_LT((rows.N * u - values.displacement).norm(), 1e-11) << "xi = " << point.xi;
    const double scale = rows.B.norm() * u.norm();
    EXPECT_LT((rows.B * u - values.strain).norm(), 1e-11 * scale) << "xi = " << point.xi;
  }
}

TEST(PointOperator, GivesTheFieldOfRandomBoundaryDisplacements) {
  std::mt19937 random(7);
  for (int k = 0; k < 10; ++k) {
    const Ring ring = polygon_ring(random_star(random), whole(random, 1, 2), whole(random, 1, 4));
    expect_the_field(ring, random_elasticity(random), random);
  }
}

TEST(PointOperator, GivesTheFieldWhereSymmetriesSplitTheSuperElement) {
  std::mt19937 random(8);
  expect_the_field(rectangle_ring(6.0, 1.5, 8, 2, 2), elasticity(1.0, 0.3), random);
  expect_the_field(polygon_ring(regular_polygon(6, 1.0, 0.0), 2, 3), elasticity(1.0, 0.49), random);
}

TEST(PointOperator, RigidMotionsAndLinearFieldsAreExactAtEveryPoint) {
  std::mt19937 random(9);
  const Ring ring = polygon_ring(random_star(random), 3, 2);
  const auto solution = solve_super_element(ring, elasticity(2.0, 0.3), 1.0);
  const PointCondensation condensation(ring, solution);
  const Mat2 G = (Mat2() << 0.3, -0.7, 0.2, 0.5).finished();
  const Vec2 shift(2.0, -1.0);
  const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return Vec2(G * x + shift); });
  for (const ScaledPoint& point : points_of(ring, random)) {
    const PointOperator rows = condensation.at(point);
    const Vec2 x = point.xi * boundary_position(ring, point.element, point.eta);
    EXPECT_LT((rows.N * u - (G * x + shift)).norm(), 1e-11);
    EXPECT_LT((rows.B * u - Vec3(0.3, 0.5, -0.5)).norm(), 1e-9) << "xi = " << point.xi;
  }
}

TEST(PointOperator, ManyPointsOnThreadsAreTheSame) {
  std::mt19937 random(10);
  const Ring ring = polygon_ring(random_star(random), 2, 2);
  const auto solution = solve_super_element(ring, elasticity(2.0, 0.3), 1.0);
  const PointCondensation condensation(ring, solution);
  const std::vector<ScaledPoint> points = points_of(ring, random);
  const std::vector<PointOperator> rows = condensation.at(points, 3);
  ASSERT_EQ(rows.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(rows[i].N, condensation.at(points[i]).N);
    EXPECT_EQ(rows[i].B, condensation.at(points[i]).B);
  }
}

TEST(RadialTable, MeetsTheFieldToRounding) {
  std::mt19937 random(12);
  for (const int n : {1, 4, 12}) {
    const Ring ring = rectangle_ring(6.0, 1.5, 4 * n, n, 2);
    const auto solution = solve_super_element(ring, elasticity(1.0, 0.3), 1.0);
    const ModalSolution modal = modal_solution(solution);
    const auto size = static_cast<Eigen::Index>(2 * ring.nodes.size());
    const Vector u = Vector::NullaryExpr(size, [&] { return uniform(random, -1.0, 1.0); });
    const RadialField field(solution, modal, u, {});
    const RadialTable table(field, fastest_of(modal));
    for (int k = 0; k < 60; ++k) {
      const double xi = k < 20 ? 1.0 - std::pow(10.0, -0.25 * k) : uniform(random, 0.0, 1.0);
      const auto exact = field.at(xi), found = table.at(xi);
      EXPECT_LT(largest(exact.u - found.u), 1e-12 * largest(u)) << xi;
      EXPECT_LT(largest(exact.u_part - found.u_part), 1e-12 * largest(exact.u_part) + 1e-12) << xi;
      EXPECT_LT(largest(exact.u_xi - found.u_xi), 1e-11 * fastest_of(modal)) << xi;
    }
  }
}

/// A crack seen from its tip: exponents of 1/2, strains like xi^(-1/2).
TEST(PointOperator, HoldsForExponentsBelowOne) {
  std::mt19937 random(11);
  Ring ring = polygon_ring({{1, 0}, {1, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {1, -1}}, 2, 2);
  // Opened at (-1, 0): the last element ends in a node of its own.
  std::rotate(ring.elements.begin(), ring.elements.begin() + 6, ring.elements.end());
  ring.elements.back().nodes.back() = static_cast<int>(ring.nodes.size());
  ring.nodes.push_back(ring.nodes[static_cast<std::size_t>(ring.elements.front().nodes.front())]);
  const auto solution = solve_super_element(ring, elasticity(1.0, 0.3), 1.0);
  const PointCondensation condensation(ring, solution);
  const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
  const Vector u = Vector::NullaryExpr(n, [&] { return uniform(random, -1.0, 1.0); });
  // Strain is the gradient of displacement: central differences, one element, well inside.
  for (const double xi : {0.05, 0.4, 0.8}) {
    const ScaledPoint point{xi, 3, 0.2};
    const Vec2 x = xi * boundary_position(ring, point.element, point.eta);
    const double h = 1e-5 * xi;
    const auto displacement = [&](const Vec2& at) { return Vec2(condensation.at(*locate(ring, at)).N * u); };
    const Vec2 along_x = (displacement(x + Vec2(h, 0)) - displacement(x - Vec2(h, 0))) / (2 * h);
    const Vec2 along_y = (displacement(x + Vec2(0, h)) - displacement(x - Vec2(0, h))) / (2 * h);
    const Vec3 strain = condensation.at(point).B * u;
    EXPECT_LT((strain - Vec3(along_x.x(), along_y.y(), along_x.y() + along_y.x())).norm(), 1e-6 * strain.norm());
  }
  // Differences are free of the uniform strain: what is left grows like xi^(lambda - 1), with the two exponents near
  // 1/2.
  const ModalSolution modal = modal_solution(solution);
  const double mode_1 = modal.exponents[2].real(), mode_2 = modal.exponents[3].real();  // after the translations
  EXPECT_NEAR(mode_1, 0.5, 1e-3);
  EXPECT_NEAR(mode_2, 0.5, 1e-3);
  const auto strain_at = [&](double xi) { return Vec3(condensation.at({xi, 3, 0.2}).B * u); };
  const double farther = (strain_at(1e-6) - strain_at(1e-4)).norm(),
               nearer = (strain_at(1e-8) - strain_at(1e-6)).norm();
  EXPECT_GT(nearer / farther, std::pow(100.0, 1.0 - mode_2) - 1e-5);
  EXPECT_LT(nearer / farther, std::pow(100.0, 1.0 - mode_1) + 1e-5);
}

}  // namespace
}  // namespace scabo::element
