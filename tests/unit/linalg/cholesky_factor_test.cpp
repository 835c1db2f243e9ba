// L L' = A, B L^-T and B L^-1 against Eigen's plain triangular solves, by tiles of every instruction set and by blocks.
#include "scabo/linalg/cholesky_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "scabo/linalg/tile_kernel.hpp"

namespace scabo::linalg {
namespace {

Matrix random(Eigen::Index rows, Eigen::Index columns) { return Matrix::Random(rows, columns); }

Matrix positive_definite(Eigen::Index n) {
  const Matrix X = random(n, n);
  return X * X.transpose() + 0.1 * static_cast<double>(n) * Matrix::Identity(n, n);
}

Matrix lower(const Matrix& A) { return A.triangularView<Eigen::Lower>(); }

double largest(const Matrix& A) { return A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0; }

constexpr double rounding = 1e-12;

TEST(TileKernel, EveryInstructionSetDividesByTheFactor) {
  for (int rank = 0; const TileKernel* kernel = tile_kernel(rank); ++rank)
    for (int n : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 23, 31, 38, 65})
      for (int rows : {1, 2, 3, 5, 8, 13, 24, 25, 31, 77}) {
        SCOPED_TRACE(kernel->instructions + std::string(", n = ") + std::to_string(n) +
                     ", rows = " + std::to_string(rows));
        const Matrix A = positive_definite(n), B = random(rows, n);
        Matrix L = A, X = B, Y = B;
        Vector over(n);
        ASSERT_TRUE(kernel->cholesky(L.data(), n, n, over.data()));
        L = lower(L);
        EXPECT_LT(largest(L * L.transpose() - A), rounding * largest(A));
        EXPECT_LT(largest(Vector(over.cwiseProduct(L.diagonal())) - Vector::Ones(n)), rounding);
        kernel->divide(L.data(), n, over.data(), n, X.data(), rows, rows, false);
        EXPECT_LT(largest(X * L.transpose() - B), rounding);
        kernel->divide(L.data(), n, over.data(), n, Y.data(), rows, rows, true);
        EXPECT_LT(largest(Y * L - B), rounding);
      }
}

TEST(TileKernel, EveryInstructionSetSubtractsASquare) {
  for (int rank = 0; const TileKernel* kernel = tile_kernel(rank); ++rank)
    for (int n : {1, 2, 3, 6, 8, 11, 16, 24, 25, 50, 76})
      for (int depth : {0, 1, 5, 38}) {
        SCOPED_TRACE(kernel->instructions + std::string(", n = ") + std::to_string(n) +
                     ", depth = " + std::to_string(depth));
        const Matrix A = random(n, depth), C = random(n, n);
        Matrix result = C;
        kernel->subtract_square(A.data(), n, n, depth, result.data(), n);
        EXPECT_LT(largest(lower(result) - lower(C - A * A.transpose())), rounding);
      }
}

/// Rows beside those given must stay as they are: a tile may not reach over the last one.
TEST(TileKernel, TouchesNoOtherRows) {
  constexpr int stride = 40, rows = 29, n = 13;
  const Matrix A = positive_definite(n);
  for (int rank = 0; const TileKernel* kernel = tile_kernel(rank); ++rank) {
    Matrix L = A, B = Matrix::Constant(stride, n, 7.0);
    Vector over(n);
    ASSERT_TRUE(kernel->cholesky(L.data(), n, n, over.data()));
    kernel->divide(L.data(), n, over.data(), n, B.data(), stride, rows, false);
    EXPECT_EQ(B.bottomRows(stride - rows), Matrix::Constant(stride - rows, n, 7.0)) << kernel->instructions;
  }
}

TEST(CholeskyFactor, BySizeTilesOrBlocks) {
  for (Eigen::Index n : {0, 1, 40, 200, 201, 333}) {
    SCOPED_TRACE(n);
    const Matrix A = positive_definite(n);
    CholeskyFactor factor;
    factor.A = A;
    ASSERT_TRUE(factor.factorise());
    const Matrix L = lower(factor.A);
    EXPECT_LE(largest(L * L.transpose() - A), rounding * largest(A));
    for (Eigen::Index rows : {0, 1, 3, 100}) {
      const Matrix B = random(rows, n);
      Matrix X = B, Y = B;
      factor.divide(X);
      EXPECT_LE(largest(X * L.transpose() - B), rounding);
      factor.divide(Y, true);
      EXPECT_LE(largest(Y * L - B), rounding);
    }
  }
}

TEST(CholeskyFactor, ReadsTheLowerTriangleOnly) {
  for (Eigen::Index n : {30, 250}) {
    const Matrix A = positive_definite(n);
    CholeskyFactor factor, other;
    factor.A = A;
    other.A = lower(A);
    other.A.triangularView<Eigen::StrictlyUpper>().setConstant(1e3);
    ASSERT_TRUE(factor.factorise() && other.factorise());
    EXPECT_EQ(lower(factor.A), lower(other.A));
  }
}

/// Wherever it stands: a negative pivot and one that is not a number.
TEST(CholeskyFactor, SaysWhatIsNotPositiveDefinite) {
  for (Eigen::Index n : {1, 9, 40, 260})
    for (Eigen::Index at : {Eigen::Index{0}, n / 2, n - 1})
      for (double pivot : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
        CholeskyFactor factor;
        factor.A = Matrix::Identity(n, n);
        factor.A(at, at) = pivot;
        EXPECT_FALSE(factor.factorise()) << n << ", " << at << ", " << pivot;
      }
}

TEST(SubtractSquare, BySizeTilesOrBlas) {
  for (Eigen::Index n : {1, 80, 400, 401})
    for (Eigen::Index depth : {0, 1, 100}) {
      const Matrix A = random(n, depth), C = random(n, n);
      Matrix result = C;
      subtract_square(A, result);
      EXPECT_LT(largest(lower(result) - lower(C - A * A.transpose())), rounding) << n << ", " << depth;
    }
}

}  // namespace
}  // namespace scabo::linalg
