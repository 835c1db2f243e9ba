#include "scabo/contact/solvers/gauss_seidel.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <optional>

namespace scabo::contact::solvers {

namespace {

using Vec3 = Eigen::Vector3d;

/// Slip of one pair in space as a function of the direction e of its friction.
class SlipInSpace {
 public:
  SlipInSpace(const LocalMatrix& W, const Local& b, double mu) : W_(W), b_(b), mu_(mu) {}

  /// e x u_t times the denominator W_nn + mu W_nt e.
  double turn(double angle) const {
    const Vec2 e(std::cos(angle), std::sin(angle));
    return cross(e, denominator(e) * b_.tail<2>() - b_[0] * sliding(e));
  }

  /// The forces at an angle where turn = 0; nothing where friction would not oppose slip.
  std::optional<Local> forces(double angle) const {
    const Vec2 e(std::cos(angle), std::sin(angle));
    if (denominator(e) <= 0.0) return std::nullopt;
    const double p_n = -b_[0] / denominator(e);
    const Vec2 u_t = b_.tail<2>() + p_n * sliding(e);
    if (e.dot(u_t) > 0.0) return std::nullopt;
    Local p(3);
    p << p_n, mu_ * p_n * e;
    return p;
  }

  /// A zero between two angles with different signs (Illinois variant of the secant method).
  double zero(double from, double to) const {
    double at_from = turn(from), at_to = turn(to);
    for (int k = 0; k < 80 && std::abs(to - from) > 1e-16; ++k) {
      const double middle = to - at_to * (to - from) / (at_to - at_from);
      const double at_middle = turn(middle);
      if (at_middle == 0.0) return middle;
      if (at_middle * at_to < 0.0) {
        from = to;
        at_from = at_to;
      } else {
        at_from *= 0.5;
      }
      if (std::abs(middle - to) < 1e-16) return middle;
      to = middle;
      at_to = at_middle;
    }
    return to;
  }

 private:
  double denominator(const Vec2& e) const { return W_(0, 0) + mu_ * (W_(0, 1) * e[0] + W_(0, 2) * e[1]); }
  Vec2 sliding(const Vec2& e) const {  // u_t per p_n
    return Vec2(W_(1, 0), W_(2, 0)) +
           mu_ * Vec2(W_(1, 1) * e[0] + W_(1, 2) * e[1], W_(2, 1) * e[0] + W_(2, 2) * e[1]);
  }

  const LocalMatrix& W_;
  const Local& b_;
  double mu_;
};

std::optional<Local> slip_in_space(const LocalMatrix& W, const Local& free, double mu, const Local& last) {
  const SlipInSpace slip(W, free, mu);
  const auto between = [&](double from, double to) -> std::optional<Local> {
    if (slip.turn(from) * slip.turn(to) > 0.0) return std::nullopt;
    return slip.forces(slip.zero(from, to));
  };
  if (last.tail<2>().squaredNorm() > 0.0) {
    const double angle = std::atan2(last[2], last[1]);
    for (double width : {1e-6, 1e-3, 0.1})
      if (const auto found = between(angle - width, angle + width)) return found;
  }
  constexpr int points = 32;
  constexpr double step = 2.0 * std::numbers::pi / points;
  for (int k = 0; k < points; ++k)
    if (const auto found = between(step * k, step * (k + 1))) return found;
  return std::nullopt;
}

std::optional<Local> slip_in_plane(const LocalMatrix& W, const Local& free, double mu) {
  for (double e : {1.0, -1.0}) {
    const double denominator = W(0, 0) + mu * W(0, 1) * e;
    if (denominator <= 0.0) continue;
    const double p_n = -free[0] / denominator, u_t = free[1] + (W(1, 0) + mu * W(1, 1) * e) * p_n;
    if (e * u_t <= 0.0) {
      Local p(2);
      p << p_n, mu * p_n * e;
      return p;
    }
  }
  return std::nullopt;
}

}  // namespace

Local one_pair(const LocalMatrix& W, const Local& free, double mu, const Local& last) {
  const Eigen::Index d = free.size();
  Local p = Local::Zero(d);
  if (free[0] >= 0.0 || W(0, 0) <= 0.0) return p;
  if (mu == 0.0) {
    p[0] = -free[0] / W(0, 0);
    return p;
  }
  const Eigen::FullPivLU<LocalMatrix> lu(W);
  if (lu.isInvertible()) {
    p = lu.solve(-free);
    if (p[0] >= 0.0 && p.tail(d - 1).norm() <= mu * p[0]) return p;
  }
  const std::optional<Local> slip = d == 2 ? slip_in_plane(W, free, mu) : slip_in_space(W, free, mu, last);
  if (slip) return *slip;
  Local u = free + W * last;
  u[0] += mu * u.tail(d - 1).norm();
  return contact::project_on_cone(Vector(last - u / W.norm()), mu);
}

End gauss_seidel(const Problem& problem, Vector p, const Control& control) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  const Matrix r = pair_stiffness(problem), blocks = problem.W.diagonal_blocks(problem.dimension);
  const bool sparse = problem.W.is_sparse();
  End end;
  Best best(end);
  std::vector<int> before;
  const int sweeps = 400 * control.iterations;
  Vector motion;
  for (int sweep = 0;; ++sweep) {
    if (sweep % 10 == 0 || sweep == sweeps) {
      motion = motion_of(problem, p, Vector());  // afresh: rounding piles up
      const Vector H = residual_of(problem, r, p, Vector());
      best.offer(p, Vector(), largest(H));
      const std::vector<int> states = states_at(problem, r, p, motion);
      end.trace.push_back(
          {sweep, largest(H), 0.5 * H.squaredNorm(), 1.0, changes(before, states), "gauss_seidel"});
      before = states;
      end.iterations = sweep;
      end.converged = largest(H) <= control.small;
      if (end.converged) return end;
      if (!p.allFinite() || sweep == sweeps) break;
    }
    for (Eigen::Index i = 0; i < N; ++i) {
      const LocalMatrix W = blocks.middleCols(d * i, d);
      const Local last = p.segment(d * i, d);
      const Local next = one_pair(W, motion.segment(d * i, d) - W * last, problem.mu[i], last);
      for (Eigen::Index k = 0; k < d; ++k) {
        const double step = next[k] - last[k];
        if (step == 0.0) continue;
        const Eigen::Index column = d * i + k;
        if (sparse)
          motion += step * problem.W.sparse().col(column);
        else
          motion.noalias() += step * problem.W.dense().col(column);
      }
      p.segment(d * i, d) = next;
    }
  }
  end.reason =
      p.allFinite() ? "the sweeps did not reach the tolerance in their limit" : "the sweeps went to infinity";
  return end;
}

}  // namespace scabo::contact::solvers
