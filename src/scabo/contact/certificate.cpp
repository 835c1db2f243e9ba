#include "scabo/contact/certificate.hpp"

#include <cmath>
#include <limits>

#include "scabo/contact/judge.hpp"

namespace scabo::contact {

Vector rounding_of_rigid_motions(const Problem& problem, const Vector& a, double length) {
  constexpr double most = 1e-8;
  if (a.size() == 0) return Vector::Zero(problem.q.size());
  const Vector lost = std::numeric_limits<double>::epsilon() * (problem.G.sparse().cwiseAbs() * a.cwiseAbs());
  return lost.cwiseMin(most * length);
}

namespace {

/// Each motion nearer to zero by the rounding error of G a.
Vector beyond_rounding(const Problem& problem, const Vector& a, const Vector& motion, double length) {
  return motion.binaryExpr(rounding_of_rigid_motions(problem, a, length),
                           [](double u, double error) { return std::copysign(std::max(std::abs(u) - error, 0.0), u); });
}

}  // namespace

Certificate certify(const Problem& problem, const Vector& p, const Vector& a, const Scales& scales) {
  return certify_at(problem, p, a, motion_of(problem, p, a), scales);
}

[[gnu::hot]] Certificate certify_at(const Problem& problem, const Vector& p, const Vector& a,
                                    const Vector& motion_found, const Scales& scales) {
  Certificate certificate;
  if (!motion_found.allFinite() || !p.allFinite()) {  // comparisons with NaN would all seem to be satisfied
    certificate.penetration = HUGE_VAL;
    return certificate;
  }
  const Vector motion = a.size() > 0 ? beyond_rounding(problem, a, motion_found, scales.length) : motion_found;
  const double work = scales.force * scales.length;
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const auto slip = motion.segment(d * i + 1, d - 1);
    const auto p_t = p.segment(d * i + 1, d - 1);
    const double g = motion[d * i], p_n = p[d * i], ds = slip.norm(), friction = p_t.norm();
    const double bound = problem.friction_bound(i, p_n, p_t[0]), tension = problem.tension_of(i);
    const auto raise = [](double& figure, double value) { figure = std::max(figure, value); };
    raise(certificate.penetration, -g / scales.length);
    if (std::isinf(tension)) {
      raise(certificate.complementarity, std::abs(g) / scales.length);  // bonded: the gap does not change
    } else {
      raise(certificate.tension, -(p_n + tension) / scales.force);
      raise(certificate.complementarity, std::abs((p_n + tension) * g) / work);
    }
    if (std::isinf(bound)) {  // no slip is possible
      raise(certificate.slip_direction, ds / scales.length);
      continue;
    }
    raise(certificate.friction_excess, (friction - bound) / scales.force);
    // Friction opposes slip, and slip occurs only at the bound: |p_t| |ds| + p_t ds is 0 if they have opposite
    // directions.
    if (d == 2) {
      raise(certificate.slip_direction, p_t[0] * slip[0] / work);
    } else {
      raise(certificate.slip_direction, (friction * ds + p_t.dot(slip)) / work);
    }
    // The bound of the friction that opposes this slip, which is another one where p_t has the wrong sign or none.
    const double opposing = d == 2 ? problem.friction_bound(i, p_n, -slip[0]) : bound;
    raise(certificate.slip_direction, (opposing - friction) * ds / work);
  }
  if (problem.G.cols() > 0)
    certificate.rigid_balance = (problem.G.transpose() * p + problem.f).lpNorm<Eigen::Infinity>() / scales.force;
  return certificate;
}

}  // namespace scabo::contact
