// Directions where W is sparse: of many bodies.
#include <algorithm>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"

namespace scabo::contact {

bool NewtonDirection::solve_sparse() {
  const SystemConstants& c = system_constants;
  Workspace& work = *work_;
  Eigen::SparseMatrix<double>& A = work.sparse;
  work.saddle->assemble(rows_, A);
  const linalg::SparseGeneralSolver& factor = work.saddle->factor();
  const Vector right = right_.head(A.rows());
  if (!work.redundant && work.saddle->factorise(rows_, A) && factor.reciprocal_condition() > c.least_of_sparse) {
    factor.solve(right, y_);
    work.residual = right - A * y_;
    factor.solve(work.residual, work.image);
    y_ += work.image;  // one step of refinement: the certificate is judged at 1e-10
    work.residual = right - A * y_;
    if (y_.allFinite() && work.residual.lpNorm<Eigen::Infinity>() <= c.exact * right.lpNorm<Eigen::Infinity>())
      return true;
  }
  work.redundant = true;
  Eigen::SparseMatrix<double> raised = A;
  for (Eigen::Index j = 0; j < rows_.size(); ++j) raised.coeffRef(j, j) += c.raise * (1.0 - own_[j]);
  if (!work.saddle->factorise(rows_, raised) || !(factor.reciprocal_condition() > c.least_of_raised)) return false;
  return solve_preconditioned([&](const Vector& x, Vector& y) { factor.solve(x, y); }, c.singular_gmres, c.descending);
}

/// Pairs of rigid bodies are redundant: the raised matrix preconditions GMRES.
bool NewtonDirection::solve_rigid() {
  const auto own = own_.head(rows_.size()).array();
  RigidSystem& rigid = *work_->rigid;
  if (!rigid.factorise(rows_, std::max(rows_.E, system_constants.raise) * (1.0 - own) + own)) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { rigid.solve(x, result); };
  return solve_preconditioned(precondition, system_constants.singular_gmres, system_constants.descending);
}

}  // namespace scabo::contact
