#include "scabo/contact/kkt/preconditioners.hpp"

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
  return (A_.factorise(rows.size(), fill, c.line_fine) || A_.factorise(rows.size(), fill, c.line_coarse)) &&
         eliminate_motions(problem, rows);
}

bool PairPreconditioner::factorise(const Problem& problem, const SaddleRows& rows) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  if (diagonal_.size() == 0) diagonal_ = problem.W.diagonal_blocks(problem.dimension);
  first_.assign(static_cast<std::size_t>(N) + 1, 0);
  inverse_.assign(static_cast<std::size_t>(N), Eigen::Matrix3d::Identity());
  for (const int pair : rows.pair) ++first_[static_cast<std::size_t>(pair) + 1];
  for (Eigen::Index i = 0; i < N; ++i) {
    const auto pair = static_cast<std::size_t>(i);
    const Eigen::Index first = first_[pair], count = first_[pair + 1];
    first_[pair + 1] += first_[pair];
    Eigen::Matrix3d block = Eigen::Matrix3d::Identity();
    block.topLeftCorner(count, count) = rows.L.block(0, first, d, count).transpose() * diagonal_.middleCols(d * i, d) *
                                        rows.C.block(0, first, d, count);
    block.diagonal().head(count) += rows.D.segment(first, count);
    if (const Eigen::Matrix3d inverse = block.inverse(); inverse.allFinite()) inverse_[pair] = inverse;
  }
  return eliminate_motions(problem, rows);
}

void PairPreconditioner::solve_forces(const Vector& x, Vector& y) const {
  y.resize(x.size());
  for (std::size_t i = 0; i < inverse_.size(); ++i) {
    const int from = first_[i], count = first_[i + 1] - from;
    y.segment(from, count).noalias() = inverse_[i].topLeftCorner(count, count) * x.segment(from, count);
  }
}

bool Preconditioner::eliminate_motions(const Problem& problem, const SaddleRows& rows) {
  const Eigen::Index m = problem.G.cols();
  F_.resize(m, rows.size());
  if (m == 0) return true;
  const Matrix M = motions_of(rows, rows.L, problem);
  F_ = motions_of(rows, rows.C, problem).transpose();
  solved_.resize(rows.size(), m);
  Vector y;
  for (Eigen::Index k = 0; k < m; ++k) {
    solve_forces(M.col(k), y);
    solved_.col(k) = y;
  }
  if (!solved_.allFinite()) return false;
  balance_.compute(F_ * solved_ + rows.E * Matrix::Identity(m, m));
  return balance_.rcond() > system_constants.least_of_balance;
}

void Preconditioner::solve(const Vector& x, Vector& result) const {
  const Eigen::Index m = F_.rows(), size = x.size() - m;
  Vector y;
  solve_forces(x.head(size), y);
  result.resize(x.size());
  if (m > 0) {
    const Vector da = balance_.solve(F_ * y - x.tail(m));
    y.noalias() -= solved_ * da;
    result.tail(m) = da;
  }
  result.head(size) = y;
}

}  // namespace scabo::contact
