// Stiffness of a super-element: the textbook route, and the properties that must hold exactly. Published numbers:
// verification/song_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"
#include "theory/textbook_route.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

struct Shape {
  const char* name;
  Ring ring;
  Mat3 D;
};

std::ostream& operator<<(std::ostream& out, const Shape& shape) { return out << shape.name; }

std::vector<Shape> small_shapes() {
  const Mat3 stress = elasticity(10e9, 0.3), strain = elasticity(200e9, 0.25, model::Plane::strain);
  const std::vector<Vec2> skew = {{-0.7, -0.9}, {1.1, -0.6}, {1.4, 0.2}, {0.3, 0.4}, {-0.2, 1.3}, {-1.0, 0.1}};
  return {{"square, order 1", polygon_ring(rectangle(2, 2), 3, 1), stress},
          {"triangle, order 2", polygon_ring(regular_polygon(3, 1.0, 0.4), 2, 2), strain},
          {"rectangle, order 2", rectangle_ring(6, 1.5, 4, 1, 2), stress},
          {"hexagon, order 3", polygon_ring(regular_polygon(6, 0.01, 0.0), 1, 3), strain},
          {"skew, order 1", polygon_ring(skew, 4, 1), stress},
          {"skew, order 2", polygon_ring(skew, 2, 2), strain},
          {"skew, order 4", polygon_ring(skew, 1, 4), stress},
          {"square, order 8", polygon_ring(rectangle(1, 1), 1, 8), stress},
          {"far centre", polygon_ring({{-0.2, -0.15}, {1.8, -0.15}, {1.8, 1.85}, {-0.2, 1.85}}, 2, 2), stress}};
}

class TextbookRoute : public testing::TestWithParam<Shape> {};

TEST_P(TextbookRoute, GivesTheSameStiffnessAndExponents) {
  const auto& [name, ring, D] = GetParam();
  const double thickness = 0.7;
  const auto solution = solve_super_element(ring, D, thickness);
  const TextbookSolution textbook = textbook_route(coefficient_matrices(ring, D, thickness));
  const double error = largest(solution.K - textbook.K) / largest(solution.K);
  RecordProperty("error", testing::PrintToString(error));
  EXPECT_LT(error, 1e-10);
  const auto exponents = modal_solution(solution).exponents;
  ASSERT_EQ(exponents.size(), textbook.exponents.size());
  for (std::size_t i = 0; i < exponents.size(); ++i)
    EXPECT_NEAR(exponents[i].real(), textbook.exponents[i].real(),
                1e-5);  // defective ones move by a root of rounding
}

INSTANTIATE_TEST_SUITE_P(Shapes, TextbookRoute, testing::ValuesIn(small_shapes()));

/// Relative errors of a stiffness in what must hold exactly.
struct StiffnessErrors {
  double asymmetry, rigid, riccati;
};

/// u of the three rigid motions, orthonormal columns.
Matrix rigid_motions(const Ring& ring) {
  Matrix R(static_cast<Eigen::Index>(2 * ring.nodes.size()), 3);
  R.col(0) = at_nodes(ring.nodes, [](const Vec2&) { return Vec2(1, 0); });
  R.col(1) = at_nodes(ring.nodes, [](const Vec2&) { return Vec2(0, 1); });
  R.col(2) = at_nodes(ring.nodes, [](const Vec2& x) { return Vec2(-x.y(), x.x()); });
  return orthonormal_columns(R);
}

/// (K - E1) E0^-1 (K - E1') = E2, from K = E0 S + E1' and the scaled boundary equation.
double riccati_residual(const CoefficientMatrices& matrices, const Matrix& K) {
  const Matrix right = K - Matrix(matrices.E1.transpose());
  return (right.transpose() * solve_cholesky(Matrix(matrices.E0), right) - Matrix(matrices.E2)).norm() /
         matrices.E2.norm();
}

/// K is positive semi-definite with exactly the three rigid motions at zero: K + |K| Q Q' - delta has a
/// Cholesky factor for a delta far above rounding (Sylvester's law of inertia).
bool only_rigid_motions_are_free(const Matrix& K, const Matrix& Q) {
  const double size = largest(K);
  Matrix held = K + size * Q * Q.transpose();
  held.diagonal().array() -= 1e-9 * size;
  return is_positive_definite(held);
}

StiffnessErrors errors_of(const Ring& ring, const Mat3& D) {
  const Matrix K = solve_super_element(ring, D, 1.0).K, Q = rigid_motions(ring);
  EXPECT_TRUE(only_rigid_motions_are_free(K, Q));
  return {(K - K.transpose()).norm() / K.norm(), (K * Q).norm() / (K.norm() * Q.norm()),
          riccati_residual(coefficient_matrices(ring, D, 1.0), K)};
}

void expect_exact(const std::string& what, const Ring& ring, const Mat3& D) {
  SCOPED_TRACE(what);
  const StiffnessErrors errors = errors_of(ring, D);
  EXPECT_LT(errors.asymmetry, 1e-14);
  EXPECT_LT(errors.rigid, 1e-12);
  EXPECT_LT(errors.riccati, 1e-12);
  testing::Test::RecordProperty(what + ": rigid", testing::PrintToString(errors.rigid));
  testing::Test::RecordProperty(what + ": riccati", testing::PrintToString(errors.riccati));
}

