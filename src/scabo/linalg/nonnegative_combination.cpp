#include "scabo/linalg/nonnegative_combination.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::linalg {

namespace {

constexpr int most_steps = 100;
constexpr double combined = 1e-10;  // t, relative to its start, below which b counts as a combination
constexpr double proven = 1e-9;     // b'y / (|b| |y|) above which y counts as a proof
constexpr double rounding = 1e-12;  // A'y / |y| up to which it counts as not positive

/// The largest step along d, at most 1, that keeps v positive.
double step_length(const Vector& v, const Vector& d) {
  double step = 1.0;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (d[i] < 0.0) step = std::min(step, -0.995 * v[i] / d[i]);
  return step;
}

class FirstPhase {
 public:
  FirstPhase(const Eigen::SparseMatrix<double>& A, const Vector& b)
      : A_(with_artificial(A, b)), b_(b), c_(Vector::Unit(A_.cols(), A_.cols() - 1)) {
    x_.setOnes(A_.cols());
    s_.setOnes(A_.cols());
    y_.setZero(A_.rows());
  }

  std::optional<Vector> run() {
    for (int step = 0; step < most_steps; ++step) {
      if (const double size = y_.norm(); size > 0.0) {
        const Vector along = (A_.transpose() * y_).head(A_.cols() - 1);
        if (b_.dot(y_) > proven * b_.norm() * size && along.maxCoeff() <= rounding * size) return Vector(y_ / size);
      }
      if (x_[x_.size() - 1] <= combined) return std::nullopt;
      if (!advance()) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  static Eigen::SparseMatrix<double> with_artificial(const Eigen::SparseMatrix<double>& A, const Vector& b) {
    Eigen::SparseMatrix<double> wide(A.rows(), A.cols() + 1);
    const Vector artificial = b - A * Vector::Ones(A.cols());
    wide.reserve(A.nonZeros() + A.rows());
    for (Eigen::Index column = 0; column < A.cols(); ++column) {
      wide.startVec(column);
      for (Eigen::SparseMatrix<double>::InnerIterator it(A, column); it; ++it)
        wide.insertBack(it.row(), column) = it.value();
    }
    wide.startVec(A.cols());
    for (Eigen::Index row = 0; row < A.rows(); ++row) wide.insertBack(row, A.cols()) = artificial[row];
    wide.finalize();
    return wide;
  }

  /// One predictor-corrector step; false if numbers are out of range.
  bool advance() {
    const Eigen::Index n = A_.cols(), last = n - 1;
    const Vector primal = b_ - A_ * x_, dual = c_ - A_.transpose() * y_ - s_;
    const double mu = x_.dot(s_) / static_cast<double>(n);
    const Vector ratio = x_.cwiseQuotient(s_);
    // A D A' without the dense last column, which enters by the formula of Sherman and Morrison.
    Eigen::SparseMatrix<double> scaled = A_.leftCols(last);
    for (Eigen::Index column = 0; column < last; ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(scaled, column); it; ++it)
        it.valueRef() *= std::sqrt(ratio[column]);
    Eigen::SparseMatrix<double> M = scaled * scaled.transpose();
    const double raise = 1e-13 * (Vector(M.diagonal()).maxCoeff() + 1e-300);
    Eigen::SparseMatrix<double> identity(A_.rows(), A_.rows());
    identity.setIdentity();
    M += raise * identity;
    try {
      const SymmetricPositiveSolver solver(M);
      const Vector artificial = A_.col(last);
      const Vector moved = solver.solve(artificial);
      const double weight = ratio[last] / (1.0 + ratio[last] * artificial.dot(moved));
      const auto direction = [&](const Vector& centring, Vector& dx, Vector& dy, Vector& ds) {
        // centring: target of x s minus x s; A dx = primal, A'dy + ds = dual, s dx + x ds = centring.
        const Vector right = primal + A_ * Vector(ratio.cwiseProduct(dual) - centring.cwiseQuotient(s_));
        const Vector held = solver.solve(right);
        dy = held - weight * artificial.dot(held) * moved;
        ds = dual - A_.transpose() * dy;
        dx = centring.cwiseQuotient(s_) - ratio.cwiseProduct(ds);
      };
      Vector dx, dy, ds;
      direction(-x_.cwiseProduct(s_), dx, dy, ds);
      const double primal_step = step_length(x_, dx), dual_step = step_length(s_, ds);
      const double foreseen = (x_ + primal_step * dx).dot(s_ + dual_step * ds) / static_cast<double>(n);
      const double sigma = std::pow(foreseen / mu, 3);
      direction((sigma * mu - (x_.cwiseProduct(s_) + dx.cwiseProduct(ds)).array()).matrix(), dx, dy, ds);
      const double alpha = step_length(x_, dx), beta = step_length(s_, ds);
      x_ += alpha * dx;
      y_ += beta * dy;
      s_ += beta * ds;
      return x_.allFinite() && y_.allFinite() && s_.allFinite() && std::max(alpha, beta) > 1e-10;
    } catch (const NotPositiveDefinite&) {
      return false;
    }
  }

  Eigen::SparseMatrix<double> A_;  // the last column is the artificial one
  Vector b_, c_, x_, y_, s_;
};

}  // namespace

std::optional<Vector> separating_vector(const Eigen::SparseMatrix<double>& A, const Vector& b) {
  ensure(A.rows() == b.size(), "separating_vector: matrix and vector differ in size");
  const double size = b.norm();
  return size > 0.0 ? FirstPhase(A, b / size).run() : std::nullopt;
}

}  // namespace scabo::linalg
