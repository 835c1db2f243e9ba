#include "scabo/linalg/dense.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>

#include "scabo/base/error.hpp"
#include "scabo/linalg/blas_kernels.hpp"

namespace scabo::linalg {

extern "C" {
void openblas_set_num_threads(int threads);
[[gnu::weak]] void omp_set_num_threads(int threads);  // there when CHOLMOD was built with OpenMP
}

void set_blas_threads(int threads) {
  choose_blas_kernels();
  openblas_set_num_threads(threads);
  if (omp_set_num_threads) omp_set_num_threads(threads);
}

namespace {

int rows(const Matrix& A) { return static_cast<int>(A.rows()); }
int cols(const Matrix& A) { return static_cast<int>(A.cols()); }
int stride(const Matrix& A) { return std::max(1, rows(A)); }

void mirror_lower(Matrix& A) {
  A.triangularView<Eigen::StrictlyUpper>() = A.transpose().triangularView<Eigen::StrictlyUpper>();
}

}  // namespace

bool cholesky_in_place(Matrix& A) {
  ensure(A.rows() == A.cols(), "cholesky_in_place needs a square matrix");
  if (A.rows() == 0) return true;
  return LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', rows(A), A.data(), stride(A)) == 0;
}

namespace {

constexpr int inverted_at_once = 32;

/// Inverse of a small lower triangular matrix, column by column; zeros above. Triangular inverses of LAPACK start too slowly.
void invert_lower(const double* l, std::ptrdiff_t l_stride, int n, double* inverse) {
  std::array<double, inverted_at_once> over;
  for (int k = 0; k < n; ++k) over[static_cast<std::size_t>(k)] = 1.0 / l[k * l_stride + k];
  for (int j = 0; j < n; ++j) {
    double* const x = inverse + j * n;
    std::fill(x, x + n, 0.0);
    x[j] = 1.0;
    for (int k = j; k < n; ++k) {
      const double* const column = l + k * l_stride;
      const double value = x[k] * over[static_cast<std::size_t>(k)];
      x[k] = value;
      for (int i = k + 1; i < n; ++i) x[i] -= value * column[i];
    }
  }
}

/// Solves with the lower triangular n x n part of L at `l`; B at `b`, n x m. `room`: 32 x 32 and 32 x m. Halves are solved one after
/// the other, with a product between; the last blocks by their inverse.
void solve_by_halves(const double* l, int l_stride, int n, double* b, int b_stride, int m, bool transposed, double* room) {
  if (n <= inverted_at_once) {
    double *const inverse = room, *const copy = room + inverted_at_once * inverted_at_once;
    invert_lower(l, l_stride, n, inverse);
    for (std::ptrdiff_t j = 0; j < m; ++j) std::copy(b + j * b_stride, b + j * b_stride + n, copy + j * n);
    cblas_dgemm(CblasColMajor, transposed ? CblasTrans : CblasNoTrans, CblasNoTrans, n, m, n, 1.0, inverse, n, copy, n, 0.0, b,
                b_stride);
    return;
  }
  const int top = (n / 2 + inverted_at_once - 1) / inverted_at_once * inverted_at_once, rest = n - top;
  const double* const below = l + top;
  const double* const last = below + static_cast<std::ptrdiff_t>(top) * l_stride;
  if (transposed) {
    solve_by_halves(last, l_stride, rest, b + top, b_stride, m, true, room);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, top, m, rest, -1.0, below, l_stride, b + top, b_stride, 1.0, b,
                b_stride);
    solve_by_halves(l, l_stride, top, b, b_stride, m, true, room);
  } else {
    solve_by_halves(l, l_stride, top, b, b_stride, m, false, room);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rest, m, top, -1.0, below, l_stride, b, b_stride, 1.0, b + top,
                b_stride);
    solve_by_halves(last, l_stride, rest, b + top, b_stride, m, false, room);
  }
}

}  // namespace

