#include "scabo/linalg/general_solver.hpp"

#include <lapacke.h>

#include "scabo/base/error.hpp"

namespace scabo::linalg {

bool GeneralSolver::factorise(Matrix& A, Eigen::Index n) {
  factor_ = &A;
  n_ = n;
  norm_ = n > 0 ? A.topLeftCorner(n, n).cwiseAbs().colwise().sum().maxCoeff() : 0.0;
  if (static_cast<Eigen::Index>(pivots_.size()) < n) pivots_.resize(static_cast<std::size_t>(A.cols()));
  if (n == 0) return true;
  return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, static_cast<int>(n), static_cast<int>(n), A.data(),
                             static_cast<int>(A.outerStride()), pivots_.data()) == 0;
}

double GeneralSolver::reciprocal_condition() const {
  if (n_ == 0) return 1.0;
  if (static_cast<Eigen::Index>(whole_work_.size()) < n_) {
    work_.resize(static_cast<std::size_t>(2 * factor_->cols()));
    whole_work_.resize(static_cast<std::size_t>(factor_->cols()));
  }
  const auto n = static_cast<int>(n_);
  double *const x = work_.data(), *const v = x + n_;
  double norm_of_inverse = 0.0;
  int asked = 0, saved[3];
  while (true) {
    LAPACKE_dlacn2_work(n, v, x, whole_work_.data(), &norm_of_inverse, &asked, saved);
    if (asked == 0) return 1.0 / (norm_ * norm_of_inverse);
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, asked == 1 ? 'N' : 'T', n, 1, factor_->data(),
                        static_cast<int>(factor_->outerStride()), pivots_.data(), x, n);
  }
}

void GeneralSolver::solve_in_place(Vector& x) const {
  if (n_ == 0) return;
  ensure(x.size() >= n_, "GeneralSolver: the right-hand side is too short");
  LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', static_cast<int>(n_), 1, factor_->data(),
                      static_cast<int>(factor_->outerStride()), pivots_.data(), x.data(), static_cast<int>(x.size()));
}

}  // namespace scabo::linalg
