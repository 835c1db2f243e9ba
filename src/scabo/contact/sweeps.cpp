#include "scabo/contact/sweeps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scabo/contact/certificate.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

/// A pair's own problem, prepared once. In the plane the second tangent does not exist.
struct Pair {
  double W[9];          ///< its block, by columns
  double inverse, mu;   ///< 1 / W_nn; 0 where no force moves it
  double nt[2], tn[2];  ///< W_nt, W_tn / W_nn
  double A[2][2];       ///< W_tt - W_tn W_nt / W_nn
  double determinant;   ///< of A; 0: singular
  double s;             ///< in space, of the sweep before; 0: none
};

template <int d>
[[gnu::hot]] void prepare(Pair& pair, double mu) {
  const double* W = pair.W;
  pair.mu = mu;
  pair.s = 0.0;
  pair.inverse = W[0] > 0.0 ? 1.0 / W[0] : 0.0;
  double scale = 0.0;
  for (int k = 1; k < d; ++k) {
    scale += W[d * k + k];
    pair.nt[k - 1] = W[d * k];
    pair.tn[k - 1] = W[k] * pair.inverse;
  }
  for (int k = 0; k < d - 1; ++k)
    for (int j = 0; j < d - 1; ++j) pair.A[j][k] = W[d * (k + 1) + j + 1] - pair.tn[j] * pair.nt[k];
  const double size = d == 2 ? scale : scale * scale;
  pair.determinant = d == 2 ? pair.A[0][0] : pair.A[0][0] * pair.A[1][1] - pair.A[0][1] * pair.A[1][0];
  if (!(pair.determinant > 1e-14 * size)) pair.determinant = 0.0;
  if (!(scale > 0.0)) pair.mu = 0.0;  // nothing moves along the tangents
}

/// Slip in space: p_t from g(s) = 0; c is not 0.
[[gnu::hot]] void slip(Pair& pair, double a_n, const double* c, double* p_t) {
  const double(&A)[2][2] = pair.A;
  const double m = pair.mu * pair.inverse, mean = 0.5 * (A[0][0] + A[1][1]);
  double low = 0.0, high = HUGE_VAL, s = pair.s;
  // Without history: exact where normal and tangents are not coupled and both tangents are alike.
  if (!(s > 0.0)) s = std::max(std::sqrt(c[0] * c[0] + c[1] * c[1]) / (-m * a_n) - mean, 1e-3 * mean);
  if (!(s > 0.0 && s < HUGE_VAL)) s = 1.0 / pair.inverse;
  double N[2], determinant = 1.0;
  for (int k = 0; k < 80; ++k) {
    const double a = A[0][0] + s, b = A[1][1] + s;
    N[0] = A[0][1] * c[1] - b * c[0];
    N[1] = A[1][0] * c[0] - a * c[1];
    determinant = a * b - A[0][1] * A[1][0];
    const double size = std::sqrt(N[0] * N[0] + N[1] * N[1]);
    const double g = size + m * (a_n * determinant + pair.nt[0] * N[0] + pair.nt[1] * N[1]);
    if (std::abs(g) <= 1e-15 * size) break;
    (g > 0.0 ? low : high) = s;
    const double slope =
        -(N[0] * c[0] + N[1] * c[1]) / size + m * (a_n * (a + b) - pair.nt[0] * c[0] - pair.nt[1] * c[1]);
    double next = s - g / slope;
    if (!(next > low && next < high)) next = high < HUGE_VAL ? 0.5 * (low + high) : 4.0 * s;
    const double step = std::abs(next - s);
    // p_t at `next` without another round: N and det are linear and quadratic in s.
    if (step <= 1e-9 * s) {
      const double ds = next - s;
      N[0] -= ds * c[0];
      N[1] -= ds * c[1];
      determinant += ds * (a + b + ds);
      s = next;
      break;
    }
    s = next;
  }
  pair.s = s;
  p_t[0] = N[0] / determinant;
  p_t[1] = N[1] / determinant;
}