void solve_lower_in_place(const Matrix& L, Matrix& B, bool transposed) {
  ensure(L.rows() == L.cols() && L.rows() == B.rows(), "solve_lower_in_place: sizes differ");
  if (B.size() == 0) return;
  constexpr int few = 16;  // right-hand sides or rows: nothing to gain
  if (cols(B) < few || rows(B) < few) {
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transposed ? CblasTrans : CblasNoTrans, CblasNonUnit,
                rows(B), cols(B), 1.0, L.data(), stride(L), B.data(), stride(B));
    return;
  }
  const auto room = std::make_unique_for_overwrite<double[]>(
      static_cast<std::size_t>(inverted_at_once * (inverted_at_once + B.cols())));
  solve_by_halves(L.data(), stride(L), rows(L), B.data(), stride(B), cols(B), transposed, room.get());
}

void add_gram(Matrix& C, const Matrix& A, double alpha, double beta) {
  ensure(C.rows() == A.cols() && C.cols() == A.cols(), "add_gram: sizes differ");
  if (C.size() == 0) return;
  cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, cols(A), rows(A), alpha, A.data(), stride(A), beta,
              C.data(), stride(C));
  mirror_lower(C);
}

void add_gram_lower(Matrix& C, const Eigen::Ref<const Matrix>& A, double alpha) {
  ensure(C.rows() == A.cols() && C.cols() == A.cols(), "add_gram_lower: sizes differ");
  if (C.size() == 0) return;
  cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, cols(C), static_cast<int>(A.rows()), alpha, A.data(),
              static_cast<int>(A.outerStride()), 1.0, C.data(), stride(C));
}

void set_multiply_transposed(const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B, double alpha, Matrix& C) {
  ensure(A.rows() == B.rows(), "set_multiply_transposed: sizes differ");
  C.resize(A.cols(), B.cols());
  if (A.rows() == 0) C.setZero();
  if (C.size() == 0 || A.rows() == 0) return;
  cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, rows(C), cols(C), static_cast<int>(A.rows()), alpha, A.data(),
              static_cast<int>(A.outerStride()), B.data(), static_cast<int>(B.outerStride()), 0.0, C.data(), stride(C));
}

Matrix multiply_transposed(const Matrix& A, const Matrix& B, double alpha) {
  Matrix C;
  set_multiply_transposed(A, B, alpha, C);
  return C;
}

Matrix multiply(const Matrix& A, const Matrix& B) {
  ensure(A.cols() == B.rows(), "multiply: sizes differ");
  Matrix C = Matrix::Zero(A.rows(), B.cols());
  if (C.size() == 0 || A.cols() == 0) return C;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows(A), cols(B), cols(A), 1.0, A.data(), stride(A),
              B.data(), stride(B), 0.0, C.data(), stride(C));
  return C;
}

void add_product(double alpha, const Eigen::Ref<const Matrix>& A, const Eigen::Ref<const Matrix>& B,
                 Eigen::Ref<Matrix> C) {
  ensure(A.cols() == B.rows() && C.rows() == A.rows() && C.cols() == B.cols(), "add_product: sizes differ");
  if (C.size() == 0 || A.cols() == 0) return;
  const auto length = [](Eigen::Index value) { return static_cast<int>(value); };
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, length(A.rows()), length(B.cols()), length(A.cols()), alpha,
              A.data(), length(A.outerStride()), B.data(), length(B.outerStride()), 1.0, C.data(),
              length(C.outerStride()));
}

RealSchur real_schur(Matrix A) {
  const int n = rows(A);
  RealSchur schur{std::move(A), Matrix(n, n)};
  if (n == 0) return schur;
  Vector real(n), imaginary(n);
  lapack_int sorted = 0;
  const int info = LAPACKE_dgees(LAPACK_COL_MAJOR, 'V', 'N', nullptr, n, schur.T.data(), n, &sorted,
                                 real.data(), imaginary.data(), schur.U.data(), n);
  ensure(info == 0, "the real Schur form did not converge");
  return schur;
}

}  // namespace scabo::linalg
