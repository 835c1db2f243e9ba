#include "scabo/contact/certificate.hpp"

#include <cmath>

namespace scabo::contact {

namespace {

Vector motion_of(const Problem& problem, const Vector& p, const Vector& a) {
  Vector motion = problem.q + problem.W * p;
  if (a.size() > 0) motion += problem.G * a;
  return motion;
}

/// A pair's normal and tangential parts; in the plane the second tangent is zero.
struct Parts {
  double n = 0.0;
  Vec2 t = Vec2::Zero();
  Parts(const Vector& v, Eigen::Index i, int d) : n(v[d * i]), t(v[d * i + 1], d == 3 ? v[d * i + 2] : 0.0) {}
};

/// |p - P(p - u)|^2 of a pair with cohesion or tension, normal and tangent apart.
double squared_map_of_bonded(const Parts& u, const Parts& p, double tension, double bound) {
  const double normal = std::isinf(tension) ? u.n : p.n - std::max(p.n - u.n, -tension);
  Vec2 projected = p.t - u.t;
  const double size = projected.norm();
  if (size > bound) projected *= bound / size;
  return normal * normal + (p.t - projected).squaredNorm();
}

/// |p - P_K(p - (u + mu |u_t| n))|^2.
double squared_map_of_cone(const Parts& u, const Parts& p, double mu) {
  const double x_n = p.n - u.n - mu * u.t.norm();
  const Vec2 x_t = p.t - u.t;
  const double size = x_t.norm();
  if (size <= mu * x_n) return (p.n - x_n) * (p.n - x_n) + (p.t - x_t).squaredNorm();
  if (mu * size <= -x_n) return p.n * p.n + p.t.squaredNorm();
  const double normal = (x_n + mu * size) / (1.0 + mu * mu);  // on the nearest ray of the cone
  return (p.n - normal) * (p.n - normal) + (p.t - mu * normal / size * x_t).squaredNorm();
}

}  // namespace

Certificate certify(const Problem& problem, const Vector& p, const Vector& a, const Scales& scales) {
  return certify_at(problem, p, motion_of(problem, p, a), scales);
}

[[gnu::hot]] Certificate certify_at(const Problem& problem, const Vector& p, const Vector& motion,
                                    const Scales& scales) {
  Certificate certificate;
  if (!motion.allFinite() || !p.allFinite()) {  // comparisons with nan would all look right
    certificate.penetration = HUGE_VAL;
    return certificate;
  }
  const double work = scales.force * scales.length;
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const auto slip = motion.segment(d * i + 1, d - 1);
    const auto p_t = p.segment(d * i + 1, d - 1);
    const double g = motion[d * i], p_n = p[d * i], ds = slip.norm(), friction = p_t.norm();
    const double bound = problem.friction_bound(i, p_n), tension = problem.tension_of(i);
    const auto raise = [](double& figure, double value) { figure = std::max(figure, value); };
    raise(certificate.penetration, -g / scales.length);
    if (std::isinf(tension)) {
      raise(certificate.complementarity, std::abs(g) / scales.length);  // bonded: the gap stays shut
    } else {
      raise(certificate.tension, -(p_n + tension) / scales.force);
      raise(certificate.complementarity, std::abs((p_n + tension) * g) / work);
    }
    if (std::isinf(bound)) {  // nothing slips there
      raise(certificate.slip_direction, ds / scales.length);
      continue;
    }
    raise(certificate.friction_excess, (friction - bound) / scales.force);
    // Friction opposes slip, and slip is only at the bound: |p_t| |ds| + p_t ds is 0 where they are opposite.
    if (d == 2) {
      raise(certificate.slip_direction, p_t[0] * slip[0] / work);
    } else {
      raise(certificate.slip_direction, (friction * ds + p_t.dot(slip)) / work);
    }
    raise(certificate.slip_direction, (bound - friction) * ds / work);
  }
  if (problem.G.cols() > 0)
    certificate.rigid_balance = (problem.G.transpose() * p + problem.f).lpNorm<Eigen::Infinity>() / scales.force;
  return certificate;
}

[[gnu::hot]] double natural_map_residual_at(const Problem& problem, const Vector& p, const Vector& motion) {
  if (!motion.allFinite() || !p.allFinite()) return HUGE_VAL;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const Parts u(motion, i, problem.dimension), p_i(p, i, problem.dimension);
    const double tension = problem.tension_of(i);
    if (problem.cohesion_of(i) > 0.0 || tension > 0.0)
      sum += squared_map_of_bonded(u, p_i, tension, problem.friction_bound(i, p_i.n));
    else
      sum += squared_map_of_cone(u, p_i, problem.mu[i]);
  }
  const double scale = problem.q.norm();
  return std::sqrt(sum) / (scale > 0.0 ? scale : 1.0);
}

double natural_map_residual(const Problem& problem, const Vector& p, const Vector& a) {
  return natural_map_residual_at(problem, p, motion_of(problem, p, a));
}

}  // namespace scabo::contact