/// The force of a pair whose motion is `free` without it.
template <int d>
[[gnu::hot]] void solve_pair(Pair& pair, const double* free, double* force) {
  const double a_n = free[0];
  for (int k = 0; k < d; ++k) force[k] = 0.0;
  if (!(a_n < 0.0) || pair.inverse == 0.0) return;  // open
  force[0] = -a_n * pair.inverse;
  if (pair.mu == 0.0) return;
  double c[2] = {free[1] - pair.tn[0] * a_n, d == 3 ? free[2] - pair.tn[1] * a_n : 0.0};
  double p_t[2] = {0.0, 0.0};
  if (c[0] == 0.0 && c[1] == 0.0) return;
  if (pair.determinant > 0.0) {  // stick
    const double part = 1.0 / pair.determinant;
    p_t[0] = d == 2 ? -c[0] * part : (pair.A[0][1] * c[1] - pair.A[1][1] * c[0]) * part;
    if (d == 3) p_t[1] = (pair.A[1][0] * c[0] - pair.A[0][0] * c[1]) * part;
    const double p_n = -(a_n + pair.nt[0] * p_t[0] + (d == 3 ? pair.nt[1] * p_t[1] : 0.0)) * pair.inverse;
    if (p_n >= 0.0 && p_t[0] * p_t[0] + p_t[1] * p_t[1] <= pair.mu * pair.mu * p_n * p_n) {
      force[0] = p_n;
      for (int k = 1; k < d; ++k) force[k] = p_t[k - 1];
      return;
    }
  }
  if (d == 2) {
    const double along = c[0] > 0.0 ? -pair.mu : pair.mu, resistance = pair.W[0] + along * pair.nt[0];
    if (!(resistance > 0.0)) return;
    force[0] = -a_n / resistance;
    force[1] = along * force[0];
    return;
  }
  slip(pair, a_n, c, p_t);
  const double p_n = -(a_n + pair.nt[0] * p_t[0] + pair.nt[1] * p_t[1]) * pair.inverse;
  if (!(p_n >= 0.0) || !std::isfinite(p_n)) return;
  force[0] = p_n;
  for (int k = 1; k < d; ++k) force[k] = p_t[k - 1];
}

