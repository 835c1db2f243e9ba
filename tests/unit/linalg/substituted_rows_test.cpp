// Systems with substituted rows against dense ones.
#include "scabo/linalg/substituted_rows.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace scabo::linalg {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Well conditioned. Of the first `plain` rows one in three gives its unknown alone, one follows that of the row
/// before, whatever that is, and one is as any other.
Matrix matrix_with_plain_rows(std::mt19937& random, int n, int plain) {
  std::normal_distribution<double> value;
  Matrix A(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) A(i, j) = value(random) + (i == j ? 3.0 * n : 0.0);
  for (int i = 0; i < plain; ++i) {
    const int kind = static_cast<int>(random() % 3);
    if (kind == 2) continue;
    const double diagonal = A(i, i) / n, factor = i > 0 ? A(i, i - 1) : 0.0;
    A.row(i).setZero();
    A(i, i) = diagonal;
    if (kind == 1 && i > 0) A(i, i - 1) = factor;
  }
  return A;
}

TEST(SubstitutedRows, SolveWhatDenseMatricesSolve) {
  std::mt19937 random(4);
  for (const int n : {1, 2, 5, 40}) {
    const int plain = 3 * n / 4;
    for (int k = 0; k < 20; ++k) {
      const Matrix A = matrix_with_plain_rows(random, n, plain);
      SubstitutedRows rows;
      ASSERT_TRUE(rows.factorise(A.sparseView(), plain, {}));
      for (const int columns : {1, 4}) {
        Matrix B = Matrix::Random(n, columns), X;
        B.col(0).setZero();
        B(k % n, 0) = 1.0;
        rows.solve(B, X);
        const Matrix expected = A.partialPivLu().solve(B);
        EXPECT_LT((X - expected).norm(), 1e-12 * expected.norm()) << n << " " << k;
      }
    }
  }
}

TEST(SubstitutedRows, KeepWhatMayNotBeSubstituted) {
  // Rows of one entry, of two, and of two that follow each other.
  Matrix A = 2.0 * Matrix::Identity(6, 6);
  A(1, 0) = A(3, 4) = A(4, 3) = 1.0;
  A(5, 4) = A(5, 2) = 1.0;
  SubstitutedRows rows;
  ASSERT_TRUE(rows.factorise(A.sparseView(), 6, {}));
  EXPECT_EQ(rows.kept(), (std::vector<int>{3, 4, 5}));
  ASSERT_TRUE(rows.factorise(A.sparseView(), 1, {}));
  EXPECT_EQ(rows.kept(), (std::vector<int>{1, 2, 3, 4, 5}));
  ASSERT_FALSE(rows.factorise(Sparse(3, 3), 3, {}));
}

// Of the forces that are substituted the others still feel what they are.
TEST(SubstitutedRows, AreFeltByTheOthers) {
  Matrix A(3, 3);
  A << 1.0, 0.0, 0.0, -0.5, 1.0, 0.0, 1.0, 1.0, 2.0;
  SubstitutedRows rows;
  ASSERT_TRUE(rows.factorise(A.sparseView(), 2, {}));
  EXPECT_EQ(rows.kept(), std::vector<int>{2});
  Matrix X;
  rows.solve(Vector::Ones(3), X);
  EXPECT_DOUBLE_EQ(X(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(X(1, 0), 1.5);
  EXPECT_DOUBLE_EQ(X(2, 0), -0.75);
}

}  // namespace
}  // namespace scabo::linalg
