#include "scabo/linalg/symmetric_positive_solver.hpp"

#include "scabo/base/error.hpp"
#include "scabo/linalg/cholesky_factor.hpp"
#include "scabo/linalg/sparse_factor.hpp"

namespace scabo::linalg {

struct SymmetricPositiveSolver::Factor {
  int n = 0;
  CholeskyFactor L;                      // dense
  std::unique_ptr<SparseFactor> sparse;  // otherwise
  FactorisationCosts costs;
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

SymmetricPositiveSolver::SymmetricPositiveSolver(int n, std::unique_ptr<SparseFactor> factor,
                                                 const FactorisationCosts& costs)
    : SymmetricPositiveSolver() {
  factor_->n = n;
  factor_->sparse = std::move(factor);
  factor_->costs = costs;
}

SymmetricPositiveSolver::SymmetricPositiveSolver(const SparseMatrix& A, const SparseOptions& options)
    : SymmetricPositiveSolver() {
  ensure(A.rows() == A.cols() && A.isCompressed(), "SymmetricPositiveSolver needs a square compressed matrix");
  const double filled = static_cast<double>(A.nonZeros());
  if (filled >= 0.25 * static_cast<double>(A.rows()) * static_cast<double>(A.cols())) {
    *this = SymmetricPositiveSolver(Matrix(A));
    return;
  }
  factor_->n = static_cast<int>(A.rows());
  factor_->sparse =
      (options.library == SparseLibrary::mumps ? factorise_by_mumps : factorise_by_cholmod)(A, options, factor_->costs);
}

Matrix SymmetricPositiveSolver::solve(const Matrix& B) const {
  ensure(B.rows() == factor_->n, "SymmetricPositiveSolver::solve: sizes differ");
  if (factor_->sparse) return factor_->sparse->solve(B);
  Matrix X = B.transpose();
  factor_->L.divide(X);
  factor_->L.divide(X, true);
  return X.transpose();
}

Vector SymmetricPositiveSolver::begin(const Vector& b) const {
  ensure(b.size() == factor_->n, "SymmetricPositiveSolver::begin: sizes differ");
  return factor_->sparse ? factor_->sparse->begin(b) : b;
}

Vector SymmetricPositiveSolver::solve_at(const Vector& begun, const std::vector<int>& wanted) const {
  ensure(begun.size() == factor_->n, "SymmetricPositiveSolver::solve_at: sizes differ");
  if (wanted.empty()) return Vector();
  return factor_->sparse ? factor_->sparse->solve_at(begun, wanted) : Vector(solve(begun)(wanted, 0));
}

Vector SymmetricPositiveSolver::solve_from(const Vector& begun, const Vector& more) const {
  ensure(begun.size() == factor_->n && more.size() == factor_->n, "SymmetricPositiveSolver::solve_from: sizes differ");
  return factor_->sparse ? factor_->sparse->solve_from(begun, more) : Vector(solve(begun + more));
}

Matrix SymmetricPositiveSolver::inverse_block(const std::vector<int>& indices) const {
  if (factor_->sparse) return factor_->sparse->inverse_block(indices);
  const int m = static_cast<int>(indices.size());
  Matrix block = Matrix::Zero(m, m);
  Matrix E = Matrix::Zero(m, factor_->n);
  for (int j = 0; j < m; ++j) E(j, indices[static_cast<std::size_t>(j)]) = 1.0;
  factor_->L.divide(E);
  subtract_square(E, block);
  return -Matrix(block.selfadjointView<Eigen::Lower>());
}

const FactorisationCosts& SymmetricPositiveSolver::costs() const { return factor_->costs; }

}  // namespace scabo::linalg
