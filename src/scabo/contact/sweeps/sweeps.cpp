#include "scabo/contact/sweeps/sweeps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

/// The changes of the last sweeps, and the forces extrapolated from them.
class Extrapolation {
 public:
  explicit Extrapolation(Index size) : size_(size) {}

  /// `p`, `motion`: after a sweep from the forces `before`.
  [[gnu::hot]] void apply(const Vector& before, Vector& p, Vector& motion) {
    if (memory_.size() == 0) memory_.resize(3 * size_ * (depth + 1));
    double* const f = column(depth, 0);
    double* const last_p = column(depth, 1);
    double* const last_motion = column(depth, 2);
    const int slot = next_ % depth;
    double *df = column(slot, 0), *dp = column(slot, 1), *du = column(slot, 2);
    for (Index k = 0; k < size_; ++k) {
      const double f_k = p[k] - before[k];
      df[k] = f_k - f[k];
      dp[k] = p[k] - last_p[k];
      du[k] = motion[k] - last_motion[k];
      f[k] = f_k;
      last_p[k] = p[k];
      last_motion[k] = motion[k];
    }
    if (!has_last_) {
      has_last_ = true;
      return;
    }
    ++next_;
    count_ = std::min(count_ + 1, depth);
    for (int j = 0; j < count_; ++j) gram_[slot][j] = gram_[j][slot] = dot(df, column(j, 0));
    double gamma[depth];
    for (int j = 0; j < count_; ++j) gamma[j] = dot(column(j, 0), f);
    if (!least_squares(gamma)) return;
    for (int j = 0; j < count_; ++j) {
      const double part = gamma[j], *p_j = column(j, 1), *u_j = column(j, 2);
      for (Index k = 0; k < size_; ++k) {
        p[k] -= part * p_j[k];
        motion[k] -= part * u_j[k];
      }
    }
  }

  void forget() { count_ = next_ = 0, has_last_ = false; }

 private:
  static constexpr int depth = 5;

  double* column(int slot, int kind) { return memory_.data() + (3 * slot + kind) * size_; }
  [[gnu::hot]] double dot(const double* a, const double* b) const {
    double sum = 0.0;
    for (Index k = 0; k < size_; ++k) sum += a[k] * b[k];
    return sum;
  }

  /// Cholesky factorisation of the Gram matrix; its diagonal is increased by a relative 1e-10, in case the changes are
  /// nearly equal.
  [[gnu::hot]] bool least_squares(double* x) const {
    double L[depth][depth];
    for (int i = 0; i < count_; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = gram_[i][j] * (i == j ? 1.0 + 1e-10 : 1.0);
        for (int k = 0; k < j; ++k) sum -= L[i][k] * L[j][k];
        if (i != j) {
          L[i][j] = sum / L[j][j];
        } else {
          if (!(sum > 0.0)) return false;
          L[i][i] = std::sqrt(sum);
        }
      }
    for (int i = 0; i < count_; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= L[i][k] * x[k];
      x[i] /= L[i][i];
    }
    for (int i = count_ - 1; i >= 0; --i) {
      for (int k = i + 1; k < count_; ++k) x[i] -= L[k][i] * x[k];
      x[i] /= L[i][i];
      if (!std::isfinite(x[i])) return false;
    }
    return true;
  }

  Index size_;
  Vector memory_;  // columns [df, dp, du] of each slot, and [f, p, u] of the last sweep
  double gram_[depth][depth];
  int count_ = 0, next_ = 0;
  bool has_last_ = false;
};

template <int d>
class Sweeps {
 public:
  [[gnu::hot]] Sweeps(const Problem& problem, Vector p, const Measure& measure)
      : problem_(problem), measure_(measure), p_(std::move(p)), sweeps_(problem) {
    sweeps_.start(p_, motion_);
  }

