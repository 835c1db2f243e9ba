#include "scabo/linalg/symmetric_positive_solver.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/decompositions.hpp"

namespace scabo::linalg {
namespace {

/// Stiffness of a square grid of springs, held along one side: symmetric positive definite, nearly empty.
SparseMatrix grid(int side) {
  const int n = side * side;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, i < side ? 5.0 : 4.0);
    for (int neighbour : {i + side, i % side + 1 < side ? i + 1 : n}) {
      if (neighbour >= n) continue;
      entries.emplace_back(i, neighbour, -1.0 - 0.1 * (i % 3));
      entries.emplace_back(neighbour, i, -1.0 - 0.1 * (i % 3));
    }
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < n; ++i) A.coeffRef(i, i) += 1.0;
  A.makeCompressed();
  return A;
}

Matrix random_matrix(int rows, int columns) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  return Matrix::NullaryExpr(rows, columns, [&] { return entry(random); });
}

/// A dense one of the same kind: grid(side) and a low rank.
Matrix dense(int n) {
  const Matrix X = random_matrix(n, n);
  return X * X.transpose() + Matrix::Identity(n, n);
}

void expect_solves(const SymmetricPositiveSolver& solver, const Matrix& A) {
  const int n = static_cast<int>(A.rows());
  const Matrix B = random_matrix(n, 3), X = test::solve_cholesky(A, B);
  EXPECT_LT((solver.solve(B) - X).norm(), 1e-12 * X.norm());
  EXPECT_EQ(solver.solve(Matrix(n, 0)).cols(), 0);

  std::vector<int> indices;
  for (int i = n - 1; i >= 0; i -= 3) indices.push_back(i);  // not in order, more than one batch of sparse columns
  const Matrix inverse = test::solve_cholesky(A, Matrix::Identity(n, n)), block = solver.inverse_block(indices);
  EXPECT_LT((block - inverse(indices, indices)).norm(), 1e-12 * inverse.norm());
  EXPECT_EQ(block, block.transpose());
  EXPECT_EQ(solver.inverse_block({}).size(), 0);
}

TEST(SymmetricPositiveSolver, DenseAgainstEigen) {
  for (int n : {1, 2, 17, 120}) expect_solves(SymmetricPositiveSolver(dense(n)), dense(n));
}

TEST(SymmetricPositiveSolver, SparseAgainstEigen) {
  for (int side : {2, 3, 9, 20}) expect_solves(SymmetricPositiveSolver(grid(side)), Matrix(grid(side)));
}

TEST(SymmetricPositiveSolver, NothingToSolve) {
  EXPECT_EQ(SymmetricPositiveSolver().solve(Matrix(0, 2)).size(), 0);
  EXPECT_EQ(SymmetricPositiveSolver(Matrix(0, 0)).solve(Matrix(0, 1)).size(), 0);
  EXPECT_EQ(SymmetricPositiveSolver(SparseMatrix(0, 0)).inverse_block({}).size(), 0);
}

TEST(SymmetricPositiveSolver, SurvivesBeingMoved) {
  const SparseMatrix A = grid(9);
  SymmetricPositiveSolver first(A);
  SymmetricPositiveSolver second = std::move(first);
  first = SymmetricPositiveSolver(dense(4));
  expect_solves(second, Matrix(A));
  expect_solves(first, dense(4));
}

TEST(SymmetricPositiveSolver, SaysWhatIsNotPositiveDefinite) {
  Matrix negative = dense(6);
  negative(4, 4) = -1.0;
  EXPECT_THROW(SymmetricPositiveSolver{negative}, NotPositiveDefinite);
  EXPECT_THROW(SymmetricPositiveSolver(Matrix(Matrix::Zero(3, 3))), NotPositiveDefinite);
  SparseMatrix indefinite = grid(9);
  indefinite.coeffRef(40, 40) = -0.5;
  EXPECT_THROW(SymmetricPositiveSolver{indefinite}, NotPositiveDefinite);
  SparseMatrix empty_row = grid(9);  // a singular one: nothing holds the last unknown
  for (int i = 0; i < 81; ++i)
    for (int j = 0; j < 81; ++j)
      if ((i == 80 || j == 80) && empty_row.coeff(i, j) != 0.0) empty_row.coeffRef(i, j) = 0.0;
  EXPECT_THROW(SymmetricPositiveSolver{empty_row}, NotPositiveDefinite);
}

TEST(SymmetricPositiveSolver, KeepsItsDigitsOverSixteenDecades) {
  SparseMatrix A = grid(12);
  const Vector scale = Vector::NullaryExpr(144, [](Eigen::Index i) { return std::pow(10.0, (i % 17 - 8) * 0.5); });
  const Matrix scaled = scale.asDiagonal() * Matrix(A) * scale.asDiagonal();
  SparseMatrix sparse = scaled.sparseView();
  sparse.makeCompressed();
  const Vector x = Vector::LinSpaced(144, 1.0, 2.0);
  const Vector b = scaled * scale.cwiseInverse().asDiagonal() * x;
  EXPECT_LT((Vector(scale.asDiagonal() * SymmetricPositiveSolver(sparse).solve(b)) - x).norm(), 1e-12 * x.norm());
  EXPECT_LT((Vector(scale.asDiagonal() * SymmetricPositiveSolver(scaled).solve(b)) - x).norm(), 1e-12 * x.norm());
}

}  // namespace
}  // namespace scabo::linalg
