#include "scabo/linalg/dense.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <mutex>
#include <new>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/linalg/blas_kernels.hpp"

namespace scabo::linalg {

extern "C" {
void openblas_set_num_threads(int threads);
int openblas_get_num_threads();
[[gnu::weak]] void omp_set_num_threads(int threads);  // exists if CHOLMOD was built with OpenMP
[[gnu::weak]] int omp_get_max_threads();
}

void set_blas_threads(int threads) {
  choose_blas_kernels();
  openblas_set_num_threads(threads);
  if (omp_set_num_threads) omp_set_num_threads(threads);
}

namespace {

struct KeptThreads {
  std::mutex lock;
  int keepers = 0, blas = 1, omp = 1;
};
KeptThreads& kept_threads() {
  static KeptThreads kept;
  return kept;
}

struct SingleThread {
  std::mutex lock;
  int users = 0, before = 1;
};
SingleThread& single_thread() {
  static SingleThread single;
  return single;
}

}  // namespace

KeptBlasThreads::KeptBlasThreads() {
  KeptThreads& kept = kept_threads();
  const std::lock_guard guard(kept.lock);
  if (kept.keepers++ > 0) return;
  kept.blas = openblas_get_num_threads();
  if (omp_get_max_threads) kept.omp = omp_get_max_threads();
}

KeptBlasThreads::~KeptBlasThreads() {
  KeptThreads& kept = kept_threads();
  const std::lock_guard guard(kept.lock);
  if (--kept.keepers > 0) return;
  openblas_set_num_threads(kept.blas);
  if (omp_set_num_threads) omp_set_num_threads(kept.omp);
}

namespace {

int rows(const Matrix& A) { return static_cast<int>(A.rows()); }
int cols(const Matrix& A) { return static_cast<int>(A.cols()); }
int stride(const Matrix& A) { return std::max(1, rows(A)); }

/// C = op(A) B, `depth` terms in each entry: some columns at a time, a third of a second between interruption points.
void product(CBLAS_TRANSPOSE op, const Matrix& A, const Matrix& B, int depth, Matrix& C) {
  constexpr double largest_part = 1e10;
  const int piece =
      std::max(64, static_cast<int>(std::min(1e9, largest_part / (static_cast<double>(rows(C)) * depth))));
  for (int first = 0; first < cols(C); first += piece) {
    interruption_point();
    cblas_dgemm(CblasColMajor, op, CblasNoTrans, rows(C), std::min(piece, cols(C) - first), depth, 1.0, A.data(),
                stride(A), B.col(first).data(), stride(B), 0.0, C.col(first).data(), stride(C));
  }
}

}  // namespace

OneBlasThread::OneBlasThread() {
  SingleThread& single = single_thread();
  const std::lock_guard guard(single.lock);
  if (single.users++ > 0) return;
  single.before = openblas_get_num_threads();
  if (single.before > 1) openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread() {
  SingleThread& single = single_thread();
  const std::lock_guard guard(single.lock);
  if (--single.users == 0 && single.before > 1) openblas_set_num_threads(single.before);
}

double largest_of(const Eigen::Ref<const Vector>& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; }

Matrix multiply_transposed(const Matrix& A, const Matrix& B) {
  ensure(A.rows() == B.rows(), "multiply_transposed: sizes differ");
  Matrix C = Matrix::Zero(A.cols(), B.cols());
  if (C.size() == 0 || A.rows() == 0) return C;
  product(CblasTrans, A, B, rows(A), C);
  return C;
}

Matrix multiply(const Matrix& A, const Matrix& B) {
  ensure(A.cols() == B.rows(), "multiply: sizes differ");
  Matrix C = Matrix::Zero(A.rows(), B.cols());
  if (C.size() == 0 || A.cols() == 0) return C;
  product(CblasNoTrans, A, B, cols(A), C);
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
  const int info = LAPACKE_dgees(LAPACK_COL_MAJOR, 'V', 'N', nullptr, n, schur.T.data(), n, &sorted, real.data(),
                                 imaginary.data(), schur.U.data(), n);
  if (info == LAPACK_WORK_MEMORY_ERROR) throw std::bad_alloc();
  ensure(info == 0, "the real Schur form did not converge");
  return schur;
}

}  // namespace scabo::linalg
