#include "scabo/contact/gauss_seidel.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace scabo::contact {

namespace {

/// Force of one pair whose motion without it is `free`, for its own 2 x 2 part of W.
Vec2 local_force(const Mat2& W, const Vec2& free, double mu) {
  if (free[0] >= 0.0) return Vec2::Zero();  // open
  if (W(0, 0) <= 0.0) return Vec2::Zero();
  if (mu == 0.0 || W(1, 1) <= 0.0) return {-free[0] / W(0, 0), 0.0};
  const Vec2 stick = W.determinant() > 0.0 ? Vec2(W.inverse() * -free) : Vec2(-free[0] / W(0, 0), 0.0);
  if (stick[0] >= 0.0 && std::abs(stick[1]) <= mu * stick[0]) return stick;
  const double sign = stick[1] > 0.0 ? 1.0 : -1.0;  // slips against the friction that would hold it
  const double normal = W(0, 0) + sign * mu * W(0, 1);
  const double p_n = normal > 0.0 ? -free[0] / normal : -free[0] / W(0, 0);
  return {p_n, sign * mu * p_n};
}

}  // namespace

Vector gauss_seidel(const Problem& problem, Vector p, int sweeps) {
  Vector motion = problem.q + problem.W * p;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
      const Mat2 W = problem.W.dense().block<2, 2>(2 * i, 2 * i);
      const Vec2 old = p.segment<2>(2 * i);
      const Vec2 next = local_force(W, motion.segment<2>(2 * i) - W * old, problem.mu[i]);
      const Vec2 step = next - old;
      if (step.isZero(0.0)) continue;
      p.segment<2>(2 * i) = next;
      motion.noalias() += problem.W.dense().middleCols<2>(2 * i) * step;
      change = std::max(change, step.lpNorm<Eigen::Infinity>());
    }
    if (change <= 1e-12 * p.lpNorm<Eigen::Infinity>()) break;
  }
  return p;
}

}  // namespace scabo::contact
