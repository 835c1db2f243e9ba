#include "scabo/contact/sweeps/pair_problem.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::contact {

template <int d>
PairProblem<d>::PairProblem(const double* W, Friction mu, double cohesion, double tension)
    : mu_(mu), cohesion_(cohesion), tension_(tension) {
  std::copy_n(W, d * d, W_);
  inverse_ = W[0] > 0.0 ? 1.0 / W[0] : 0.0;
  double scale = 0.0;
  for (int k = 1; k < d; ++k) {
    scale += W[d * k + k];
    nt_[k - 1] = W[d * k];
    tn_[k - 1] = W[k] * inverse_;
  }
  for (int k = 0; k < d - 1; ++k)
    for (int j = 0; j < d - 1; ++j) A_[j][k] = W[d * (k + 1) + j + 1] - tn_[j] * nt_[k];
  const double size = d == 2 ? scale : scale * scale;
  determinant_ = d == 2 ? A_[0][0] : A_[0][0] * A_[1][1] - A_[0][1] * A_[1][0];
  if (!(determinant_ > 1e-14 * size)) determinant_ = 0.0;
  if (!(scale > 0.0)) {  // the pair cannot move tangentially
    mu_ = {};
    cohesion_ = 0.0;
  }
}

template <int d>
void PairProblem<d>::solve(const double* free, double* force) {
  const double a_n = free[0];
  std::fill_n(force, d, 0.0);
  if (inverse_ == 0.0) return;
  if (tension_ < HUGE_VAL && open(free, force)) return;
  std::fill_n(force, d, 0.0);
  force[0] = -a_n * inverse_;
  if (mu_.forward == 0.0 && mu_.backward == 0.0 && cohesion_ == 0.0) return;
  const double c[2] = {free[1] - tn_[0] * a_n, d == 3 ? free[2] - tn_[1] * a_n : 0.0};
  if (c[0] == 0.0 && c[1] == 0.0) return;
  if (stick(a_n, c, force) || slip(a_n, c, mu_, force)) return;
  if (cohesion_ == 0.0 || !slip(a_n, c, {}, force)) return;
  if (force[0] < -tension_) open(free, force);
}

/// The open state: full tension, with tangential motion held by cohesion. False if the sides would then overlap.
template <int d>
bool PairProblem<d>::open(const double* free, double* force) {
  const double u_n = free[0] - W_[0] * tension_;
  force[0] = 0.0 - tension_;  // no -0
  if (cohesion_ == 0.0) return !(u_n < 0.0);
  double c[2] = {0.0, 0.0};
  for (int k = 1; k < d; ++k) c[k - 1] = free[k] - W_[k] * tension_;
  if constexpr (d == 2) {
    force[1] = std::clamp(-c[0] / W_[3], -cohesion_, cohesion_);
  } else {
    const Tangential W_tt = {{W_[4], W_[7]}, {W_[5], W_[8]}};
    const double determinant = W_tt[0][0] * W_tt[1][1] - W_tt[0][1] * W_tt[1][0];
    double p_t[2] = {HUGE_VAL, 0.0};
    if (determinant > 0.0) {
      p_t[0] = (W_tt[0][1] * c[1] - W_tt[1][1] * c[0]) / determinant;
      p_t[1] = (W_tt[1][0] * c[0] - W_tt[0][0] * c[1]) / determinant;
    }
    if (!(std::hypot(p_t[0], p_t[1]) <= cohesion_)) slide(W_tt, 0.0, c, 0.0, p_t);
    std::copy_n(p_t, 2, force + 1);
  }
  return u_n + nt_[0] * force[1] + (d == 3 ? nt_[1] * force[d - 1] : 0.0) >= 0.0;
}

template <int d>
double PairProblem<d>::normal(double a_n, const double* p_t) const {
  return -(a_n + nt_[0] * p_t[0] + (d == 3 ? nt_[1] * p_t[1] : 0.0)) * inverse_;
}

template <int d>
bool PairProblem<d>::stick(double a_n, const double* c, double* force) const {
  if (determinant_ == 0.0) return false;
  const double part = 1.0 / determinant_;
  double p_t[2] = {0.0, 0.0};
  p_t[0] = d == 2 ? -c[0] * part : (A_[0][1] * c[1] - A_[1][1] * c[0]) * part;
  if (d == 3) p_t[1] = (A_[1][0] * c[0] - A_[0][0] * c[1]) * part;
  const double p_n = normal(a_n, p_t), bound = cohesion_ + mu_.against(p_t[0]) * std::max(p_n, 0.0);
  if (!(p_n >= -tension_ && p_t[0] * p_t[0] + p_t[1] * p_t[1] <= bound * bound)) return false;
  force[0] = p_n;
  std::copy_n(p_t, d - 1, force + 1);
  return true;
}

