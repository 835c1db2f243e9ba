// Dense matrix operations of LAPACK and BLAS level 3. All matrices are column-major (Eigen's default).
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// Number of threads that BLAS, LAPACK and CHOLMOD may use in this process.
void set_blas_threads(int threads);

/// Keeps the number of threads that others in this process have chosen (NumPy in Python): it is restored when the last
/// of these objects ends.
class KeptBlasThreads {
 public:
  KeptBlasThreads();
  ~KeptBlasThreads();
  KeptBlasThreads(const KeptBlasThreads&) = delete;
  KeptBlasThreads& operator=(const KeptBlasThreads&) = delete;
};

/// BLAS has one thread while any of these objects exists: where results must not depend on how many it has, which its
/// products of matrices do in their last digits.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// The largest absolute component, 0 of a vector without any.
double largest_of(const Eigen::Ref<const Vector>& v);

/// A' B.
Matrix multiply_transposed(const Matrix& A, const Matrix& B);

/// A B.
Matrix multiply(const Matrix& A, const Matrix& B);

/// C <- C + alpha A B, on parts of matrices.
void add_product(double alpha, const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B,
                 Eigen::Ref<Matrix> C);

/// A = U T U', U orthogonal, T upper quasi-triangular (2 x 2 blocks for complex pairs).
struct RealSchur {
  Matrix T, U;
};
RealSchur real_schur(Matrix A);

/// Whether rows i and i + 1 of a quasi-triangular T form a 2 x 2 block.
inline bool pair_begins(const Matrix& T, Eigen::Index i) { return i + 1 < T.rows() && T(i + 1, i) != 0.0; }

}  // namespace scabo::linalg
