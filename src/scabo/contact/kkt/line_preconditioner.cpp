#include "scabo/contact/kkt/line_preconditioner.hpp"

#include "scabo/contact/constants.hpp"

namespace scabo::contact {

namespace {

/// [L or C]' G, n x m.
Matrix motions_of(const SaddleRows& rows, const SaddleRows::Columns& of, const Problem& problem) {
  const Eigen::Index d = problem.dimension;
  Matrix result(rows.size(), problem.G.cols());
  for (Eigen::Index j = 0; j < rows.size(); ++j)
    result.row(j) =
        of.col(j).head(d).transpose() * problem.G.dense().middleRows(d * rows.pair[static_cast<std::size_t>(j)], d);
  return result;
}

}  // namespace

bool LinePreconditioner::factorise(const Problem& problem, const SaddleRows& rows) {
  const Matrix& W = problem.W.matrix();
  const double factor = problem.W.factor();
  const Eigen::Index d = problem.dimension;
  const auto first_of = [&](Eigen::Index unknown) { return d * rows.pair[static_cast<std::size_t>(unknown)]; };
  Vector motion;
  const auto fill = [&](Eigen::Index row, Eigen::Index column, Matrix& block) {
    if (block.size() == 0) return;
    const Eigen::Index begin = first_of(row), count = first_of(row + block.rows() - 1) + d - begin;
    for (Eigen::Index j = 0; j < block.cols(); ++j) {
      motion.setZero(count);
      for (Eigen::Index k = 0; k < d; ++k)
        if (const double C = rows.C(k, column + j); C != 0.0)
          motion += (factor * C) * W.col(first_of(column + j) + k).segment(begin, count);
      for (Eigen::Index i = 0; i < block.rows(); ++i)
        block(i, j) = rows.L.col(row + i).head(d).dot(motion.segment(first_of(row + i) - begin, d)) +
                      (row + i == column + j ? rows.D[row + i] : 0.0);
    }
  };
  const auto& c = system_constants;
  if (!A_.factorise(rows.size(), fill, c.line_fine) && !A_.factorise(rows.size(), fill, c.line_coarse)) return false;
  const Eigen::Index m = problem.G.cols();
  if (m == 0) return true;
  const Matrix M = motions_of(rows, rows.L, problem);
  F_ = motions_of(rows, rows.C, problem).transpose();
  solved_.resize(rows.size(), m);
  for (Eigen::Index g = 0; g < m; ++g) {
    A_.solve(M.col(g), y_);
    solved_.col(g) = y_;
  }
  if (!solved_.allFinite()) return false;
  balance_.compute(F_ * solved_);
  return balance_.rcond() > c.least_of_balance;
}

void LinePreconditioner::solve(const Vector& x, Vector& result) const {
  const Eigen::Index size = A_.size(), m = x.size() - size;
  part_ = x.head(size);
  A_.solve(part_, y_);
  result.resize(x.size());
  if (m > 0) {
    da_ = balance_.solve(Vector(F_ * y_ - x.tail(m)));
    y_.noalias() -= solved_ * da_;
    result.tail(m) = da_;
  }
  result.head(size) = y_;
}

}  // namespace scabo::contact
