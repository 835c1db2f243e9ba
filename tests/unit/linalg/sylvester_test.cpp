#include "scabo/linalg/sylvester.hpp"

#include <gtest/gtest.h>

#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {
namespace {

/// A quasi-triangular matrix with eigenvalues in the right half plane.
Matrix quasi_triangular(int n) {
  return real_schur(Matrix::Random(n, n) + 2.0 * std::sqrt(n) * Matrix::Identity(n, n)).T;
}

TEST(Sylvester, SolvesItsEquationForAllSizes) {
  std::srand(1);
  for (const auto& [n, m] :
       {std::pair(1, 1), {2, 1}, {1, 2}, {7, 5}, {48, 48}, {49, 48}, {130, 3}, {3, 130}, {200, 150}}) {
    const Matrix T1 = quasi_triangular(n), T2 = quasi_triangular(m), C = Matrix::Random(n, m);
    const Matrix X = solve_sylvester(T1, T2, C);
    EXPECT_LT((T1.transpose() * X + X * T2 - C).cwiseAbs().maxCoeff(), 1e-12) << n << " x " << m;
  }
}

TEST(Sylvester, OfNoUnknownsIsEmpty) {
  EXPECT_EQ(solve_sylvester(Matrix(0, 0), quasi_triangular(3), Matrix(0, 3)).size(), 0);
  EXPECT_EQ(solve_sylvester(quasi_triangular(3), Matrix(0, 0), Matrix(3, 0)).size(), 0);
}

}  // namespace
}  // namespace scabo::linalg