/// The force at the bound C + mu p_n; p_n >= 0 unless mu is 0. `force` does not change if there is none.
template <int d>
bool PairProblem<d>::slip(double a_n, const double* c, Friction friction, double* force) {
  double p_t[2] = {0.0, 0.0}, p_n, mu = friction.forward;
  if constexpr (d == 2) {
    const double along = c[0] > 0.0 ? -1.0 : 1.0;
    mu = friction.against(along);
    const double resistance = W_[0] + along * mu * nt_[0];
    if (!(resistance > 0.0)) return false;
    p_n = -(a_n + along * cohesion_ * nt_[0]) / resistance;
    p_t[0] = along * (cohesion_ + mu * p_n);
  } else {
    const double m = mu * inverse_;
    if (!(cohesion_ - m * a_n > 0.0)) return false;
    slide(A_, a_n, c, m, p_t);
    p_n = normal(a_n, p_t);
  }
  if (!std::isfinite(p_n) || (mu > 0.0 && p_n < 0.0)) return false;
  force[0] = p_n;
  std::copy_n(p_t, d - 1, force + 1);
  return true;
}

/// Slip in space: p_t from g(s) = 0, m = mu / W_nn; c is not 0.
template <int d>
void PairProblem<d>::slide(const Tangential& A, double a_n, const double* c, double m, double* p_t) {
  const double reach = cohesion_ - m * a_n, mean = 0.5 * (A[0][0] + A[1][1]);
  double low = 0.0, high = HUGE_VAL, s = s_;
  // Without history: exact if normal and tangential directions are not coupled and both tangential directions are
  // equal.
  if (!(s > 0.0)) s = std::max(std::sqrt(c[0] * c[0] + c[1] * c[1]) / reach - mean, 1e-3 * mean);
  if (!(s > 0.0 && s < HUGE_VAL)) s = W_[0];
  double N[2], determinant = 1.0;
  for (int k = 0; k < 80; ++k) {
    const double a = A[0][0] + s, b = A[1][1] + s;
    N[0] = A[0][1] * c[1] - b * c[0];
    N[1] = A[1][0] * c[0] - a * c[1];
    determinant = a * b - A[0][1] * A[1][0];
    const double size = std::sqrt(N[0] * N[0] + N[1] * N[1]);
    const double g = size + m * (nt_[0] * N[0] + nt_[1] * N[1]) - reach * determinant;
    if (std::abs(g) <= 1e-15 * size) break;
    (g > 0.0 ? low : high) = s;
    const double slope = -(N[0] * c[0] + N[1] * c[1]) / size - m * (nt_[0] * c[0] + nt_[1] * c[1]) - reach * (a + b);
    double next = s - g / slope;
    if (!(next > low && next < high)) next = high < HUGE_VAL ? 0.5 * (low + high) : 4.0 * s;
    const double step = std::abs(next - s);
    // p_t at `next` without another evaluation: N and det are linear and quadratic in s.
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
  s_ = s;
  p_t[0] = N[0] / determinant;
  p_t[1] = N[1] / determinant;
}

template <int d>
bool PairProblem<d>::step(const double* motion, double* force, double* change, double& largest) {
  double free[d], next[d], size = 0.0;
  for (int k = 0; k < d; ++k) {
    free[k] = motion[k];
    for (int j = 0; j < d; ++j) free[k] -= W_[d * j + k] * force[j];
  }
  solve(free, next);
  for (int k = 0; k < d; ++k) {
    change[k] = next[k] - force[k];
    size += std::abs(change[k]);
  }
  if (!(size > 0.0 && size < HUGE_VAL)) return false;
  for (int k = 0; k < d; ++k) {
    force[k] = next[k];
    largest = std::max(largest, std::abs(change[k]));
  }
  return true;
}

template <int d>
std::vector<PairProblem<d>> pair_problems(const Problem& problem) {
  const Matrix blocks = problem.W.diagonal_blocks(d);
  std::vector<PairProblem<d>> pairs;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const typename PairProblem<d>::Friction mu{problem.mu_against(i, -1.0), problem.mu_against(i, 1.0)};
    pairs.emplace_back(blocks.data() + d * d * i, mu, problem.cohesion_of(i), problem.tension_of(i));
  }
  return pairs;
}

template class PairProblem<2>;
template class PairProblem<3>;
template std::vector<PairProblem<2>> pair_problems<2>(const Problem&);
template std::vector<PairProblem<3>> pair_problems<3>(const Problem&);

}  // namespace scabo::contact
