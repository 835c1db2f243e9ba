// Directions where W is dense.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"

namespace scabo::contact {

bool NewtonDirection::solve_dense() {
  const Problem& problem = equations_.problem();
  const Eigen::Index m = problem.G.cols(), n = rows_.size() + m, most = problem.W.size() + m;
  if (work_->A.rows() < most) work_->A.resize(most, most), work_->factor.resize(most, most);
  assemble_dense(problem, rows_, work_->full, work_->A);
  y_.resize(right_.size());
  work_->residual.resize(right_.size());
  return n == 0 || solve_regular(n) || solve_singular(n);
}

/// By LU of the matrix itself; false where it is singular to working precision.
bool NewtonDirection::solve_regular(Eigen::Index n) {
  const SystemConstants& c = system_constants;
  const auto right = right_.head(n);
  auto y = y_.head(n), residual = work_->residual.head(n);
  const auto matrix = work_->A.topLeftCorner(n, n);
  work_->factor.topLeftCorner(n, n) = matrix;
  if (!work_->solver.factorise(work_->factor, n) || !(work_->solver.reciprocal_condition() > c.least_of_dense))
    return false;
  y = right;
  work_->solver.solve_in_place(y_);
  residual = right;
  residual.noalias() -= matrix * y;
  work_->solver.solve_in_place(work_->residual);
  y += residual;  // one step of refinement: the certificate is judged at 1e-10
  residual = right;
  residual.noalias() -= matrix * y;
  const double left = residual.lpNorm<Eigen::Infinity>();
  // Beside soft springs a small step may cause large motions, whose rounding is all that is left.
  return y.allFinite() && (left <= c.exact * right.lpNorm<Eigen::Infinity>() ||
                           left <= c.rounding * (matrix.cwiseAbs() * y.cwiseAbs()).maxCoeff());
}

/// The shortest solution, if there is one; of many unknowns by GMRES with LU of the raised matrix.
bool NewtonDirection::solve_singular(Eigen::Index n) {
  const SystemConstants& c = system_constants;
  const Vector right = right_.head(n);
  auto y = y_.head(n);
  const auto matrix = work_->A.topLeftCorner(n, n);
  if (n <= c.most_orthogonal) {
    Eigen::CompleteOrthogonalDecomposition<Matrix> shortest;
    shortest.setThreshold(c.rank);
    shortest.compute(matrix);
    y = shortest.solve(right);
    return y.allFinite() && (matrix * y - right).lpNorm<Eigen::Infinity>() <= c.exact * right.lpNorm<Eigen::Infinity>();
  }
  work_->factor.topLeftCorner(n, n) = matrix;
  for (Eigen::Index j = 0; j < rows_.size(); ++j) work_->factor(j, j) += c.raise * (1.0 - own_[j]);
  if (!work_->solver.factorise(work_->factor, n)) return false;
  const auto multiply = [&](const Vector& x, Vector& result) { result = matrix * x; };
  const auto precondition = [&](const Vector& x, Vector& result) {
    result = x;
    work_->solver.solve_in_place(result);
  };
  Vector x = Vector::Zero(n);
  const double left = gmres(multiply, precondition, right, x, c.singular_gmres);
  y = x;
  return y.allFinite() && left <= c.descending;
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
