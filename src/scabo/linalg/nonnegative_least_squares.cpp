#include "scabo/linalg/nonnegative_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scabo/linalg/decompositions.hpp"

namespace scabo::linalg {

Vector nonnegative_least_squares(const Matrix& A, const Vector& b) {
  const Eigen::Index n = A.cols();
  Vector x = Vector::Zero(n);
  if (n == 0 || A.rows() == 0) return x;
  std::vector<int> passive;                                               // the x that may be positive
  const double small = 1e-15 * A.colwise().norm().maxCoeff() * b.norm();  // rounding of the gradient
  for (Eigen::Index round = 0; round < 3 * n + 10; ++round) {
    Vector gradient = A.transpose() * (b - A * x);
    for (int j : passive) gradient[j] = -1.0;
    Eigen::Index best = 0;
    if (gradient.maxCoeff(&best) <= small) break;
    passive.push_back(static_cast<int>(best));
    while (!passive.empty()) {
      const Vector z = A(Eigen::all, passive).completeOrthogonalDecomposition().solve(b);
      double step = 1.0;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double from = x[passive[k]], to = z[static_cast<Eigen::Index>(k)];
        if (to <= 0.0) step = std::min(step, from <= 0.0 ? 0.0 : from / (from - to));
      }
      std::vector<int> kept;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        double& value = x[passive[k]];
        value += step * (z[static_cast<Eigen::Index>(k)] - value);
        if (step == 1.0 || value > 1e-15 * x.cwiseAbs().maxCoeff())
          kept.push_back(passive[k]);
        else
          value = 0.0;
      }
      if (step == 1.0) break;
      passive = std::move(kept);
    }
  }
  return x;
}

namespace {

/// Columns of a positive semidefinite G that are in the solution, and the factor of their block.
class PassiveSet {
 public:
  explicit PassiveSet(const Matrix& G) : G_(G) {}

  const std::vector<int>& members() const { return members_; }
  bool empty() const { return members_.empty(); }
  void clear() { members_.clear(); }

  /// False, and unchanged, where column j depends on the others.
  bool append(int j) {
    const auto k = static_cast<Eigen::Index>(members_.size());
    if (L_.rows() == k) L_.conservativeResize(2 * k + 16, 2 * k + 16);
    Vector row(k);
    for (Eigen::Index i = 0; i < k; ++i) row[i] = G_(members_[static_cast<std::size_t>(i)], j);
    L_.topLeftCorner(k, k).triangularView<Eigen::Lower>().solveInPlace(row);
    const double left = G_(j, j) - row.squaredNorm();
    if (!(left > 1e-13 * G_(j, j))) return false;
    L_.row(k).head(k) = row.transpose();
    L_(k, k) = std::sqrt(left);
    members_.push_back(j);
    return true;
  }

  /// Of the members' equations with the right-hand side v.
  Vector solved(const Vector& v) const {
    Vector right = v(members_);
    const auto lower = L_.topLeftCorner(right.size(), right.size()).triangularView<Eigen::Lower>();
    lower.solveInPlace(right);
    lower.transpose().solveInPlace(right);
    return right;
  }

 private:
  const Matrix& G_;
  std::vector<int> members_;
  Matrix L_;  // L L' = G of the members, in the leading block
};

/// x goes to the solution of the members' equations; those that reach zero on the way leave, and the rest goes on.
void settle(const Vector& h, PassiveSet& passive, Vector& x, std::vector<bool>& dependent) {
  while (!passive.empty()) {
    const Vector z = passive.solved(h);
    const std::vector<int> members = passive.members();
    double step = 1.0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const double from = x[members[k]], to = z[static_cast<Eigen::Index>(k)];
      if (to <= 0.0) step = std::min(step, from <= 0.0 ? 0.0 : from / (from - to));
    }
    std::vector<int> kept;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const int j = members[k];
      x[j] += step * (z[static_cast<Eigen::Index>(k)] - x[j]);
      if (step == 1.0 || x[j] > 1e-15 * x.cwiseAbs().maxCoeff())
        kept.push_back(j);
      else
        x[j] = 0.0;
    }
    if (step == 1.0) return;
    passive.clear();
    for (const int j : kept)
      if (!passive.append(j)) x[j] = 0.0;
    std::fill(dependent.begin(), dependent.end(), false);
  }
}

}  // namespace

Vector nonnegative_least_squares_of_normal(const Matrix& G, const Vector& h,
                                           const std::function<Vector(const Vector& x)>& residual) {
  const Eigen::Index n = h.size();
  Vector x = Vector::Zero(n);
  if (n == 0) return x;
  const double small = 1e-10 * h.lpNorm<Eigen::Infinity>();
  PassiveSet passive(G);
  std::vector<bool> dependent(static_cast<std::size_t>(n), false);  // on the passive ones
  for (Eigen::Index round = 0; round < 3 * n + 10; ++round) {
    Vector gradient = h;
    for (const int j : passive.members()) gradient -= x[j] * G.col(j);
    for (Eigen::Index j = 0; j < n; ++j)
      if (dependent[static_cast<std::size_t>(j)]) gradient[j] = -1.0;
    for (const int j : passive.members()) gradient[j] = -1.0;
    Eigen::Index best = 0;
    if (gradient.maxCoeff(&best) <= small) break;
    if (passive.append(static_cast<int>(best)))
      settle(h, passive, x, dependent);
    else
      dependent[static_cast<std::size_t>(best)] = true;
  }
  // G has the squared condition of A; therefore x is refined with A itself.
  for (int round = 0; round < 6 && !passive.empty(); ++round) {
    const Vector change = passive.solved(residual(x));
    for (Eigen::Index k = 0; k < change.size(); ++k) {
      double& value = x[passive.members()[static_cast<std::size_t>(k)]];
      value = std::max(value + change[k], 0.0);
    }
  }
  return x;
}

}  // namespace scabo::linalg
