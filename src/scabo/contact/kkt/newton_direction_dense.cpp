// Directions where W is dense.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"

namespace scabo::contact {

namespace {

constexpr GmresOptions refining_gmres{1e-13, 40, 80};
constexpr GmresOptions line_gmres{1e-12, 40, 40};
constexpr double as_good_as_double = 1e-11;  // residual of a direction by GMRES
// Beside soft springs a regular matrix has 1e-13 and less; refinement says whether its digits suffice.
constexpr double least_condition = 1e-15;
constexpr double rounding = 1e-15;
constexpr Eigen::Index most_orthogonal = 120;  // unknowns of an orthogonal decomposition, ten times as expensive

}  // namespace

bool NewtonDirection::solve_dense(double regularisation) {
  const Problem& problem = equations_.problem();
  const bool is_dense = problem.W.is_dense();
  const Matrix &W = is_dense ? problem.W.matrix() : problem.W.dense(), &G = problem.G.dense();
  const double factor = is_dense ? problem.W.factor() : 1.0;
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = problem.G.cols(), d = problem.dimension, n = size + m;
  Matrix& A = work_->A;
  if (A.rows() < W.rows() + m) A.resize(W.rows() + m, W.rows() + m), work_->factor.resize(A.rows(), A.rows());
  y_.resize(right_.size());
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& from = unknowns_[static_cast<std::size_t>(j)];
    work_->column.setZero(W.rows());
    for (Eigen::Index k = 0; k < d; ++k)
      if (from.column[k] != 0.0) work_->column.noalias() += from.column[k] * W.col(d * from.pair + k);
    for (Eigen::Index row = 0; row < size; ++row) {
      const Unknown& to = unknowns_[static_cast<std::size_t>(row)];
      double sum = 0.0;
      for (Eigen::Index k = 0; k < d; ++k) sum += to.row[k] * work_->column[d * to.pair + k];
      A(row, j) = to.scale * (factor * sum);
    }
    A(j, j) += regularisation * (1.0 - from.own) + from.own;
    for (Eigen::Index g = 0; g < m; ++g) {
      double force = 0.0, motion = 0.0;
      for (Eigen::Index k = 0; k < d; ++k) {
        force += from.column[k] * G(d * from.pair + k, g);
        motion += from.row[k] * G(d * from.pair + k, g);
      }
      A(size + g, j) = force;
      A(j, size + g) = from.scale * motion;
    }
  }
  if (m > 0) A.block(size, size, m, m) = -regularisation * Matrix::Identity(m, m);
  if (n == 0) return true;
  const auto right = right_.head(n);
  auto y = y_.head(n);
  work_->residual.resize(right_.size());
  auto residual = work_->residual.head(n);
  const auto matrix = A.topLeftCorner(n, n);
  work_->factor.topLeftCorner(n, n) = matrix;
  const double scale = 1e-9 * right.lpNorm<Eigen::Infinity>();
  if (work_->solver.factorise(work_->factor, n) && work_->solver.reciprocal_condition() > least_condition) {
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
    if (y.allFinite() && (left <= scale || left <= rounding * (matrix.cwiseAbs() * y.cwiseAbs()).maxCoeff()))
      return true;
  }
  if (n <= most_orthogonal) {  // the shortest solution, if there is one
    Eigen::CompleteOrthogonalDecomposition<Matrix> shortest;
    shortest.setThreshold(1e-11);
    shortest.compute(matrix);
    y = shortest.solve(right);
    return y.allFinite() && (matrix * y - right).lpNorm<Eigen::Infinity>() <= scale;
  }
  work_->factor.topLeftCorner(n, n) = matrix;
  for (Eigen::Index j = 0; j < size; ++j)
    work_->factor(j, j) += Workspace::raise * (1.0 - unknowns_[static_cast<std::size_t>(j)].own);
  if (!work_->solver.factorise(work_->factor, n)) return false;
  const auto multiply = [&](const Vector& x, Vector& result) { result = matrix * x; };
  const auto precondition = [&](const Vector& x, Vector& result) {
    result = x;
    work_->solver.solve_in_place(result);
  };
  Vector x = Vector::Zero(n);
  const double left = gmres(multiply, precondition, right, x, Workspace::singular_gmres);
  y = x;
  return y.allFinite() && left <= Workspace::descending;
}