/// The changes of the last sweeps, and the forces that they foretell.
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

  /// Cholesky of the Gram matrix; its diagonal is raised by 1e-10 of itself, for changes that are all but the
  /// same.
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
  [[gnu::hot]] Sweeps(const Problem& problem, Vector p)
      : problem_(problem), p_(std::move(p)), pairs_(static_cast<std::size_t>(problem.pairs())) {
    if (problem.W.is_sparse()) {
      const Eigen::SparseMatrix<double>& W = problem.W.sparse();
      columns_ = W.outerIndexPtr();
      rows_ = W.innerIndexPtr();
      values_ = W.valuePtr();
    } else {
      values_ = problem.W.dense().data();
    }
    for (Index i = 0; i < problem.pairs(); ++i) {
      Pair& pair = pairs_[static_cast<std::size_t>(i)];
      read_block(i, pair.W);
      prepare<d>(pair, problem.mu[i]);
    }
    motion_.resize(p_.size());
    start();
  }

  [[gnu::hot]] SweepsEnd run(double tolerance) {
    constexpr int most = 2000, window = 30;
    std::array<double, window> least_before;
    Extrapolation extrapolation(p_.size());
    SweepsEnd end;
    double least = HUGE_VAL, least_since = HUGE_VAL;
    before_ = p_;
    while (end.sweeps < most) {
      sweep();
      ++end.sweeps;
      double figure = natural_map_residual_at(problem_, p_, motion_);
      if (figure <= tolerance) {
        start();  // the motion afresh, without what rounding added from pair to pair
        figure = natural_map_residual_at(problem_, p_, motion_);
        if (figure <= tolerance) {
          end.content = true;
          end.residual = largest_equation();
          break;
        }
        extrapolation.forget();
      }
      double& before = least_before[static_cast<std::size_t>(end.sweeps % window)];
      least = std::min(least, figure);
      if (end.sweeps > window && !(4.0 * least <= before)) break;
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
    end.p = std::move(p_);
    end.motion = std::move(motion_);
    return end;
  }

 private:
  [[gnu::hot]] void read_block(Index i, double* block) const {
    const Index size = p_.size(), first = d * i;
    for (int k = 0; k < d; ++k) {
      double* const column = block + d * k;
      if (columns_ == nullptr) {
        for (int j = 0; j < d; ++j) column[j] = values_[(first + k) * size + first + j];
        continue;
      }
      for (int j = 0; j < d; ++j) column[j] = 0.0;
      for (int t = columns_[first + k]; t < columns_[first + k + 1]; ++t) {
        const Index row = rows_[t] - first;
        if (row >= 0 && row < d) column[row] += values_[t];
      }
    }
  }

  /// motion += W (columns of pair i) change.
  [[gnu::hot]] void add(Index i, const double* change) {
    const Index size = p_.size(), first = d * i;
    double* const motion = motion_.data();
    if (columns_ == nullptr) {
      const double *W_n = values_ + first * size, *W_t = W_n + size, *W_s = W_n + (d - 1) * size;
      if (d == 2)
        for (Index k = 0; k < size; ++k) motion[k] += W_n[k] * change[0] + W_t[k] * change[1];
      else
        for (Index k = 0; k < size; ++k)
          motion[k] += W_n[k] * change[0] + W_t[k] * change[1] + W_s[k] * change[d - 1];
      return;
    }
    for (int k = 0; k < d; ++k)
      if (const double step = change[k]; step != 0.0)
        for (int t = columns_[first + k]; t < columns_[first + k + 1]; ++t)
          motion[rows_[t]] += values_[t] * step;
  }

  [[gnu::hot]] void start() {
    motion_ = problem_.q;
    for (Index i = 0; i < problem_.pairs(); ++i) add(i, p_.data() + d * i);
  }

  [[gnu::hot]] void sweep() {
    for (Index i = 0; i < problem_.pairs(); ++i) {
      Pair& pair = pairs_[static_cast<std::size_t>(i)];
      double* const p = p_.data() + d * i;
      const double* const motion = motion_.data() + d * i;
      double free[d], next[d], change[d];
      bool moves = false;
      for (int k = 0; k < d; ++k) {
        free[k] = motion[k];
        for (int j = 0; j < d; ++j) free[k] -= pair.W[d * j + k] * p[j];
      }
      solve_pair<d>(pair, free, next);
      for (int k = 0; k < d; ++k) {
        change[k] = next[k] - p[k];
        moves = moves || change[k] != 0.0;
        p[k] = next[k];
      }
      if (moves) add(i, change);
    }
  }

  /// With r = 1 / W_ii, one for all tangents; a pair that nothing moves counts by its forces alone.
  [[gnu::hot]] double largest_equation() const {
    double largest = 0.0;
    for (Index i = 0; i < problem_.pairs(); ++i) {
      const Pair& pair = pairs_[static_cast<std::size_t>(i)];
      const double *p = p_.data() + d * i, *u = motion_.data() + d * i;
      const double W_t = d == 2 ? pair.W[3] : 0.5 * (pair.W[d + 1] + pair.W[d * d - 1]);
      const double r_t = W_t > 0.0 ? 1.0 / W_t : 0.0, bound = problem_.mu[i] * std::max(p[0], 0.0);
      double trial[2] = {p[1] - r_t * u[1], d == 3 ? p[d - 1] - r_t * u[d - 1] : 0.0};
      const double size = std::sqrt(trial[0] * trial[0] + trial[1] * trial[1]);
      const double lambda = size > bound ? bound / size : 1.0;
      largest = std::max({largest, std::abs(std::min(pair.inverse * u[0], p[0])),
                          std::abs(p[1] - lambda * trial[0]),
                          d == 3 ? std::abs(p[d - 1] - lambda * trial[1]) : 0.0});
    }
    return largest;
  }

  const Problem& problem_;
  Vector p_, before_, motion_;
  std::vector<Pair> pairs_;
  const double* values_ = nullptr;
  const int *columns_ = nullptr, *rows_ = nullptr;  // of a sparse W
};

}  // namespace

[[gnu::hot]] bool may_accelerate(const Problem& problem) {
  return problem.G.cols() == 0 && problem.cohesion.size() == 0 && problem.tension.size() == 0 &&
         (problem.W.is_dense() || problem.W.is_sparse());
}

[[gnu::hot]] SweepsEnd accelerated_sweeps(const Problem& problem, Vector p, double tolerance) {
  return problem.dimension == 2 ? Sweeps<2>(problem, std::move(p)).run(tolerance)
                                : Sweeps<3>(problem, std::move(p)).run(tolerance);
}

}  // namespace scabo::contact
