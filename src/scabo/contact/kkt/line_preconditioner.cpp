#include "scabo/contact/kkt/line_preconditioner.hpp"

#include <algorithm>

namespace scabo::contact {

namespace {

/// M: each sum of rows of G.
Matrix sums_of(const Combinations& sums, const Matrix& G) {
  Matrix result = Matrix::Zero(sums.size(), G.cols());
  for (Eigen::Index j = 0; j < sums.size(); ++j)
    for (std::size_t e = sums.first[static_cast<std::size_t>(j)]; e < sums.first[static_cast<std::size_t>(j + 1)]; ++e)
      result.row(j) += sums.weight[e] * G.row(sums.component[e]);
  return result;
}

}  // namespace

bool LinePreconditioner::factorise(const Problem& problem, const Combinations& rows, const Combinations& columns,
                                   const Vector& diagonal) {
  const Matrix& W = problem.W.matrix();
  const double factor = problem.W.factor();
  Vector motion;
  const auto fill = [&](Eigen::Index row, Eigen::Index column, Matrix& block) {
    const std::size_t first = rows.first[static_cast<std::size_t>(row)],
                      last = rows.first[static_cast<std::size_t>(row + block.rows())];
    if (first == last || block.cols() == 0) return;
    const auto [low, high] = std::minmax_element(rows.component.begin() + static_cast<std::ptrdiff_t>(first),
                                                 rows.component.begin() + static_cast<std::ptrdiff_t>(last));
    const Eigen::Index begin = *low, count = *high - *low + 1;
    for (Eigen::Index j = 0; j < block.cols(); ++j) {
      const auto of = static_cast<std::size_t>(column + j);
      motion.setZero(count);
      for (std::size_t e = columns.first[of]; e < columns.first[of + 1]; ++e)
        motion += (factor * columns.weight[e]) * W.col(columns.component[e]).segment(begin, count);
      for (Eigen::Index i = 0; i < block.rows(); ++i) {
        double sum = row + i == column + j ? diagonal[row + i] : 0.0;
        for (std::size_t e = rows.first[static_cast<std::size_t>(row + i)];
             e < rows.first[static_cast<std::size_t>(row + i + 1)]; ++e)
          sum += rows.weight[e] * motion[rows.component[e] - begin];
        block(i, j) = sum;
      }
    }
  };
  constexpr double fine = 1e-8, coarse = 1e-6;  // of each block; of thousands of pairs ranks are too large for more
  if (!A_.factorise(rows.size(), fill, fine) && !A_.factorise(rows.size(), fill, coarse)) return false;
  const Eigen::Index m = problem.G.cols();
  if (m == 0) return true;
  const Matrix M = sums_of(rows, problem.G.dense());
  F_ = sums_of(columns, problem.G.dense()).transpose();
  solved_.resize(rows.size(), m);
  for (Eigen::Index g = 0; g < m; ++g) {
    A_.solve(M.col(g), y_);
    solved_.col(g) = y_;
  }
  if (!solved_.allFinite()) return false;
  balance_.compute(F_ * solved_);
  return balance_.rcond() > 1e-13;
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
