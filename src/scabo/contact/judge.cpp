#include "scabo/contact/judge.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "scabo/linalg/dense.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

/// Normal and tangential parts of a pair; in the plane the second tangential component is zero.
struct Parts {
  double n = 0.0;
  Vec2 t = Vec2::Zero();
  Parts(const Vector& v, Index i, int d, double factor)
      : n(factor * v[d * i]), t(factor * v[d * i + 1], d == 3 ? factor * v[d * i + 2] : 0.0) {}
};

/// p - P(p - u)|^2 for a pair with cohesion or tension, separately for normal and tangential parts.
double squared_map_of_bonded(const Parts& u, const Parts& p, double tension, double bound) {
  const double normal = std::isinf(tension) ? u.n : p.n - std::max(p.n - u.n, -tension);
  Vec2 projected = p.t - u.t;
  const double size = projected.norm();
  if (size > bound) projected *= bound / size;
  return normal * normal + (p.t - projected).squaredNorm();
}

/// |p - P_K(p - (u + mu |u_t| n))|^2 of pair i. Where mu differs by direction, one edge of the plane cone lies on each
/// side of the normal, and the nearest point is on the side of x_t.
double squared_map_of_cone(const Problem& problem, Index i, const Parts& u, const Parts& p) {
  const double x_n = p.n - u.n - problem.mu_against(i, -u.t[0]) * u.t.norm();
  const Vec2 x_t = p.t - u.t;
  const double mu = problem.mu_against(i, x_t[0]);
  const double size = x_t.norm();
  if (size <= mu * x_n) return (p.n - x_n) * (p.n - x_n) + (p.t - x_t).squaredNorm();
  if (mu * size <= -x_n) return p.n * p.n + p.t.squaredNorm();
  const double normal = (x_n + mu * size) / (1.0 + mu * mu);  // on the nearest ray of the cone
  return (p.n - normal) * (p.n - normal) + (p.t - mu * normal / size * x_t).squaredNorm();
}

/// W| |p|. For a condensed W, a bound from its diagonal and its product.
Vector absolute_product(const Problem& problem, const Vector& p, const Vector& motion) {
  const Delassus& W = problem.W;
  Vector sums = Vector::Zero(p.size());
  if (W.is_dense()) {
    const Matrix& dense = W.matrix();
    for (Index j = 0; j < p.size(); ++j)
      if (p[j] != 0.0) sums += std::abs(p[j]) * dense.col(j).cwiseAbs();
    sums *= std::abs(W.factor());
  } else if (W.is_sparse()) {
    sums = W.sparse().cwiseAbs() * p.cwiseAbs();
  } else {
    sums = W.diagonal().cwiseProduct(p).cwiseAbs() + (motion - problem.q).cwiseAbs();
  }
  return sums;
}

}  // namespace

[[gnu::hot]] double stiffness_of(const Problem& problem) {
  const double mean = problem.W.size() > 0 ? problem.W.diagonal().mean() : 0.0;
  return mean > 0.0 ? 1.0 / mean : 1.0;
}

Vector motion_of(const Problem& problem, const Vector& p, const Vector& a) {
  Vector motion = problem.q + problem.W * p;
  if (a.size() > 0) motion.noalias() += problem.G * a;
  return motion;
}

Measure::Measure(const Problem& problem, const Vector& history, double applied)
    : Measure(problem, stiffness_of(problem), history, applied) {}

[[gnu::hot]] Measure::Measure(const Problem& problem, double stiffness, const Vector& history, double applied)
    : stiffness_(stiffness) {
  const double q_force = stiffness * linalg::largest_of(problem.q), before = linalg::largest_of(history);
  applied = std::max(applied, linalg::largest_of(problem.f));
  at_work_ = std::max(q_force, applied);
  norm_ = std::max(stiffness * problem.q.norm(), std::max(applied, problem.f.norm()));
  if (at_work_ == 0.0) at_work_ = norm_ = before;
  reference_ = applied > 0.0 ? applied : q_force > 0.0 ? q_force : before > 0.0 ? before : 1.0;
}

