// Dense matrix operations of LAPACK and BLAS level 3, by name. All matrices are column-major (Eigen's default).
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// Number of threads that BLAS, LAPACK and CHOLMOD may use in this process.
void set_blas_threads(int threads);

/// A <- lower Cholesky factor of the symmetric positive definite A (n x n, lower triangle read; the strict
/// upper triangle is left as it was). False when A is not positive definite.
[[nodiscard]] bool cholesky_in_place(Matrix& A);

/// B <- L^-1 B, or L^-T B when `transposed`; L lower triangular, n x n; B n x m. By products and inverses of 32 x 32 blocks: BLAS's own
/// triangular solve reaches half of the speed of its product, with AVX-512 kernels a quarter.
void solve_lower_in_place(const Matrix& L, Matrix& B, bool transposed = false);

/// C <- beta C + alpha A' A, the full symmetric matrix.
void add_gram(Matrix& C, const Matrix& A, double alpha, double beta);

/// C <- C + alpha A' A, the lower triangle; the other is left as it was.
void add_gram_lower(Matrix& C, const Eigen::Ref<const Matrix>& A, double alpha);

/// alpha A' B.
Matrix multiply_transposed(const Matrix& A, const Matrix& B, double alpha = 1.0);
/// The same into C, whose room is used where it fits.
void set_multiply_transposed(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B, double alpha, Matrix& C);

/// A B.
Matrix multiply(const Matrix& A, const Matrix& B);

/// C <- C + alpha A B, on parts of matrices.
void add_product(double alpha, const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B, Eigen::Ref<Matrix> C);

/// A = U T U', U orthogonal, T upper quasi-triangular (2 x 2 blocks for complex pairs).
struct RealSchur {
  Matrix T, U;
};
RealSchur real_schur(Matrix A);

}  // namespace scabo::linalg