  [[gnu::hot]] SweepsEnd run(double tolerance, const Deadline& deadline) {
    constexpr int most = 2000, window = 30;
    std::array<double, window> least_before;
    Extrapolation extrapolation(p_.size());
    SweepsEnd end;
    double least = HUGE_VAL, least_since = HUGE_VAL;
    before_ = p_;
    while (end.sweeps < most) {
      interruption_point();
      deadline.spend(operations_of_sweep(problem_));
      sweeps_.sweep(p_, motion_);
      ++end.sweeps;
      double figure = measure_.natural_map(problem_, p_, motion_);
      if (figure <= tolerance) {
        sweeps_.start(p_, motion_);  // the motion anew, without accumulated rounding
        figure = measure_.natural_map(problem_, p_, motion_);
        if (figure <= tolerance && measure_.rounding(problem_, p_, motion_) <= tolerance) {
          end.content = true;
          end.residual = largest_equation();
          break;
        }
        extrapolation.forget();
      }
      double& before = least_before[static_cast<std::size_t>(end.sweeps % window)];
      if (figure < least) {
        least = end.natural_map = figure;
        end.p = p_;
        end.motion = motion_;
      }
      if (end.sweeps > window && !(4.0 * least <= before)) break;
      if (deadline.passed()) break;
      before = least;
      if (figure > 2.0 * least_since) {
        extrapolation.forget();
        least_since = figure;
      } else {
        least_since = std::min(least_since, figure);
        if (end.sweeps > 1) extrapolation.apply(before_, p_, motion_);
      }
      before_ = p_;
    }
    if (end.content || end.p.size() == 0) {
      end.p = std::move(p_);
      end.motion = std::move(motion_);
    }
    if (!end.content) sweeps_.start(end.p, end.motion);  // anew, without accumulated rounding, for the judge
    return end;
  }

 private:
  /// With r = 1 / W_ii, one for all tangents; for a pair that nothing moves only its forces count.
  [[gnu::hot]] double largest_equation() const {
    double largest = 0.0;
    for (Index i = 0; i < problem_.pairs(); ++i) {
      const PairProblem<d>& pair = sweeps_.pairs()[static_cast<std::size_t>(i)];
      const double *p = p_.data() + d * i, *u = motion_.data() + d * i;
      const double W_t = d == 2 ? pair.W()[3] : 0.5 * (pair.W()[d + 1] + pair.W()[d * d - 1]);
      const double r_t = W_t > 0.0 ? 1.0 / W_t : 0.0;
      double trial[2] = {p[1] - r_t * u[1], d == 3 ? p[d - 1] - r_t * u[d - 1] : 0.0};
      const double bound = problem_.mu_against(i, trial[0]) * std::max(p[0], 0.0);
      const double size = std::sqrt(trial[0] * trial[0] + trial[1] * trial[1]);
      const double lambda = size > bound ? bound / size : 1.0;
      largest = std::max({largest, std::abs(std::min(pair.inverse() * u[0], p[0])), std::abs(p[1] - lambda * trial[0]),
                          d == 3 ? std::abs(p[d - 1] - lambda * trial[1]) : 0.0});
    }
    return largest;
  }

  const Problem& problem_;
  const Measure& measure_;
  Vector p_, before_, motion_;
  PairSweeps<d> sweeps_;
};

}  // namespace

[[gnu::hot]] bool may_accelerate(const Problem& problem) {
  return problem.G.cols() == 0 && problem.cohesion.size() == 0 && problem.tension.size() == 0 &&
         (problem.W.is_dense() || problem.W.is_sparse());
}

[[gnu::hot]] SweepsEnd accelerated_sweeps(const Problem& problem, Vector p, double tolerance, const Measure& measure,
                                          const Deadline& deadline) {
  return problem.dimension == 2 ? Sweeps<2>(problem, std::move(p), measure).run(tolerance, deadline)
                                : Sweeps<3>(problem, std::move(p), measure).run(tolerance, deadline);
}

}  // namespace scabo::contact
