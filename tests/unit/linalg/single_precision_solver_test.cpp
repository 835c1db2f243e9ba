#include "scabo/linalg/single_precision_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scabo::linalg {
namespace {

/// Without symmetry, and with a zero on the diagonal.
Matrix example(int n) {
  Matrix A(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) A(i, j) = std::sin(1.0 + 3.0 * i + 7.0 * i * j) + (i == (j + 1) % n ? 5.0 : 0.0);
  A(0, 0) = 0.0;
  return A;
}

TEST(SinglePrecisionSolver, SolvesToItsPrecisionWhateverTheSizeOfTheRightHandSide) {
  const Matrix A = example(40);
  Eigen::MatrixXf factor = A.cast<float>();
  SinglePrecisionSolver solver;
  ASSERT_TRUE(solver.factorise(factor));
  for (const double size : {1.0, 1e200, 1e-200}) {
    const Vector exact = size * Vector::LinSpaced(40, -1.0, 2.0);
    Vector x;
    solver.solve(A * exact, x);
    EXPECT_LT((x - exact).stableNorm(), 1e-4 * exact.stableNorm());
    EXPECT_GT((x - exact).stableNorm(), 1e-9 * exact.stableNorm());
  }
  Vector x;
  solver.solve(Vector::Zero(40), x);
  EXPECT_EQ(x, Vector::Zero(40));
}

TEST(SinglePrecisionSolver, SaysThatAMatrixIsSingularOrOutOfRange) {
  Eigen::MatrixXf zero = Eigen::MatrixXf::Ones(3, 3);
  SinglePrecisionSolver solver;
  EXPECT_FALSE(solver.factorise(zero));
  Eigen::MatrixXf large = Matrix(1e60 * Matrix::Identity(3, 3)).cast<float>();
  EXPECT_FALSE(solver.factorise(large));
  Eigen::MatrixXf none(0, 0);
  EXPECT_TRUE(solver.factorise(none));
}

}  // namespace
}  // namespace scabo::linalg
