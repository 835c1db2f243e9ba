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

/// Rigid bodies. Pairs are redundant there: the raised matrix preconditions GMRES.
bool NewtonDirection::solve_by_bodies() {
  const auto own = own_.head(rows_.size()).array();
  BodySystem& bodies = *work_->bodies;
  if (!bodies.factorise(rows_, std::max(rows_.E, system_constants.raise) * (1.0 - own) + own)) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { bodies.solve(x, result); };
  return solve_preconditioned(precondition, system_constants.singular_gmres, system_constants.descending);
}

/// The same by their joints, where W alone is known and these have many pairs.
template <int d>
bool NewtonDirection::solve_by_joints() {
  Workspace& work = *work_;
  std::optional<JointSystem<d>>& joints = std::get<d - 2>(work.joints);
  if (!work.joints_sought) {
    work.joints_sought = true;
    if (auto found = find_joints<d>(equations_.problem())) joints.emplace(std::move(*found));
  }
  if (!joints) return false;
  const Eigen::Index size = rows_.size();
  joints->pair = rows_.pair;
  joints->L.resize(size, JointSystem<d>::R);
  joints->C.resize(size, JointSystem<d>::R);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto& A = joints->A(rows_.pair[static_cast<std::size_t>(j)]);
    joints->L.row(j) = rows_.L.col(j).head<d>().transpose() * A;
    joints->C.row(j) = rows_.C.col(j).head<d>().transpose() * A;
  }
  const auto own = own_.head(size).array();
  joints->D = std::max(rows_.E, system_constants.raise) * (1.0 - own) + own;
  if (!joints->factorise()) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { joints->solve(x, result); };
  return solve_preconditioned(precondition, system_constants.singular_gmres, system_constants.descending);
}

template bool NewtonDirection::solve_by_joints<2>();
template bool NewtonDirection::solve_by_joints<3>();

}  // namespace scabo::contact
