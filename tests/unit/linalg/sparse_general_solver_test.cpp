#include "scabo/linalg/sparse_general_solver.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace scabo::linalg {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Tridiagonal, not symmetric, and one entry that couples the first row to column `far`.
Sparse banded(int n, double below, double diagonal, double above, int far) {
  std::vector<Eigen::Triplet<double>> entries{{0, far, 0.5}};
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, diagonal);
    if (i > 0) entries.emplace_back(i, i - 1, below);
    if (i + 1 < n) entries.emplace_back(i, i + 1, above);
  }
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

void expect_solved(SparseGeneralSolver& solver, const Sparse& A) {
  ASSERT_TRUE(solver.factorise(A));
  const Vector expected = Vector::LinSpaced(A.rows(), -1.0, 2.0);
  Vector x;
  solver.solve(A * expected, x);
  EXPECT_LT((x - expected).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(SparseGeneralSolver, KeepsTheOrderingForTheSamePatternOnly) {
  SparseGeneralSolver solver;
  expect_solved(solver, banded(40, -1.0, 3.0, 1.5, 20));
  expect_solved(solver, banded(40, 2.0, 5.0, -0.3, 20));  // the same pattern
  expect_solved(solver, banded(40, 2.0, 5.0, -0.3, 30));  // as many entries, one elsewhere
  expect_solved(solver, banded(25, 2.0, 5.0, -0.3, 12));
  expect_solved(solver, banded(40, -1.0, 3.0, 1.5, 20));
}

TEST(SparseGeneralSolver, TellsOfASingularMatrixAndSolvesTheNext) {
  SparseGeneralSolver solver;
  Sparse A = banded(12, 1.0, 4.0, 1.0, 6);
  expect_solved(solver, A);
  Sparse singular = A;
  for (Sparse::InnerIterator at(singular, 3); at; ++at) at.valueRef() = 0.0;
  EXPECT_FALSE(solver.factorise(singular) && solver.reciprocal_condition() > 0.0);
  expect_solved(solver, A);
}

}  // namespace
}  // namespace scabo::linalg
