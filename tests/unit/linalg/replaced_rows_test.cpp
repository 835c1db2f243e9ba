// Systems with replaced rows against dense ones, factorised anew.
#include "scabo/linalg/replaced_rows.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "scabo/base/error.hpp"

namespace scabo::linalg {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Well conditioned, about a tenth filled.
Matrix random_matrix(std::mt19937& random, int n) {
  std::normal_distribution<double> value;
  Matrix A = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (i == j || random() % 10 == 0) A(i, j) = value(random) + (i == j ? 8.0 : 0.0);
  return A;
}

ReplacedRows::Row row_of(const Eigen::RowVectorXd& row) {
  ReplacedRows::Row entries;
  for (Eigen::Index j = 0; j < row.size(); ++j)
    if (row[j] != 0.0) entries.emplace_back(static_cast<int>(j), row[j]);
  return entries;
}

class ReplacedRowsOf : public testing::TestWithParam<int> {};  // most rows; of many the inverse is kept

TEST_P(ReplacedRowsOf, SolveWhatMatricesFactorisedAnewSolve) {
  constexpr int n = 60;
  std::mt19937 random(5);
  const Matrix B = random_matrix(random, n), other = random_matrix(random, n);
  Matrix A = B;
  const Vector b = Vector::Random(n);
  ReplacedRows rows;
  ASSERT_TRUE(rows.factorise(B.sparseView(), 0, GetParam(), {}));
  for (int change = 0; change < 200; ++change) {
    // Of thirty rows, some for the first time, others once more or back to what they were.
    const int row = static_cast<int>(random() % 30) * 2;
    A.row(row) = random() % 3 == 0 ? B.row(row) : other.row((row + change) % n);
    A(row, row) += A(row, row) == B(row, row) ? 0.0 : 8.0;
    rows.replace(row, row_of(A.row(row) - B.row(row)));
    const Eigen::PartialPivLU<Matrix> anew(A);
    const Vector expected = anew.solve(b);
    Vector x;
    ASSERT_TRUE(rows.solve(b, x));
    ASSERT_LT((x - expected).norm(), 1e-12 * expected.norm()) << change;
    // b + E c, with the right-hand sides of the replaced rows others too.
    const Vector c = Vector::Random(static_cast<Eigen::Index>(rows.rows().size()));
    Vector right = b;
    for (Eigen::Index i = 0; i < c.size(); ++i) right[rows.rows()[static_cast<std::size_t>(i)]] += c[i];
    rows.solve_from(rows.solve_before(b), c, x);
    ASSERT_LT((x - anew.solve(right)).norm(), 1e-11 * x.norm()) << change;
  }
}

// Together they are what they are one after the other, and the sign of the determinant is known.
TEST_P(ReplacedRowsOf, AreReplacedTogether) {
  constexpr int n = 50;
  std::mt19937 random(8);
  const Matrix B = random_matrix(random, n);
  Matrix A = B;
  const Vector b = Vector::Random(n);
  ReplacedRows rows;
  ASSERT_TRUE(rows.factorise(B.sparseView(), 0, GetParam(), {}));
  EXPECT_EQ(rows.sign(), 1);
  rows.replace({});
  int negative = 0;
  for (int k = 0; k < 60; ++k) {
    const Matrix other = random_matrix(random, n);
    std::vector<ReplacedRows::Replaced> changes;
    for (int row = k % 4; row < 30; row += 4 + k % 5) {
      // Rows in the order of another permutation, some of them back to what they were.
      A.row(row) = row % 3 == 0 ? B.row(row) : other.row((row + k % 3) % n);
      A(row, row) += row % 3 == 0 ? 0.0 : 3.0;
      changes.push_back({row, row_of(A.row(row) - B.row(row))});
    }
    rows.replace(std::move(changes));
    const Eigen::PartialPivLU<Matrix> anew(A);
    Vector x;
    ASSERT_TRUE(rows.solve(b, x));
    EXPECT_LT((A * x - b).norm(), 1e-11 * (b.norm() + x.norm())) << k;
    const int sign = anew.determinant() / B.determinant() > 0.0 ? 1 : -1;
    negative += sign < 0;
    ASSERT_EQ(rows.sign(), sign) << k;
    rows.solve_once(b, x);
    EXPECT_LT((A * x - b).norm(), 1e-8 * (b.norm() + x.norm())) << k;
    Vector of_replaced = Vector::Zero(n);  // zero but in some of the replaced rows
    of_replaced(rows.rows()) = Vector::Random(static_cast<Eigen::Index>(rows.rows().size()));
    of_replaced[rows.rows().front()] = 0.0;
    for (const Vector& right : {b, of_replaced}) {
      rows.solve_roughly(right, x);
      EXPECT_LT((A * x - right).norm(), 1e-8 * (right.norm() + x.norm())) << k;
    }
  }
  EXPECT_GT(negative, 10);
  EXPECT_LT(negative, 50);
}

// The inverse of the small matrix cannot be taken from the one before where that is singular.
TEST_P(ReplacedRowsOf, PassASingularMatrix) {
  constexpr int n = 40;
  std::mt19937 random(6);
  const Matrix B = random_matrix(random, n), other = random_matrix(random, n);
  Matrix A = B;
  ReplacedRows rows;
  ASSERT_TRUE(rows.factorise(B.sparseView(), 0, GetParam(), {}));
  A.row(3) = B.row(4);
  rows.replace(3, row_of(A.row(3) - B.row(3)));
  Vector x;
  rows.solve_from(rows.solve_before(Vector::Ones(n)), Vector::Unit(1, 0), x);
  EXPECT_LT((A * x).norm(), 1e-9 * x.norm());  // what A does not hold
  A.row(4) = other.row(4);
  rows.replace(4, row_of(A.row(4) - B.row(4)));
  const Vector b = Vector::Random(n), expected = A.partialPivLu().solve(b);
  ASSERT_TRUE(rows.solve(b, x));
  EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, ReplacedRowsOf, testing::Values(30, 500));

TEST(ReplacedRows, AreAsManyAsWasSaidAtMost) {
  const Matrix B = 2.0 * Matrix::Identity(4, 4);
  ReplacedRows rows;
  ASSERT_TRUE(rows.factorise(B.sparseView(), 0, 1, {}));
  rows.replace(2, {{2, 1.0}});
  rows.replace(2, {{2, 2.0}});
  EXPECT_THROW(rows.replace(0, {{0, 1.0}}), BrokenInvariant);
  Vector x;
  ASSERT_TRUE(rows.solve(Vector::Ones(4), x));
  EXPECT_NEAR(x[2], 0.25, 1e-15);
  EXPECT_FALSE(rows.factorise(Sparse(4, 4), 0, 1, {}));
}

}  // namespace
}  // namespace scabo::linalg