Measure Measure::of_forces() const {
  Measure measure = *this;
  measure.stiffness_ = 1.0;
  return measure;
}

[[gnu::hot]] Scales Measure::scales(const Vector& p) const {
  const double force = std::max(reference_, linalg::largest_of(p));
  return {force, (at_work_ > 0.0 ? std::min(force, at_work_) : force) / stiffness_};
}

[[gnu::hot]] double Measure::natural_map(const Problem& problem, const Vector& p, const Vector& motion) const {
  if (!motion.allFinite() || !p.allFinite()) return HUGE_VAL;
  double sum = 0.0;
  for (Index i = 0; i < problem.pairs(); ++i) {
    const Parts u(motion, i, problem.dimension, stiffness_), p_i(p, i, problem.dimension, 1.0);
    const double tension = problem.tension_of(i);
    if (problem.cohesion_of(i) > 0.0 || tension > 0.0)
      sum += squared_map_of_bonded(u, p_i, tension, problem.friction_bound(i, p_i.n, p_i.t[0] - u.t[0]));
    else
      sum += squared_map_of_cone(problem, i, u, p_i);
  }
  if (sum == 0.0) return 0.0;
  const double residual = std::sqrt(sum) / (norm_ > 0.0 ? norm_ : p.norm() > 0.0 ? p.norm() : 1.0);
  return std::isfinite(residual) ? residual : HUGE_VAL;  // squares of forces may overflow
}

double Measure::rounding(const Problem& problem, const Vector& p, const Vector& motion) const {
  if (p.isZero(0.0)) return 0.0;
  double lost = stiffness_ * linalg::largest_of(absolute_product(problem, p, motion));
  if (problem.G.cols() > 0)
    lost = std::max(lost, linalg::largest_of(problem.G.sparse().cwiseAbs().transpose() * p.cwiseAbs()));
  return std::numeric_limits<double>::epsilon() * lost / (at_work_ > 0.0 ? at_work_ : linalg::largest_of(p));
}

[[gnu::hot]] Judgement judge(const Problem& problem, const Vector& p, const Vector& a, const Vector& motion,
                             const Measure& measure, Judge by) {
  Judgement judgement;
  judgement.certificate = certify_at(problem, p, a, motion, measure.scales(p));
  judgement.natural_map_residual = measure.natural_map(problem, p, motion);
  judgement.rounding = measure.rounding(problem, p, motion);
  judgement.figure = by == Judge::certificate
                         ? judgement.certificate.worst()
                         : std::max(judgement.natural_map_residual, judgement.certificate.rigid_balance);
  return judgement;
}

std::string reason_of(const Judgement& judgement, Judge by, double tolerance, const std::string& story) {
  const char* const figure = by == Judge::certificate                            ? "certificate"
                             : judgement.figure > judgement.natural_map_residual ? "balance of the rigid motions"
                                                                                 : "natural-map residual";
  char text[400];
  if (judgement.rounding > tolerance)
    std::snprintf(
        text, sizeof text,
        "the best iterate has a %s of %.2g, but rounding makes its motions uncertain by %.2g of their scale, so "
        "that it is not known to be a solution",
        figure, judgement.figure, judgement.rounding);
  else if (!std::isfinite(judgement.figure))
    std::snprintf(text, sizeof text, "the best iterate has a %s that is not a finite number", figure);
  else
    std::snprintf(text, sizeof text, "the best iterate has a %s of %.2g, above the tolerance %.2g", figure,
                  judgement.figure, tolerance);
  return story.empty() ? text : story + "; " + text;
}

double natural_map_residual(const Problem& problem, const Vector& p, const Vector& a) {
  return Measure(problem).natural_map(problem, p, motion_of(problem, p, a));
}

}  // namespace scabo::contact
