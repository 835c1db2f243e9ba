#include "scabo/linalg/symmetric_positive_solver.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "scabo/base/error.hpp"
#include "scabo/linalg/cholesky_factor.hpp"

namespace scabo::linalg {

/// CHOLMOD's workspace and factor, freed together.
class SparseCholesky {
 public:
  explicit SparseCholesky(const SparseMatrix& A) : n_(static_cast<int>(A.rows())) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    cholmod_sparse view = lower_view(A);
    factor_ = cholmod_analyze(&view, &common_);
    if (factor_ != nullptr) cholmod_factorize(&view, factor_, &common_);
    const bool definite =
        factor_ != nullptr && common_.status == CHOLMOD_OK && factor_->minor == static_cast<std::size_t>(n_);
    if (!definite) {
      const bool out_of_memory = common_.status == CHOLMOD_OUT_OF_MEMORY;
      release();
      if (out_of_memory) throw std::bad_alloc();
      throw NotPositiveDefinite();
    }
  }
  ~SparseCholesky() { release(); }
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  Matrix solve(const Matrix& B) const {
    Matrix X(B.rows(), B.cols());
    if (B.size() == 0) return X;
    cholmod_dense right{};
    right.nrow = static_cast<std::size_t>(B.rows());
    right.ncol = static_cast<std::size_t>(B.cols());
    right.nzmax = right.nrow * right.ncol;
    right.d = right.nrow;
    right.x = const_cast<double*>(B.data());  // the interface of CHOLMOD lacks const; the data are only read
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor_, &right, &common_);
    ensure(solution != nullptr, "CHOLMOD could not solve");
    std::memcpy(X.data(), solution->x, sizeof(double) * static_cast<std::size_t>(X.size()));
    cholmod_free_dense(&solution, &common_);
    return X;
  }

 private:
  static cholmod_sparse lower_view(const SparseMatrix& A) {
    cholmod_sparse view{};
    view.nrow = static_cast<std::size_t>(A.rows());
    view.ncol = static_cast<std::size_t>(A.cols());
    view.nzmax = static_cast<std::size_t>(A.nonZeros());
    view.p = const_cast<int*>(A.outerIndexPtr());
    view.i = const_cast<int*>(A.innerIndexPtr());
    view.x = const_cast<double*>(A.valuePtr());
    view.stype = -1;  // symmetric, lower triangle read
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
  }
  void release() {
    if (factor_ != nullptr) cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  int n_ = 0;
  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

struct SymmetricPositiveSolver::Factor {
  int n = 0;
  CholeskyFactor L;                        // dense
  std::unique_ptr<SparseCholesky> sparse;  // otherwise
};

SymmetricPositiveSolver::SymmetricPositiveSolver() : factor_(std::make_unique<Factor>()) {}
SymmetricPositiveSolver::SymmetricPositiveSolver(SymmetricPositiveSolver&&) noexcept = default;
SymmetricPositiveSolver& SymmetricPositiveSolver::operator=(SymmetricPositiveSolver&&) noexcept = default;
SymmetricPositiveSolver::~SymmetricPositiveSolver() = default;

SymmetricPositiveSolver::SymmetricPositiveSolver(Matrix A) : SymmetricPositiveSolver() {
  factor_->n = static_cast<int>(A.rows());
  factor_->L.A = std::move(A);
  if (!factor_->L.factorise()) throw NotPositiveDefinite();
}

SymmetricPositiveSolver::SymmetricPositiveSolver(const SparseMatrix& A) : SymmetricPositiveSolver() {
  ensure(A.rows() == A.cols() && A.isCompressed(), "SymmetricPositiveSolver needs a square compressed matrix");
  const double filled = static_cast<double>(A.nonZeros());
  if (filled >= 0.25 * static_cast<double>(A.rows()) * static_cast<double>(A.cols())) {
    *this = SymmetricPositiveSolver(Matrix(A));
    return;
  }
  factor_->n = static_cast<int>(A.rows());
  factor_->sparse = std::make_unique<SparseCholesky>(A);
}

Matrix SymmetricPositiveSolver::solve(const Matrix& B) const {
  ensure(B.rows() == factor_->n, "SymmetricPositiveSolver::solve: sizes differ");
  if (factor_->sparse) return factor_->sparse->solve(B);
  Matrix X = B.transpose();
  factor_->L.divide(X);
  factor_->L.divide(X, true);
  return X.transpose();
}

Matrix SymmetricPositiveSolver::inverse_block(const std::vector<int>& indices) const {
  const int m = static_cast<int>(indices.size());
  Matrix block = Matrix::Zero(m, m);
  if (!factor_->sparse) {
    Matrix E = Matrix::Zero(m, factor_->n);
    for (int j = 0; j < m; ++j) E(j, indices[static_cast<std::size_t>(j)]) = 1.0;
    factor_->L.divide(E);
    subtract_square(E, block);
    block = -Matrix(block.selfadjointView<Eigen::Lower>());
    return block;
  }
  constexpr int at_a_time = 64;  // dense right-hand sides: bounded memory
  for (int first = 0; first < m; first += at_a_time) {
    const int count = std::min(at_a_time, m - first);
    Matrix E = Matrix::Zero(factor_->n, count);
    for (int j = 0; j < count; ++j) E(indices[static_cast<std::size_t>(first + j)], j) = 1.0;
    const Matrix X = factor_->sparse->solve(E);
    for (int i = 0; i < m; ++i) block.block(i, first, 1, count) = X.row(indices[static_cast<std::size_t>(i)]);
  }
  return 0.5 * (block + block.transpose());
}

}  // namespace scabo::linalg
