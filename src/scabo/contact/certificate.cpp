#include "scabo/contact/certificate.hpp"

#include <cmath>

namespace scabo::contact {

namespace {

Vector motion_of(const Problem& problem, const Vector& p, const Vector& a) {
  Vector motion = problem.q + problem.W * p;
  if (a.size() > 0) motion += problem.G * a;
  return motion;
}

/// |p - P(p - u)|^2 of a pair with cohesion or tension, normal and tangent apart.
double squared_gap_of_bonded(double u_n, const Vector& u_t, double p_n, const Vector& p_t, double tension, double bound) {
  const double normal = std::isinf(tension) ? u_n : p_n - std::max(p_n - u_n, -tension);
  const Vector trial = p_t - u_t;
  const double size = trial.norm();
  const Vector projected = size > bound ? Vector(bound / size * trial) : trial;
  return normal * normal + (p_t - projected).squaredNorm();
}

}  // namespace

Certificate certify(const Problem& problem, const Vector& p, const Vector& a, const Scales& scales) {
  const Vector motion = motion_of(problem, p, a);
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
    raise(certificate.friction_excess, (friction - bound) / scales.force);
    // Friction opposes slip, and slip is only at the bound: |p_t| |ds| + p_t ds is 0 where they are opposite.
    if (d == 2) {
      raise(certificate.slip_direction, p_t[0] * slip[0] / work);
    } else {
      raise(certificate.slip_direction, (friction * ds + p_t.dot(slip)) / work);
    }
    raise(certificate.slip_direction, (bound - friction) * ds / work);
  }
  if (a.size() > 0)
    certificate.rigid_balance = (problem.G.transpose() * p + problem.f).lpNorm<Eigen::Infinity>() / scales.force;
  return certificate;
}

Vector project_on_cone(const Vector& x, double mu) {
  const double x_n = x[0], x_t = x.tail(x.size() - 1).norm();
  if (x_t <= mu * x_n) return x;
  if (mu * x_t <= -x_n) return Vector::Zero(x.size());
  Vector projected = x;  // on the nearest ray of the cone
  projected[0] = (x_n + mu * x_t) / (1.0 + mu * mu);
  projected.tail(x.size() - 1) *= mu * projected[0] / x_t;
  return projected;
}

double natural_map_residual(const Problem& problem, const Vector& p, const Vector& a) {
  const Vector motion = motion_of(problem, p, a);
  if (!motion.allFinite() || !p.allFinite()) return HUGE_VAL;
  const Eigen::Index d = problem.dimension;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const Vector u = motion.segment(d * i, d), p_i = p.segment(d * i, d);
    const double cohesion = problem.cohesion_of(i), tension = problem.tension_of(i);
    if (cohesion > 0.0 || tension > 0.0) {
      sum += squared_gap_of_bonded(u[0], u.tail(d - 1), p_i[0], p_i.tail(d - 1), tension,
                                   problem.friction_bound(i, p_i[0]));
      continue;
    }
    Vector shifted = p_i - u;
    shifted[0] -= problem.mu[i] * u.tail(d - 1).norm();
    sum += (p_i - project_on_cone(shifted, problem.mu[i])).squaredNorm();
  }
  const double scale = problem.q.norm();
  return std::sqrt(sum) / (scale > 0.0 ? scale : 1.0);
}

}  // namespace scabo::contact
