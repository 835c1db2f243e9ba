#include "scabo/linalg/sparse_general_solver.hpp"

#include <umfpack.h>

#include <algorithm>
#include <new>

#include "scabo/base/error.hpp"

namespace scabo::linalg {

struct SparseGeneralSolver::Factor {
  const Eigen::SparseMatrix<double>* A = nullptr;
  void *symbolic = nullptr, *numeric = nullptr;
  std::vector<int> outer, inner;  // pattern that `symbolic` is of
  double control[UMFPACK_CONTROL];
  std::vector<int> indices;
  std::vector<double> room;

  Factor() {
    umfpack_di_defaults(control);
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control[UMFPACK_IRSTEP] = 0;  // who calls refines with the matrix that he means
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    forget_pattern();
    forget();
  }
  void forget() {
    if (numeric != nullptr) umfpack_di_free_numeric(&numeric);
    numeric = nullptr;
  }
  void forget_pattern() {
    if (symbolic != nullptr) umfpack_di_free_symbolic(&symbolic);
    symbolic = nullptr;
  }
  bool same_pattern(const Eigen::SparseMatrix<double>& other) const {
    return symbolic != nullptr &&
           std::equal(outer.begin(), outer.end(), other.outerIndexPtr(),
                      other.outerIndexPtr() + other.outerSize() + 1) &&
           std::equal(inner.begin(), inner.end(), other.innerIndexPtr(), other.innerIndexPtr() + other.nonZeros());
  }
};

SparseGeneralSolver::SparseGeneralSolver() : factor_(std::make_unique<Factor>()) {}
SparseGeneralSolver::~SparseGeneralSolver() = default;
SparseGeneralSolver::SparseGeneralSolver(SparseGeneralSolver&&) noexcept = default;
SparseGeneralSolver& SparseGeneralSolver::operator=(SparseGeneralSolver&&) noexcept = default;

bool SparseGeneralSolver::factorise(const Eigen::SparseMatrix<double>& A) {
  ensure(A.rows() == A.cols() && A.isCompressed(),
         "SparseGeneralSolver: a square matrix in compressed columns is wanted");
  factor_->forget();
  factor_->A = &A;
  reciprocal_condition_ = 1.0;
  if (A.rows() == 0) return true;
  const auto n = static_cast<int>(A.rows());
  double info[UMFPACK_INFO];
  int status = UMFPACK_OK;
  if (!factor_->same_pattern(A)) {
    factor_->forget_pattern();
    factor_->outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + n + 1);
    factor_->inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    status = umfpack_di_symbolic(n, n, A.outerIndexPtr(), A.innerIndexPtr(), nullptr, &factor_->symbolic,
                                 factor_->control, info);
  }
  if (status == UMFPACK_OK)
    status = umfpack_di_numeric(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), factor_->symbolic,
                                &factor_->numeric, factor_->control, info);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  reciprocal_condition_ = status == UMFPACK_OK ? info[UMFPACK_RCOND] : 0.0;
  return status == UMFPACK_OK;
}

void SparseGeneralSolver::solve(const Vector& b, Vector& x) const {
  const Eigen::SparseMatrix<double>& A = *factor_->A;
  ensure(b.size() == A.rows(), "SparseGeneralSolver: matrix and right-hand side differ in size");
  x.resize(b.size());
  if (b.size() == 0) return;
  factor_->indices.resize(static_cast<std::size_t>(b.size()));
  factor_->room.resize(static_cast<std::size_t>(b.size()));
  umfpack_di_wsolve(UMFPACK_A, A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), x.data(), b.data(), factor_->numeric,
                    factor_->control, nullptr, factor_->indices.data(), factor_->room.data());
}

}  // namespace scabo::linalg
