// Against LU in double precision: flexibilities of points along a line, and matrices for which it does not pay.
#include "scabo/linalg/hierarchical_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "support/decompositions.hpp"

namespace scabo::linalg {
namespace {

/// Points of an elastic half-plane, two components each, as a contact has them: logarithms along the diagonal of the
/// components, the sign of the distance between them; every fifth row weighs half, and normal columns contain the
/// tangential ones as where pairs slip, to one side in the first half of them and to the other in the second.
Matrix half_plane(int points, const std::vector<int>& order) {
  const double end = points + 1.0;
  Matrix A(2 * points, 2 * points);
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      const double x = order[static_cast<std::size_t>(i)] - order[static_cast<std::size_t>(j)];
      const double direct = (std::log(end / (std::abs(x) + 0.3))) / 3.0, across = x == 0.0 ? 0.0 : x > 0.0 ? 0.1 : -0.1;
      const double slip = 2 * order[static_cast<std::size_t>(j)] < points ? 0.3 : -0.3;
      const double weight = i % 5 == 0 ? 0.5 : 1.0;
      A(2 * i, 2 * j) = weight * (direct + slip * across);
      A(2 * i + 1, 2 * j) = weight * (-across + slip * direct);
      A(2 * i, 2 * j + 1) = weight * across;
      A(2 * i + 1, 2 * j + 1) = weight * direct;
    }
  return A;
}
std::vector<int> in_order(int points) {
  std::vector<int> order(static_cast<std::size_t>(points));
  std::iota(order.begin(), order.end(), 0);
  return order;
}
HierarchicalSolver::Fill entries_of(const Matrix& A) {
  return [&A](Eigen::Index row, Eigen::Index column, Matrix& block) {
    block = A.block(row, column, block.rows(), block.cols());
  };
}

TEST(HierarchicalSolver, SolvesNearlyWhatLUSolvesWhateverTheSizeOfTheRightHandSide) {
  for (const int points : {1, 40, 61, 500}) {  // 2 to 1000 unknowns
    const Matrix A = half_plane(points, in_order(points));
    HierarchicalSolver solver;
    ASSERT_TRUE(solver.factorise(A.rows(), entries_of(A)));
    if (points == 500) EXPECT_LT(solver.largest_rank(), 120);
    for (const double size : {1.0, 1e200, 1e-200}) {
      const Vector exact = size * (0.3 + Vector::LinSpaced(2 * points, 0.0, 0.7 * points).array().sin());
      const Vector b = A * exact, by_lu = test::solve_lu(A, b);
      Vector x;
      solver.solve(b, x);
      EXPECT_LT((x - by_lu).stableNorm(), 1e-6 * by_lu.stableNorm()) << points;
      Vector again;
      solver.solve(b, again);
      EXPECT_EQ(x, again);
    }
    Vector x;
    solver.solve(Vector::Zero(2 * points), x);
    EXPECT_EQ(x, Vector::Zero(2 * points));
  }
  HierarchicalSolver none;
  EXPECT_TRUE(none.factorise(0, entries_of(Matrix())));
}

// Blocks that are zero, or of full rank though small: halves that do not move each other, columns without order.
TEST(HierarchicalSolver, TakesHalvesThatDoNotCoupleAndThoseThatDoEntirely) {
  const Matrix one = half_plane(60, in_order(60));
  Matrix A = Matrix::Zero(240, 240);
  A.topLeftCorner(120, 120) = one;
  A.bottomRightCorner(120, 120) = 2.0 * one;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (const bool coupled : {false, true}) {
    if (coupled) A += 0.01 * Matrix::NullaryExpr(240, 240, [&] { return entry(random); });
    HierarchicalSolver solver;
    ASSERT_TRUE(solver.factorise(240, entries_of(A)));
    const Vector exact = Vector::LinSpaced(240, -1.0, 2.0);
    Vector x;
    solver.solve(A * exact, x);
    EXPECT_LT((x - exact).norm(), 1e-6 * exact.norm()) << coupled;
  }
}

TEST(HierarchicalSolver, SaysWhereItDoesNotPayOrCannot) {
  std::vector<int> order = in_order(900);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const Matrix unordered = half_plane(900, order);
  HierarchicalSolver solver;
  EXPECT_FALSE(solver.factorise(unordered.rows(), entries_of(unordered)));
  const Matrix zero = Matrix::Zero(200, 200);
  EXPECT_FALSE(solver.factorise(200, entries_of(zero)));
  Matrix none = half_plane(100, in_order(100));
  none(150, 20) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver.factorise(200, entries_of(none)));
}

}  // namespace
}  // namespace scabo::linalg
