#include "scabo/linalg/nonnegative_least_squares.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/decompositions.hpp"

namespace scabo::linalg {
namespace {

/// x >= 0, A'(b - A x) <= 0, complementary: necessary and sufficient for the minimum of a convex problem.
void expect_optimal(const Matrix& A, const Vector& b, const Vector& x) {
  ASSERT_TRUE(x.allFinite());
  const double scale = A.colwise().norm().maxCoeff() * b.norm();
  EXPECT_GE(x.minCoeff(), 0.0);
  const Vector gradient = A.transpose() * (b - A * x);
  EXPECT_LE(gradient.maxCoeff(), 1e-11 * scale);
  EXPECT_LE((gradient.array() * (x.array() > 0.0).cast<double>()).abs().maxCoeff(), 1e-11 * scale);
}

TEST(NonnegativeLeastSquares, MeetsItsOptimalityConditions) {
  std::mt19937 random(13);
  std::normal_distribution<double> entry;
  for (int k = 0; k < 500; ++k) {
    const int rows = 1 + k % 6, columns = 1 + k % 37;
    Matrix A = Matrix::NullaryExpr(rows, columns, [&] { return entry(random); });
    if (k % 4 == 0 && columns > 1) A.col(columns - 1) = A.col(0);                     // ties
    if (k % 5 == 0 && columns > 2) A.col(1) = 0.5 * (A.col(0) + A.col(columns - 1));  // dependent columns
    const Vector b = Vector::NullaryExpr(rows, [&] { return entry(random); });
    SCOPED_TRACE(k);
    expect_optimal(A, b, nonnegative_least_squares(A, b));
  }
}

TEST(NonnegativeLeastSquares, ReachesWhatLiesInTheCone) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> entry(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const Matrix A = Matrix::NullaryExpr(3, 20, [&] { return entry(random) - 0.3; });
    const Vector b = A * Vector::NullaryExpr(20, [&] { return entry(random); });
    const Vector x = nonnegative_least_squares(A, b);
    expect_optimal(A, b, x);
    EXPECT_LT((A * x - b).norm(), 1e-11 * b.norm());
  }
}

// What is left is the direction that separates b from the cone (Farkas): r'b > 0, A'r <= 0.
TEST(NonnegativeLeastSquares, ResidualSeparatesFromTheCone) {
  Matrix A(2, 2);
  A << 1.0, 1.0, 0.2, -0.2;  // a narrow cone about +x
  const Vector b = Eigen::Vector2d(1.0, 1.0), r = b - A * nonnegative_least_squares(A, b);
  EXPECT_GT(r.dot(b), 0.1);
  EXPECT_LE((A.transpose() * r).maxCoeff(), 1e-15);
  const Vector behind = Eigen::Vector2d(-1.0, 0.1);
  EXPECT_EQ(nonnegative_least_squares(A, behind), Vector(Vector::Zero(2)));
}

TEST(NonnegativeLeastSquares, IsTheUnconstrainedSolutionWhereThatIsPositive) {
  Matrix A(3, 2);
  A << 2, 1, 0, 1, 1, -1;
  const Vector b = A * Eigen::Vector2d(0.7, 1.9) + 0.01 * Eigen::Vector3d(1, -1, 0.5);
  EXPECT_LT((nonnegative_least_squares(A, b) - Vector(test::least_squares(A, b))).norm(), 1e-14);
}

TEST(NonnegativeLeastSquares, DoesNotDependOnUnits) {
  Matrix A(2, 3);
  A << 1.0, 0.3, -1.0, 0.2, 1.0, 0.5;
  const Vector b = Eigen::Vector2d(0.3, 1.0), x = nonnegative_least_squares(A, b);
  EXPECT_LT((nonnegative_least_squares(1e-9 * A, 1e6 * b) - 1e15 * x).norm(), 1e-12 * 1e15 * x.norm());
  EXPECT_EQ(nonnegative_least_squares(A, Vector::Zero(2)), Vector(Vector::Zero(3)));
  EXPECT_EQ(nonnegative_least_squares(Matrix(2, 0), b).size(), 0);
}

}  // namespace
}  // namespace scabo::linalg
