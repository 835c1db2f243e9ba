#include "scabo/contact/kkt/saddle_matrix.hpp"

#include <algorithm>

namespace scabo::contact {

using Index = Eigen::Index;
using SparseMatrix = Eigen::SparseMatrix<double>;

void SaddleRows::resize(std::size_t n) {
  const auto size = static_cast<Index>(n);
  pair.resize(n);
  L.setZero(3, size);
  C.setZero(3, size);
  D.setZero(size);
}

void SaddleRows::add_forces(const Vector& z, int dimension, Vector& p) const {
  for (Index j = 0; j < size(); ++j)
    p.segment(dimension * pair[static_cast<std::size_t>(j)], dimension) += z[j] * C.col(j).head(dimension);
}

void SaddleRows::motions(const Vector& u, int dimension, Vector& result) const {
  for (Index j = 0; j < size(); ++j)
    result[j] = L.col(j).head(dimension).dot(u.segment(dimension * pair[static_cast<std::size_t>(j)], dimension));
}

Vector SaddleRows::times(const Problem& problem, const Vector& x) const {
  const Index n = size(), m = problem.G.cols();
  Vector p = Vector::Zero(problem.W.size()), u, result(n + m);
  add_forces(x, problem.dimension, p);
  problem.W.apply(p, u);
  if (m > 0) problem.G.add_motion(x.tail(m), u);
  motions(u, problem.dimension, result);
  result.head(n) += D.head(n).cwiseProduct(x.head(n));
  if (m > 0) result.tail(m) = problem.G.transpose() * p - E * x.tail(m);
  return result;
}

template <typename Scalar>
void assemble_dense(const Problem& problem, const SaddleRows& rows, Vector& moved,
                    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& A) {
  const bool is_dense = problem.W.is_dense();
  const Matrix &W = is_dense ? problem.W.matrix() : problem.W.dense(), &G = problem.G.dense();
  const double factor = is_dense ? problem.W.factor() : 1.0;
  const Index n = rows.size(), m = problem.G.cols(), d = problem.dimension;
  const auto gather = [&](Index column) {
    for (Index i = 0; i < n; ++i) {
      const double* const u = moved.data() + d * rows.pair[static_cast<std::size_t>(i)];
      const double* const L = rows.L.col(i).data();
      A(i, column) = static_cast<Scalar>(L[0] * u[0] + L[1] * u[1] + (d == 3 ? L[2] * u[2] : 0.0));
    }
  };
  for (Index j = 0; j < n; ++j) {
    const Index from = d * rows.pair[static_cast<std::size_t>(j)];
    Index first = 0;
    while (first + 1 < d && rows.C(first, j) == 0.0) ++first;
    moved.noalias() = (factor * rows.C(first, j)) * W.col(from + first);
    for (Index k = first + 1; k < d; ++k)
      if (rows.C(k, j) != 0.0) moved.noalias() += (factor * rows.C(k, j)) * W.col(from + k);
    gather(j);
    A(j, j) += static_cast<Scalar>(rows.D[j]);
    for (Index k = 0; k < m; ++k)
      A(n + k, j) = static_cast<Scalar>(G.col(k).segment(from, d).dot(rows.C.col(j).head(d)));
  }
  for (Index k = 0; k < m; ++k) {
    moved = G.col(k);
    gather(n + k);
    A.col(n + k).segment(n, m).setZero();
    A(n + k, n + k) = static_cast<Scalar>(-rows.E);
  }
}
template void assemble_dense<double>(const Problem&, const SaddleRows&, Vector&, Matrix&);
template void assemble_dense<float>(const Problem&, const SaddleRows&, Vector&, Eigen::MatrixXf&);

SparseSaddle::SparseSaddle(const Problem& problem)
    : problem_(problem), by_rows_(problem.q.size(), problem.G.cols()), moved_(3, problem.pairs()) {
  if (problem.G.cols() > 0) by_rows_ = problem.G.sparse();
  moved_.setZero();
  first_.push_back(0);
  for (Index j = 0; j < problem.pairs(); ++j) {
    const std::vector<int> beside = pairs_beside(problem, j, {static_cast<int>(j)});
    beside_.insert(beside_.end(), beside.begin(), beside.end());
    first_.push_back(beside_.size());
  }
}

void SparseSaddle::assemble(const SaddleRows& rows, SparseMatrix& A) {
  const SparseMatrix& W = problem_.W.sparse();
  const Index n = rows.size(), m = problem_.G.cols(), d = problem_.dimension;
  first_of_pair_.assign(static_cast<std::size_t>(problem_.pairs()) + 1, 0);
  for (const int pair : rows.pair) ++first_of_pair_[static_cast<std::size_t>(pair) + 1];
  for (std::size_t i = 1; i < first_of_pair_.size(); ++i) first_of_pair_[i] += first_of_pair_[i - 1];
  A.resize(n + m, n + m);
  A.reserve(3 * W.nonZeros() / 2 + 4 * by_rows_.nonZeros() + n + m);
  for (Index j = 0; j < n; ++j) {
    A.startVec(j);
    const auto pair = static_cast<std::size_t>(rows.pair[static_cast<std::size_t>(j)]);
    for (std::size_t at = first_[pair]; at < first_[pair + 1]; ++at) moved_.col(beside_[at]).setZero();
    for (Index k = 0; k < d; ++k)
      for (SparseMatrix::InnerIterator it(W, d * static_cast<Index>(pair) + k); it; ++it)
        moved_(it.row() % d, it.row() / d) += it.value() * rows.C(k, j);
    for (std::size_t at = first_[pair]; at < first_[pair + 1]; ++at) add_motion(rows, beside_[at], j, A);
    add_balance(rows, j, A);
  }
  for (Index motion = 0; motion < m; ++motion) {
    A.startVec(n + motion);
    for (RigidMap::Sparse::InnerIterator it(problem_.G.sparse(), motion); it;) {
      const Index pair = it.row() / d;
      moved_.col(pair).setZero();
      for (; it && it.row() / d == pair; ++it) moved_(it.row() % d, pair) = it.value();
      add_motion(rows, pair, n + motion, A);
    }
    if (rows.E > 0.0) A.insertBack(n + motion, n + motion) = -rows.E;
  }
  A.finalize();
}

/// Rows of a pair in a column, with its own D.
void SparseSaddle::add_motion(const SaddleRows& rows, Index pair, Index column, SparseMatrix& A) const {
  const auto p = static_cast<std::size_t>(pair);
  for (int i = first_of_pair_[p]; i < first_of_pair_[p + 1]; ++i)
    A.insertBack(i, column) = rows.L.col(i).dot(moved_.col(pair)) + (i == column ? rows.D[column] : 0.0);
}

/// Rows of the balance in the column of a force.
void SparseSaddle::add_balance(const SaddleRows& rows, Index column, SparseMatrix& A) {
  const Index d = problem_.dimension, from = d * rows.pair[static_cast<std::size_t>(column)];
  motions_.clear();
  for (Index k = 0; k < d && problem_.G.cols() > 0; ++k)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows_, from + k); it; ++it)
      motions_.emplace_back(it.col(), it.value() * rows.C(k, column));
  std::sort(motions_.begin(), motions_.end());
  for (std::size_t k = 0; k < motions_.size();) {
    double sum = 0.0;
    const Index motion = motions_[k].first;
    for (; k < motions_.size() && motions_[k].first == motion; ++k) sum += motions_[k].second;
    A.insertBack(rows.size() + motion, column) = sum;
  }
}

bool SparseSaddle::factorise(const SaddleRows& rows, const SparseMatrix& A) {
  if (problem_.G.cols() == 0) return factor_.factorise(A);
  return factor_.factorise(A, [&] {
    if (!order_) order_ = std::make_unique<JointOrder>(problem_);
    return order_->blocks(rows.pair);
  });
}

}  // namespace scabo::contact
