#include "scabo/linalg/replaced_rows.hpp"

#include <cblas.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "scabo/base/error.hpp"

namespace scabo::linalg {

namespace {

using Index = Eigen::Index;

/// Of the right-hand side, what a refined solution may leave. The inverse is then as good as a factorisation.
constexpr double left_over = 1e-10;
constexpr int refinements = 2;
/// Least change of the determinant, as a factor, after which the inverse is still taken from the one before.
constexpr double least_factor = 1e-8;
/// Where no more rows are to be replaced 1 + D'Y is factorised for each solve: close to a singular A its solutions are
/// as exact as they can be, and up to here it takes no longer than a solve with a large B.
constexpr Index few = 400;

}  // namespace

bool ReplacedRows::factorise(Eigen::SparseMatrix<double> B, Index most, const std::function<OrderedBlocks()>& blocks) {
  B_ = std::move(B);
  B_.makeCompressed();
  rows_.clear();
  differences_.clear();
  solved_.resize(B_.rows(), most);
  small_.resize(most, most);
  if (keeps_inverse()) inverse_.resize(most, most);
  place_.assign(static_cast<std::size_t>(B_.rows()), -1);
  return lu_.factorise(B_, blocks);
}

double ReplacedRows::times_difference(std::size_t at, const Eigen::Ref<const Vector>& x) const {
  double sum = 0.0;
  for (const auto& [column, value] : differences_[at]) sum += value * x[column];
  return sum;
}

void ReplacedRows::replace(int row, Row difference) {
  int& place = place_[static_cast<std::size_t>(row)];
  if (place < 0) {
    ensure(count() < small_.rows(), "ReplacedRows: more rows than room was made for");
    place = static_cast<int>(rows_.size());
    rows_.push_back(row);
    differences_.emplace_back();
    const Index k = count();
    Vector column;
    lu_.solve(Vector::Unit(B_.rows(), row), column);
    solved_.col(k - 1) = column;
    for (Index i = 0; i < k; ++i) small_(i, k - 1) = times_difference(static_cast<std::size_t>(i), column);
    small_.row(k - 1).head(k).setZero();
    small_(k - 1, k - 1) = 1.0;
    if (keeps_inverse()) {
      // Its difference is still zero: the last row of 1 + D'Y is that of the identity.
      const Vector last = inverse_.topLeftCorner(k - 1, k - 1) * small_.col(k - 1).head(k - 1);
      inverse_.col(k - 1).head(k - 1) = -last;
      inverse_.row(k - 1).head(k).setZero();
      inverse_(k - 1, k - 1) = 1.0;
    }
  }
  differences_[static_cast<std::size_t>(place)] = std::move(difference);
  const Index k = count(), at = place;
  Vector change(k);
  for (Index j = 0; j < k; ++j)
    change[j] = times_difference(static_cast<std::size_t>(at), solved_.col(j)) + (j == at ? 1.0 : 0.0) - small_(at, j);
  small_.row(at).head(k) += change.transpose();
  if (!keeps_inverse()) return;
  auto inverse = inverse_.topLeftCorner(k, k);
  const Vector column = inverse.col(at);
  const double factor = 1.0 + change.dot(column);
  if (std::isfinite(factor) && std::abs(factor) > least_factor) {
    const Eigen::RowVectorXd along = change.transpose() * inverse / factor;
    inverse.noalias() -= column * along;
  } else {
    factorised_solution(Vector::Zero(k));
  }
}

bool ReplacedRows::keeps_inverse() const { return small_.rows() > few; }

/// Where it is singular a body is held by nothing: with the least that working precision tells from zero it moves far.
Vector ReplacedRows::factorised_solution(const Vector& right) const {
  constexpr double least = 1e-13;
  const Index k = count();
  const Matrix S = small_.topLeftCorner(k, k);
  Eigen::PartialPivLU<Matrix> lu(S);
  Vector w = lu.solve(right);
  if (!w.allFinite()) {
    lu.compute(S + least * std::max(1.0, S.cwiseAbs().maxCoeff()) * Matrix::Identity(k, k));
    w = lu.solve(right);
  }
  if (keeps_inverse()) inverse_.topLeftCorner(k, k) = lu.inverse();
  return w;
}

Vector ReplacedRows::small_solution(const Vector& right) const {
  if (!keeps_inverse()) return factorised_solution(right);
  const Index k = count();
  const auto S = small_.topLeftCorner(k, k);
  const auto inverse = inverse_.topLeftCorner(k, k);
  const double aim = left_over * right.lpNorm<Eigen::Infinity>();
  Vector w = inverse * right, left = right - S * w;
  for (int again = 0; again < refinements && left.allFinite(); ++again) {
    w.noalias() += inverse * left;
    left = right - S * w;
    if (left.lpNorm<Eigen::Infinity>() <= aim) return w;
  }
  return factorised_solution(right);
}

void ReplacedRows::subtract(const Vector& w, Vector& y) const {
  const auto n = static_cast<double>(B_.rows());
  if (static_cast<double>(count()) * n < lu_.entries()) {
    cblas_dgemv(CblasColMajor, CblasNoTrans, static_cast<int>(B_.rows()), static_cast<int>(count()), -1.0,
                solved_.data(), static_cast<int>(B_.rows()), w.data(), 1, 1.0, y.data(), 1);
    return;
  }
  Vector sum = Vector::Zero(B_.rows()), x;
  for (Index i = 0; i < count(); ++i) sum[rows_[static_cast<std::size_t>(i)]] = w[i];
  lu_.solve(sum, x);
  y -= x;
}

void ReplacedRows::solve_from(const Vector& y, const Vector& c, Vector& x) const {
  const Index k = count();
  x = y;
  if (k == 0) return;
  // w = S^-1 D'(y + Y c) = S^-1 (D'y - c + S c) = c + S^-1 (D'y - c)
  Vector rest(k);
  for (Index i = 0; i < k; ++i) rest[i] = times_difference(static_cast<std::size_t>(i), y) - c[i];
  subtract(small_solution(rest), x);
}

Vector ReplacedRows::solve_before(const Vector& b) const {
  Vector x, more;
  lu_.solve(b, x);
  lu_.solve(b - B_ * x, more);
  return x + more;
}

bool ReplacedRows::solve(const Vector& b, Vector& x) const {
  Vector y, more;
  lu_.solve(b, y);
  const Vector none = Vector::Zero(count());
  solve_from(y, none, x);
  Vector left = b - B_ * x;
  for (std::size_t i = 0; i < rows_.size(); ++i) left[rows_[i]] -= times_difference(i, x);
  lu_.solve(left, y);
  solve_from(y, none, more);
  x += more;
  return x.allFinite();
}

}  // namespace scabo::linalg
