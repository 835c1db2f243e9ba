#include "scabo/linalg/replaced_rows.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {

namespace {

using Index = Eigen::Index;

/// Of the right-hand side, what a refined solution may leave. The inverse is then as good as a factorisation.
constexpr double left_over = 1e-10;
constexpr int products = 8;          // with the inverse, most
constexpr double converging = 0.25;  // at least so much less after each
/// Least pivot of what the determinant changes by, as a factor, after which the inverse is still taken from the one
/// before.
constexpr double least_factor = 1e-8;
/// Where no more rows are to be replaced 1 + D'Y is factorised for each solve: close to a singular A its solutions are
/// as exact as they can be, and up to here it takes no longer than a solve with a large B.
constexpr Index few = 400;

/// P A = L U of LAPACK, which takes half as long as Eigen's for a thousand rows.
class DenseLU {
 public:
  explicit DenseLU(Matrix A) : lu_(std::move(A)), exchanged_(static_cast<std::size_t>(lu_.rows())) {
    if (lu_.rows() > 0) LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n(), n(), lu_.data(), n(), exchanged_.data());
  }
  void solve(Eigen::Ref<Matrix> X) const {
    if (lu_.rows() == 0 || X.cols() == 0) return;
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n(), static_cast<int>(X.cols()), lu_.data(), n(), exchanged_.data(),
                        X.data(), static_cast<int>(X.outerStride()));
  }
  Matrix inverse() const {
    Matrix X = lu_;
    std::vector<double> room(static_cast<std::size_t>(64 * n()));
    if (lu_.rows() > 0)
      LAPACKE_dgetri_work(LAPACK_COL_MAJOR, n(), X.data(), n(), exchanged_.data(), room.data(), 64 * n());
    return X;
  }
  double least_pivot() const { return lu_.diagonal().cwiseAbs().minCoeff(); }
  /// Of the determinant.
  int sign() const {
    int sign = 1;
    for (int i = 0; i < n(); ++i)
      if ((lu_(i, i) < 0.0) != (exchanged_[static_cast<std::size_t>(i)] != i + 1)) sign = -sign;
    return sign;
  }

 private:
  int n() const { return static_cast<int>(lu_.rows()); }
  Matrix lu_;
  std::vector<int> exchanged_;
};

}  // namespace

bool ReplacedRows::factorise(Eigen::SparseMatrix<double> B, Index may_be_substituted, Index most,
                             const std::function<OrderedBlocks(const std::vector<int>& kept)>& blocks) {
  B_ = std::move(B);
  B_.makeCompressed();
  rows_.clear();
  sign_ = 1;
  differences_.clear();
  solved_.resize(B_.rows(), most);
  small_.resize(most, most);
  if (keeps_inverse()) inverse_.resize(most, most);
  place_.assign(static_cast<std::size_t>(B_.rows()), -1);
  return lu_.factorise(B_, may_be_substituted, blocks);
}

void ReplacedRows::solve_with_factors(const Vector& b, Vector& x) const {
  Matrix X;
  lu_.solve(b, X);
  x = X.col(0);
}

double ReplacedRows::times_difference(std::size_t at, const Vector& x) const {
  double sum = 0.0;
  for (const auto& [column, value] : differences_[at]) sum += value * x[column];
  return sum;
}

void ReplacedRows::add_rows(const std::vector<Replaced>& changes) {
  const Index before = count();
  for (const Replaced& change : changes) {
    int& place = place_[static_cast<std::size_t>(change.row)];
    if (place >= 0) continue;
    ensure(count() < small_.rows(), "ReplacedRows: more rows than room was made for");
    place = static_cast<int>(rows_.size());
    rows_.push_back(change.row);
    differences_.emplace_back();
  }
  const Index k = count(), added = k - before;
  if (added == 0) return;
  Matrix units = Matrix::Zero(B_.rows(), added), columns;
  for (Index j = 0; j < added; ++j) units(rows_[static_cast<std::size_t>(before + j)], j) = 1.0;
  lu_.solve(units, columns);
  solved_.middleCols(before, added) = columns;
  auto of_others = small_.block(0, before, before, added);
  of_others.setZero();
  for (Index i = 0; i < before; ++i)
    for (const auto& [column, value] : differences_[static_cast<std::size_t>(i)])
      of_others.row(i) += value * solved_.row(column).segment(before, added);
  small_.block(before, 0, added, before).setZero();
  small_.block(before, before, added, added).setIdentity();
  if (!keeps_inverse()) return;
  // Their differences are still zero: the last rows of 1 + D'Y are those of the identity.
  inverse_.block(0, before, before, added).setZero();
  add_product(-1.0, inverse_.topLeftCorner(before, before), of_others, inverse_.block(0, before, before, added));
  inverse_.block(before, 0, added, before).setZero();
  inverse_.block(before, before, added, added).setIdentity();
}

