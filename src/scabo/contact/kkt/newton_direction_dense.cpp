// Directions where W is dense.
#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::contact {

bool NewtonDirection::solve_dense() {
  const Problem& problem = equations_.problem();
  const Eigen::Index m = problem.G.cols(), n = rows_.size() + m, most = problem.W.size() + m;
  if (work_->A.rows() < most) work_->A.resize(most, most), work_->factor.resize(most, most);
  assemble_dense(problem, rows_, work_->full, work_->A);
  y_.resize(right_.size());
  work_->residual.resize(right_.size());
  if (n == 0) return true;
  const SystemConstants& c = system_constants;
  DenseEnd end = solve_regular(n);
  if (end == DenseEnd::failed && n > c.most_orthogonal) end = solve_raised(n);
  if (end == DenseEnd::failed) return n <= c.most_orthogonal && solve_shortest(n, 0.0);
  if (end == DenseEnd::solved || n > c.most_shortest) return true;
  const Vector lost_in_rounding = y_;
  if (!solve_shortest(n, rounding_of(n))) y_ = lost_in_rounding;
  return true;
}

double NewtonDirection::residual_of(Eigen::Index n) const {
  auto residual = (work_->residual.head(n) = right_.head(n));
  residual.noalias() -= work_->A.topLeftCorner(n, n) * y_.head(n);
  return residual.lpNorm<Eigen::Infinity>();
}

/// What rounding may leave of the equations.
double NewtonDirection::rounding_of(Eigen::Index n) const {
  auto sum = work_->residual.head(n).setZero();
  for (Eigen::Index j = 0; j < n; ++j) sum += std::abs(y_[j]) * work_->A.col(j).head(n).cwiseAbs();
  return system_constants.rounding * sum.maxCoeff();
}

/// Beside soft springs a small step may cause large motions, and rounding is all that is left. Among redundant pairs it
/// may cause large forces that move nothing: the shortest solution has less rounding.
NewtonDirection::DenseEnd NewtonDirection::judged(Eigen::Index n, double most) const {
  if (!y_.head(n).allFinite()) return DenseEnd::failed;
  const double size = right_.head(n).lpNorm<Eigen::Infinity>(), rounding = rounding_of(n);
  if (residual_of(n) > std::max(most * size, rounding)) return DenseEnd::failed;
  return rounding <= system_constants.exact * size ? DenseEnd::solved : DenseEnd::lost_in_rounding;
}

/// By LU of the matrix itself.
NewtonDirection::DenseEnd NewtonDirection::solve_regular(Eigen::Index n) {
  work_->factor.topLeftCorner(n, n) = work_->A.topLeftCorner(n, n);
  if (!work_->solver.factorise(work_->factor, n) ||
      !(work_->solver.reciprocal_condition() > system_constants.least_of_dense))
    return DenseEnd::failed;
  y_.head(n) = right_.head(n);
  work_->solver.solve_in_place(y_);
  residual_of(n);
  work_->solver.solve_in_place(work_->residual);
  y_.head(n) += work_->residual.head(n);  // one step of refinement: the certificate is judged at 1e-10
  return judged(n, system_constants.exact);
}

/// By GMRES, with LU of the raised matrix.
NewtonDirection::DenseEnd NewtonDirection::solve_raised(Eigen::Index n) {
  const SystemConstants& c = system_constants;
  work_->factor.topLeftCorner(n, n) = work_->A.topLeftCorner(n, n);
  for (Eigen::Index j = 0; j < rows_.size(); ++j) work_->factor(j, j) += c.raise * (1.0 - own_[j]);
  if (!work_->solver.factorise(work_->factor, n)) return DenseEnd::failed;
  const auto precondition = [&](const Vector& x, Vector& y) { work_->solver.solve_in_place(y = x); };
  return solve_preconditioned(precondition, c.singular_gmres, c.descending) ? judged(n, c.descending)
                                                                            : DenseEnd::failed;
}

/// The shortest solution, if there is one to within `rounding`.
bool NewtonDirection::solve_shortest(Eigen::Index n, double rounding) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> shortest;
  shortest.setThreshold(system_constants.rank);
  shortest.compute(work_->A.topLeftCorner(n, n));
  y_.head(n) = shortest.solve(right_.head(n));
  const double exact = system_constants.exact * right_.head(n).lpNorm<Eigen::Infinity>();
  return y_.head(n).allFinite() && residual_of(n) <= std::max(exact, rounding);
}

bool NewtonDirection::solve_along_joints() {
  work_->line_fails = true;
  if (!work_->along_joints.factorise(equations_.problem(), rows_)) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { work_->along_joints.solve(x, result); };
  work_->line_fails =
      !solve_preconditioned(precondition, system_constants.line_gmres, system_constants.as_good_as_double);
  return !work_->line_fails;
}

bool NewtonDirection::solve_by_single_precision() {
  const Problem& problem = equations_.problem();
  const Eigen::Index n = rows_.size() + problem.G.cols();
  work_->single.resize(n, n);
  assemble_dense(problem, rows_, work_->full, work_->single);
  if (!work_->single_solver.factorise(work_->single)) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { work_->single_solver.solve(x, result); };
  work_->single_fails =
      !solve_preconditioned(precondition, system_constants.refining_gmres, system_constants.as_good_as_double);
  return !work_->single_fails;
}

}  // namespace scabo::contact
