#include "scabo/linalg/single_precision_solver.hpp"

#include <lapacke.h>

#include "scabo/base/error.hpp"

namespace scabo::linalg {

bool SinglePrecisionSolver::factorise(Eigen::MatrixXf& A) {
  ensure(A.rows() == A.cols(), "SinglePrecisionSolver: the matrix is not square");
  factor_ = &A;
  const auto n = static_cast<int>(A.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  if (n == 0) return true;
  return LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, n, n, A.data(), n, pivots_.data()) == 0 && A.diagonal().allFinite();
}

void SinglePrecisionSolver::solve(const Vector& x, Vector& result) const {
  const auto n = static_cast<int>(factor_->rows());
  ensure(x.size() == n, "SinglePrecisionSolver: sizes differ");
  const double largest = n > 0 ? x.lpNorm<Eigen::Infinity>() : 0.0;
  if (largest == 0.0) {
    result.setZero(n);
    return;
  }
  rounded_ = (x / largest).cast<float>();
  LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, factor_->data(), n, pivots_.data(), rounded_.data(), n);
  result = largest * rounded_.cast<double>();
}

}  // namespace scabo::linalg