void ReplacedRows::replace(std::vector<Replaced> changes) {
  if (changes.empty()) return;
  add_rows(changes);
  const Index k = count(), changed = static_cast<Index>(changes.size());
  std::vector<int> places;
  ByRows by(changed, k);  // what the rows of 1 + D'Y change by
  for (Replaced& change : changes) {
    const int at = place_[static_cast<std::size_t>(change.row)];
    auto row = by.row(static_cast<Index>(places.size()));
    row = -small_.row(at).head(k);
    row[at] += 1.0;
    for (const auto& [column, value] : change.difference) row += value * solved_.row(column).head(k);
    small_.row(at).head(k) += row;
    differences_[static_cast<std::size_t>(at)] = std::move(change.difference);
    places.push_back(at);
  }
  if (!keeps_inverse()) return;
  auto inverse = inverse_.topLeftCorner(k, k);
  const Matrix columns = inverse(Eigen::all, places);
  const DenseLU factors(Matrix::Identity(changed, changed) + by * columns);
  if (!(factors.least_pivot() > least_factor)) {
    factorised_solution(Vector::Zero(k));
    return;
  }
  sign_ *= factors.sign();
  Matrix along = Matrix::Zero(changed, k);
  add_product(1.0, by, inverse, along);
  factors.solve(along);
  add_product(-1.0, columns, along, inverse);
}

int ReplacedRows::sign() const {
  return keeps_inverse() ? sign_ : DenseLU(small_.topLeftCorner(count(), count())).sign();
}

bool ReplacedRows::keeps_inverse() const { return small_.rows() > few; }

/// Where it is singular a body is held by nothing: with the least that working precision tells from zero it moves far.
Vector ReplacedRows::factorised_solution(const Vector& right) const {
  constexpr double least = 1e-13;
  const Index k = count();
  const Matrix S = small_.topLeftCorner(k, k);
  DenseLU lu(S);
  Vector w = right;
  lu.solve(w);
  if (!w.allFinite()) {
    lu = DenseLU(S + least * std::max(1.0, S.cwiseAbs().maxCoeff()) * Matrix::Identity(k, k));
    w = right;
    lu.solve(w);
  }
  if (keeps_inverse()) {
    inverse_.topLeftCorner(k, k) = lu.inverse();
    sign_ = lu.sign();
  }
  return w;
}

Vector ReplacedRows::solution_by_inverse(const Vector& right, bool& exact) const {
  const Index k = count();
  const auto S = small_.topLeftCorner(k, k);
  const auto inverse = inverse_.topLeftCorner(k, k);
  const double aim = left_over * right.lpNorm<Eigen::Infinity>();
  Vector w = Vector::Zero(k), left = right;
  double before = HUGE_VAL;
  for (int product = 0; product < products && left.allFinite(); ++product) {
    w.noalias() += inverse * left;
    left = right - S * w;
    const double remains = left.lpNorm<Eigen::Infinity>();
    exact = remains <= aim;
    if (exact || remains > converging * before) break;
    before = remains;
  }
  return w;
}

Vector ReplacedRows::small_solution(const Vector& right) const {
  if (!keeps_inverse()) return factorised_solution(right);
  bool exact = right.isZero(0.0);
  Vector w = solution_by_inverse(right, exact);
  return exact ? w : factorised_solution(right);
}

void ReplacedRows::subtract(const Vector& w, Vector& y) const {
  const auto n = static_cast<double>(B_.rows());
  if (static_cast<double>(count()) * n < lu_.entries()) {
    cblas_dgemv(CblasRowMajor, CblasNoTrans, static_cast<int>(B_.rows()), static_cast<int>(count()), -1.0,
                solved_.data(), static_cast<int>(solved_.cols()), w.data(), 1, 1.0, y.data(), 1);
    return;
  }
  Vector sum = Vector::Zero(B_.rows()), x;
  for (Index i = 0; i < count(); ++i) sum[rows_[static_cast<std::size_t>(i)]] = w[i];
  solve_with_factors(sum, x);
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
  solve_with_factors(b, x);
  solve_with_factors(b - B_ * x, more);
  return x + more;
}

void ReplacedRows::solve_once(const Vector& b, Vector& x) const {
  Vector y;
  solve_with_factors(b, y);
  solve_from(y, Vector::Zero(count()), x);
}

bool ReplacedRows::is_of_replaced_rows(const Vector& b) const {
  for (Index row = 0; row < b.size(); ++row)
    if (b[row] != 0.0 && place_[static_cast<std::size_t>(row)] < 0) return false;
  return true;
}

void ReplacedRows::solve_roughly(const Vector& b, Vector& x) const {
  if (!keeps_inverse() || count() == 0) return solve_once(b, x);
  bool exact = false;
  Vector rest(count());
  if (is_of_replaced_rows(b)) {  // b = E c: x = Y S^-1 c
    for (Index i = 0; i < count(); ++i) rest[i] = -b[rows_[static_cast<std::size_t>(i)]];
    x.setZero(b.size());
  } else {
    solve_with_factors(b, x);
    for (Index i = 0; i < count(); ++i) rest[i] = times_difference(static_cast<std::size_t>(i), x);
  }
  subtract(solution_by_inverse(rest, exact), x);
}

bool ReplacedRows::solve(const Vector& b, Vector& x) const {
  Vector more;
  solve_once(b, x);
  Vector left = b - B_ * x;
  for (std::size_t i = 0; i < rows_.size(); ++i) left[rows_[i]] -= times_difference(i, x);
  solve_once(left, more);
  x += more;
  return x.allFinite();
}

}  // namespace scabo::linalg
