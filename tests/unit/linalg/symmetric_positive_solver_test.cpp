#include "scabo/linalg/symmetric_positive_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "support/decompositions.hpp"
#include "support/long_double.hpp"

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

  Vector b = Vector::Zero(n);  // one entry, some, all
  for (const int entries : {1, 5, n}) {
    for (int k = 0; k < entries; ++k) b[(7 * k) % n] += 1.0 + k;
    const Vector x = inverse * b;
    for (const std::vector<int>& wanted : {std::vector<int>{n / 2}, indices})
      EXPECT_LT((solver.solve_at(solver.begin(b), wanted) - x(wanted)).norm(), 1e-12 * x.norm());
    Vector part = Vector::Zero(b.size());
    part(indices) = b(indices);
    EXPECT_LT((solver.solve_from(solver.begin(b - part), part) - x).norm(), 1e-12 * x.norm());
  }
  EXPECT_EQ(solver.solve_at(solver.begin(b), {}).size(), 0);
}

TEST(SymmetricPositiveSolver, DenseAgainstEigen) {
  for (int n : {1, 2, 17, 120}) expect_solves(SymmetricPositiveSolver(dense(n)), dense(n));
}

/// The same for every library that is built in.
class SparseLibraries : public testing::TestWithParam<SparseLibrary> {
 protected:
  SparseOptions options{GetParam(), Ordering::automatic};
};
std::vector<SparseLibrary> built_in() {
  std::vector<SparseLibrary> libraries;
  for (const SparseLibrary library : {SparseLibrary::cholmod, SparseLibrary::mumps})
    if (is_built_in(library)) libraries.push_back(library);
  return libraries;
}
INSTANTIATE_TEST_SUITE_P(SymmetricPositiveSolver, SparseLibraries, testing::ValuesIn(built_in()), [](const auto& test) {
  return std::string(test.param == SparseLibrary::mumps ? "mumps" : "cholmod");
});

TEST_P(SparseLibraries, AgainstEigen) {
  for (int side : {2, 3, 9, 20}) expect_solves(SymmetricPositiveSolver(grid(side), options), Matrix(grid(side)));
}

/// Plane lattice of springs of `columns` x `rows` nodes, two unknowns each, with diagonals, held at its lower side;
/// stiffnesses between 1 and `contrast`.
SparseMatrix lattice(int columns, int rows, double contrast) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(0.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&](int a, int b, double x, double y) {
    const double k = std::pow(contrast, exponent(random));
    const double direction[4] = {x, y, -x, -y};
    const int dofs[4] = {2 * a, 2 * a + 1, 2 * b, 2 * b + 1};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (dofs[i] >= 0 && dofs[j] >= 0) entries.emplace_back(dofs[i], dofs[j], k * direction[i] * direction[j]);
  };
  const double half = std::sqrt(0.5);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto node = [&](int x, int y) { return y < 0 ? -1 : x + y * columns; };
      spring(node(i, j - 1), node(i, j), 0, 1);
      if (i + 1 == columns) continue;
      spring(node(i, j), node(i + 1, j), 1, 0);
      spring(node(i, j - 1), node(i + 1, j), half, half);
      spring(node(i + 1, j - 1), node(i, j), -half, half);
    }
  SparseMatrix A(2 * columns * rows, 2 * columns * rows);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Block of the inverse for the boundary nodes of a lattice, against the whole inverse.
TEST_P(SparseLibraries, InverseBlockOfALattice) {
  const int columns = 21, rows = 13;
  const SparseMatrix A = lattice(columns, rows, 10.0);
  std::vector<int> boundary;
  for (int k = 0; k < columns * rows; ++k)
    if (k % columns == 0 || k % columns == columns - 1 || k >= columns * (rows - 1))
      boundary.insert(boundary.end(), {2 * k + 1, 2 * k});
  const Matrix inverse = test::solve_cholesky(Matrix(A), Matrix::Identity(A.rows(), A.cols()));
  const SymmetricPositiveSolver solver(A, options);
  EXPECT_LT((solver.inverse_block(boundary) - inverse(boundary, boundary)).norm(), 1e-12 * inverse.norm());
  for (const int i : {0, 7, 300, 545}) {
    EXPECT_NEAR(solver.inverse_block({i})(0, 0), inverse(i, i), 1e-12 * inverse(i, i));
    const std::vector<int> named{i, 4, i};  // an unknown may be named more than once
    const Matrix twice = solver.inverse_block(named);
    EXPECT_LT((twice - inverse(named, named)).norm(), 1e-12 * inverse(i, i));
  }
  std::vector<int> all(static_cast<std::size_t>(A.rows()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_LT((solver.inverse_block(all) - inverse).norm(), 1e-12 * inverse.norm());
}

/// Without connection: blocks of the inverse between the parts are exactly zero.
TEST_P(SparseLibraries, InverseBlockOfSeveralParts) {
  const SparseMatrix part = lattice(9, 8, 3.0);
  const int n = static_cast<int>(part.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < 3; ++p)
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator it(part, j); it; ++it)
        entries.emplace_back(p * n + static_cast<int>(it.row()), p * n + j, (p + 1) * it.value());
  SparseMatrix A(3 * n, 3 * n);
  A.setFromTriplets(entries.begin(), entries.end());
  const Matrix inverse = test::solve_cholesky(Matrix(part), Matrix::Identity(n, n));
  const std::vector<int> indices = {2 * n + 5, 3, n + 17, 2 * n + 100, n + 3};
  const Matrix block = SymmetricPositiveSolver(A, options).inverse_block(indices);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const int a = indices[static_cast<std::size_t>(i)], b = indices[static_cast<std::size_t>(j)];
      if (a / n != b / n)
        EXPECT_EQ(block(i, j), 0.0);
      else
        EXPECT_NEAR(block(i, j), inverse(a % n, b % n) / (a / n + 1), 1e-12 * inverse.cwiseAbs().maxCoeff());
    }
}