bool NewtonDirection::solve_preconditioned(double regularisation,
                                           const std::function<void(const Vector&, Vector&)>& precondition,
                                           const GmresOptions& options) {
  const auto n = static_cast<Eigen::Index>(unknowns_.size()) + equations_.problem().G.cols();
  const auto multiply = [&](const Vector& x, Vector& result) { apply(x, regularisation, result); };
  const Vector right = right_.head(n);
  y_.setZero(n);
  const double left = gmres(multiply, precondition, right, y_, options);
  return y_.allFinite() && left <= as_good_as_double;
}

bool NewtonDirection::solve_along_joints(double regularisation) {
  const Problem& problem = equations_.problem();
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index d = problem.dimension;
  Combinations rows, columns;
  Vector diagonal(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    for (Eigen::Index k = 0; k < d; ++k) {
      if (unknown.row[k] != 0.0) rows.add(d * unknown.pair + k, unknown.scale * unknown.row[k]);
      if (unknown.column[k] != 0.0) columns.add(d * unknown.pair + k, unknown.column[k]);
    }
    rows.close();
    columns.close();
    diagonal[j] = regularisation * (1.0 - unknown.own) + unknown.own;
  }
  work_->line_fails = true;
  if (!work_->along_joints.factorise(problem, rows, columns, diagonal)) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { work_->along_joints.solve(x, result); };
  work_->line_fails = !solve_preconditioned(regularisation, precondition, line_gmres);
  return !work_->line_fails;
}

bool NewtonDirection::solve_by_single_precision(double regularisation) {
  const Problem& problem = equations_.problem();
  const Matrix &W = problem.W.matrix(), &G = problem.G.dense();
  const double factor = problem.W.factor();
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = problem.G.cols(), d = problem.dimension, n = size + m;
  Eigen::MatrixXf& A = work_->single;
  A.resize(n, n);
  // Rows and columns of a motion, [component of a pair, weight], without those of weight 0.
  struct Entry {
    Eigen::Index component;
    double weight;
  };
  std::vector<Entry> rows;
  std::vector<Eigen::Index> first_of_row(static_cast<std::size_t>(size + 1), 0);
  for (Eigen::Index row = 0; row < size; ++row) {
    const Unknown& to = unknowns_[static_cast<std::size_t>(row)];
    for (Eigen::Index k = 0; k < d; ++k)
      if (to.row[k] != 0.0) rows.push_back({d * to.pair + k, to.scale * to.row[k]});
    first_of_row[static_cast<std::size_t>(row + 1)] = static_cast<Eigen::Index>(rows.size());
  }
  const auto motions_of_rows = [&](const auto& motion, auto&& into) {
    for (Eigen::Index row = 0; row < size; ++row) {
      double sum = 0.0;
      for (Eigen::Index e = first_of_row[static_cast<std::size_t>(row)];
           e < first_of_row[static_cast<std::size_t>(row + 1)]; ++e)
        sum += rows[static_cast<std::size_t>(e)].weight * motion[rows[static_cast<std::size_t>(e)].component];
      into[row] = static_cast<float>(sum);
    }
  };
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& from = unknowns_[static_cast<std::size_t>(j)];
    work_->column.setZero(W.rows());
    for (Eigen::Index k = 0; k < d; ++k)
      if (from.column[k] != 0.0) work_->column.noalias() += (factor * from.column[k]) * W.col(d * from.pair + k);
    motions_of_rows(work_->column, A.col(j));
    A(j, j) += static_cast<float>(regularisation * (1.0 - from.own) + from.own);
    for (Eigen::Index g = 0; g < m; ++g) {
      double force = 0.0;
      for (Eigen::Index k = 0; k < d; ++k) force += from.column[k] * G(d * from.pair + k, g);
      A(size + g, j) = static_cast<float>(force);
    }
  }
  for (Eigen::Index g = 0; g < m; ++g) motions_of_rows(G.col(g), A.col(size + g));
  if (m > 0) A.block(size, size, m, m) = static_cast<float>(-regularisation) * Eigen::MatrixXf::Identity(m, m);
  if (!work_->single_solver.factorise(A)) return false;
  const auto precondition = [&](const Vector& x, Vector& result) { work_->single_solver.solve(x, result); };
  work_->single_fails = !solve_preconditioned(regularisation, precondition, refining_gmres);
  return !work_->single_fails;
}

}  // namespace scabo::contact