const Mat3 concrete = elasticity(10e9, 0.3);

// The paper's beam, 40 to 1280 degrees of freedom in quadratic elements.
TEST(ExactStiffness, SlenderRectangleOfAnySize) {
  for (int n : {40, 80, 160, 320, 640, 1280}) {
    const int nx = n / 10, ny = n / 40;  // 2 (nx + ny) elements of 2 nodes each: 8 (nx + ny) = n
    const Ring ring = rectangle_ring(6.0, 1.5, nx, ny, 2);
    ASSERT_EQ(static_cast<int>(2 * ring.nodes.size()), n);
    expect_exact("n = " + std::to_string(n), ring, concrete);
  }
}

TEST(ExactStiffness, WithoutSymmetryBlocks) {
  for (int n : {40, 160, 640})
    expect_exact("unsplit, n = " + std::to_string(n), unsplit(rectangle_ring(6.0, 1.5, n / 10, n / 40, 2)), concrete);
}

TEST(ExactStiffness, VerySlenderRectangle) {
  expect_exact("1:20", rectangle_ring(20.0, 1.0, 40, 2, 2), concrete);
  expect_exact("20:1", rectangle_ring(1.0, 20.0, 2, 40, 2), concrete);
  expect_exact("1:20, few", rectangle_ring(20.0, 1.0, 4, 1, 2), concrete);
}

TEST(ExactStiffness, NearlyIncompressible) {
  const Mat3 D = elasticity(10e9, 0.4999, model::Plane::strain);
  expect_exact("rectangle", rectangle_ring(6.0, 1.5, 16, 4, 2), D);
  expect_exact("rectangle, unsplit", unsplit(rectangle_ring(6.0, 1.5, 16, 4, 2)), D);
  expect_exact("pentagon", polygon_ring(regular_polygon(5, 1.0, 0.3), 4, 2), D);
}

TEST(ExactStiffness, EveryEdgeOrder) {
  const std::vector<Vec2> skew = {{-0.7, -0.9}, {1.1, -0.6}, {1.4, 0.2}, {0.3, 0.4}, {-0.2, 1.3}, {-1.0, 0.1}};
  for (int order = 1; order <= 8; ++order) {
    expect_exact("rectangle, order " + std::to_string(order), rectangle_ring(6.0, 1.5, 8, 2, order), concrete);
    expect_exact("skew, order " + std::to_string(order), polygon_ring(skew, 2, order), concrete);
  }
}

TEST(SymmetryBlocks, GiveTheStiffnessOfTheUnsplitSuperElement) {
  const std::vector<Vec2> house = {{-1, -1}, {1, -1}, {1, 0.4}, {0, 1.2}, {-1, 0.4}};  // one mirror line
  const std::vector<std::pair<Ring, std::size_t>> rings = {{rectangle_ring(6, 1.5, 8, 2, 2), 4},
                                                           {polygon_ring(rectangle(1, 1), 3, 1), 4},
                                                           {polygon_ring(house, 2, 3), 2},
                                                           {polygon_ring(regular_polygon(5, 1, 0.7), 1, 2), 2},
                                                           {polygon_ring(regular_polygon(8, 1, 0.7), 1, 2), 4}};
  for (const auto& [ring, blocks] : rings) {
    const auto split = solve_super_element(ring, concrete, 1.0);
    const auto whole = solve_super_element(unsplit(ring), concrete, 1.0);
    EXPECT_EQ(split.blocks.size(), blocks);
    EXPECT_EQ(whole.blocks.size(), 1u);
    EXPECT_LT(largest(split.K - whole.K) / largest(whole.K), 1e-13);
  }
}

TEST(SymmetryBlocks, ATurnedRectangleHasTheTurnedStiffness) {
  const Ring ring = rectangle_ring(6, 1.5, 8, 2, 2);
  const double angle = 37.0 * pi / 180.0;
  Mat2 Q;
  Q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  Ring turned = ring;
  for (Vec2& node : turned.nodes) node = Q * node;
  const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
  Matrix turn = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; i += 2) turn.block<2, 2>(i, i) = Q;
  const Matrix K = turn * solve_super_element(ring, concrete, 1.0).K * turn.transpose();
  EXPECT_LT(largest(solve_super_element(turned, concrete, 1.0).K - K) / largest(K), 1e-13);
}

TEST(SuperElement, StiffnessScalesWithModulusAndThicknessAndNotWithSize) {
  const std::vector<Vec2> skew = {{-0.7, -0.9}, {1.1, -0.6}, {1.4, 0.2}, {0.3, 0.4}, {-0.2, 1.3}, {-1.0, 0.1}};
  const Ring ring = polygon_ring(skew, 2, 2);
  Ring small = ring;
  for (Vec2& node : small.nodes) node *= 1e-3;
  const Matrix K = solve_super_element(ring, elasticity(10e9, 0.3), 1.0).K;
  const Matrix scaled = solve_super_element(small, elasticity(10.0, 0.3), 0.25).K;
  EXPECT_LT(largest(K - 4e9 * scaled) / largest(K), 1e-13);
}

}  // namespace
}  // namespace scabo::element
