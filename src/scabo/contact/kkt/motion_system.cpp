#include "scabo/contact/kkt/motion_system.hpp"

#include <algorithm>

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

/// [Y; G'].
Sparse motions_of(const Problem& problem) {
  const Index m = problem.G.cols(), n = problem.q.size();
  const Sparse& Y = *problem.W.bodies();
  Sparse both(n, Y.rows() + m);
  both.leftCols(Y.rows()) = Sparse(Y.transpose());
  if (m > 0) both.rightCols(m) = problem.G.sparse();
  return both.transpose();
}

}  // namespace

bool MotionSystem::is_of(const Problem& problem) {
  const Sparse* const Y = problem.W.bodies();
  return Y != nullptr && 2 * (Y->rows() + problem.G.cols()) <= problem.W.size();
}

MotionSystem::MotionSystem(const Problem& problem)
    : motions_(problem.G.cols()),
      dimension_(problem.dimension),
      V_(motions_of(problem)),
      matrix_(V_.rows(), V_.rows()) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < V_.rows(); ++k) entries.emplace_back(k, k, 0.0);
  for (Index first = 0; first < V_.cols(); first += dimension_) {
    std::vector<int> rows;
    for (Index k = first; k < first + dimension_; ++k)
      for (Sparse::InnerIterator it(V_, k); it; ++it) rows.push_back(static_cast<int>(it.row()));
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    V_of_pair_.push_back(Matrix::Zero(static_cast<Index>(rows.size()), dimension_));
    for (Index i = 0; i < V_of_pair_.back().rows(); ++i)
      for (int k = 0; k < dimension_; ++k)
        V_of_pair_.back()(i, k) = V_.coeff(rows[static_cast<std::size_t>(i)], first + k);
    for (const int column : rows)
      for (const int row : rows) entries.emplace_back(row, column, 0.0);
    rows_of_pair_.push_back(std::move(rows));
  }
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

bool MotionSystem::factorise(const SaddleRows& rows, const Vector& D) {
  rows_ = &rows;
  D_ = D.head(rows.size());
  matrix_.coeffs().setZero();
  matrix_.diagonal().setOnes();
  matrix_.diagonal().tail(motions_).setConstant(rows.E);
  for (std::size_t j = 0; j < rows.pair.size();) {
    const auto pair = static_cast<std::size_t>(rows.pair[j]);
    Eigen::Matrix3d bond = Eigen::Matrix3d::Zero();
    for (; j < rows.pair.size() && static_cast<std::size_t>(rows.pair[j]) == pair; ++j) {
      const auto column = static_cast<Index>(j);
      bond += rows.C.col(column) * rows.L.col(column).transpose() / D_[column];
    }
    const Matrix& V = V_of_pair_[pair];
    const Matrix sum = V * bond.topLeftCorner(dimension_, dimension_) * V.transpose();
    for (Index a = 0; a < sum.cols(); ++a)
      for (Index b = 0; b < sum.rows(); ++b)
        matrix_.coeffRef(rows_of_pair_[pair][static_cast<std::size_t>(b)],
                         rows_of_pair_[pair][static_cast<std::size_t>(a)]) += sum(b, a);
  }
  return lu_.factorise(matrix_);
}

void MotionSystem::solve(const Vector& b, Vector& x) const {
  const Index n = rows_->size();
  Vector p = Vector::Zero(V_.cols()), v;
  rows_->add_forces(b.head(n).cwiseQuotient(D_), dimension_, p);
  Vector right = V_ * p;
  right.tail(motions_) -= b.tail(motions_);
  lu_.solve(right, v);
  x.resize(b.size());
  rows_->motions(V_.transpose() * v, dimension_, x);
  x.head(n) = (b.head(n) - x.head(n)).cwiseQuotient(D_);
  x.tail(motions_) = v.tail(motions_);
}

}  // namespace scabo::contact