/// Stiffnesses over ten decades: Cholesky factors are accurate to the condition after scaling by the diagonal, and a
/// block is as accurate as the solution of the whole.
TEST_P(SparseLibraries, InverseBlockOfAnIllConditionedLattice) {
  const SparseMatrix A = lattice(15, 15, 1e10);
  const SymmetricPositiveSolver solver(A, options);
  std::vector<int> top;
  for (int k = 14 * 15; k < 15 * 15; ++k) top.insert(top.end(), {2 * k, 2 * k + 1});
  const test::LongMatrix wide = Matrix(A).cast<long double>(),
                         identity = test::LongMatrix::Identity(A.rows(), A.cols());
  const Matrix exact = test::long_double::solve_lu(wide, identity).cast<double>()(top, top),
               block = solver.inverse_block(top);
  Matrix E = Matrix::Zero(A.rows(), static_cast<Eigen::Index>(top.size()));
  for (std::size_t j = 0; j < top.size(); ++j) E(top[j], static_cast<Eigen::Index>(j)) = 1.0;
  const Matrix solved = solver.solve(E)(top, Eigen::all);
  const double error = (block - exact).norm(), of_solve = (solved - exact).norm();
  EXPECT_LT(error, 4.0 * of_solve + 1e-14 * exact.norm());
  EXPECT_GT(of_solve, 1e-14 * exact.norm()) << "the lattice is no test: it is well-conditioned";
}

TEST(SymmetricPositiveSolver, NothingToSolve) {
  EXPECT_EQ(SymmetricPositiveSolver().solve(Matrix(0, 2)).size(), 0);
  EXPECT_EQ(SymmetricPositiveSolver(Matrix(0, 0)).solve(Matrix(0, 1)).size(), 0);
  EXPECT_EQ(SymmetricPositiveSolver(SparseMatrix(0, 0)).inverse_block({}).size(), 0);
}

TEST_P(SparseLibraries, SurvivesBeingMoved) {
  const SparseMatrix A = grid(9);
  SymmetricPositiveSolver first(A, options);
  SymmetricPositiveSolver second = std::move(first);
  first = SymmetricPositiveSolver(dense(4));
  expect_solves(second, Matrix(A));
  expect_solves(first, dense(4));
}

TEST_P(SparseLibraries, SaysWhatIsNotPositiveDefinite) {
  Matrix negative = dense(6);
  negative(4, 4) = -1.0;
  EXPECT_THROW(SymmetricPositiveSolver{negative}, NotPositiveDefinite);
  EXPECT_THROW(SymmetricPositiveSolver(Matrix(Matrix::Zero(3, 3))), NotPositiveDefinite);
  SparseMatrix indefinite = grid(9);
  indefinite.coeffRef(40, 40) = -0.5;
  EXPECT_THROW(SymmetricPositiveSolver(indefinite, options), NotPositiveDefinite);
  SparseMatrix empty_row = grid(9);  // a singular one: nothing holds the last unknown
  for (int i = 0; i < 81; ++i)
    for (int j = 0; j < 81; ++j)
      if ((i == 80 || j == 80) && empty_row.coeff(i, j) != 0.0) empty_row.coeffRef(i, j) = 0.0;
  EXPECT_THROW(SymmetricPositiveSolver(empty_row, options), NotPositiveDefinite);
}

TEST_P(SparseLibraries, KeepsItsDigitsOverSixteenDecades) {
  SparseMatrix A = grid(12);
  const Vector scale = Vector::NullaryExpr(144, [](Eigen::Index i) { return std::pow(10.0, (i % 17 - 8) * 0.5); });
  const Matrix scaled = scale.asDiagonal() * Matrix(A) * scale.asDiagonal();
  SparseMatrix sparse = scaled.sparseView();
  sparse.makeCompressed();
  const Vector x = Vector::LinSpaced(144, 1.0, 2.0);
  const Vector b = scaled * scale.cwiseInverse().asDiagonal() * x;
  EXPECT_LT((Vector(scale.asDiagonal() * SymmetricPositiveSolver(sparse, options).solve(b)) - x).norm(),
            1e-12 * x.norm());
  EXPECT_LT((Vector(scale.asDiagonal() * SymmetricPositiveSolver(scaled).solve(b)) - x).norm(), 1e-12 * x.norm());
}

}  // namespace
}  // namespace scabo::linalg
