#include "scabo/linalg/general_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace scabo::linalg {
namespace {

double norm_1(const Matrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); }

/// Random, its rows and columns multiplied by powers of ten down to 10^-digits.
Matrix graded(Eigen::Index n, double digits, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Matrix A(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      A(i, j) = uniform(random) * std::pow(10.0, -digits * static_cast<double>(i + j) / static_cast<double>(2 * n));
  return A;
}

TEST(GeneralSolver, EstimatesTheConditionWithinAFactorOfThree) {
  // The estimate of |A^-1| is a lower bound, so that 1 / condition is never too small.
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Eigen::Index n = 1 + static_cast<Eigen::Index>(seed);
    const Matrix A = graded(n, seed % 9, seed);
    const double exact = 1.0 / (norm_1(A) * norm_1(A.inverse()));
    Matrix whole = Matrix::Constant(n + 3, n + 3, 7.0);  // of which the leading block is the matrix
    whole.topLeftCorner(n, n) = A;
    GeneralSolver solver;
    ASSERT_TRUE(solver.factorise(whole, n));
    const double estimate = solver.reciprocal_condition();
    EXPECT_GE(estimate, exact * (1.0 - 1e-6)) << n;
    EXPECT_LE(estimate, 3.0 * exact) << n;
  }
}

TEST(GeneralSolver, TellsOfAMatrixThatIsSingularWithinRounding) {
  Matrix A = graded(30, 0.0, 1);
  A.col(20) = A.col(3) + 2.0 * A.col(11);
  GeneralSolver solver;
  const bool regular = solver.factorise(A, 30) && solver.reciprocal_condition() > 1e-14;
  EXPECT_FALSE(regular);
}

TEST(GeneralSolver, DoesNotTakeAnInverseThatOverflowsForARegularMatrix) {
  Matrix A = Matrix::Identity(4, 4);
  A(2, 2) = 1e-310;
  A(1, 2) = 1.0;
  GeneralSolver solver;
  ASSERT_TRUE(solver.factorise(A, 4));
  EXPECT_FALSE(solver.reciprocal_condition() > 1e-15);
}

}  // namespace
}  // namespace scabo::linalg
