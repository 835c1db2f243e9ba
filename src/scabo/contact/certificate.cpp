#include "scabo/contact/certificate.hpp"

#include <cmath>

namespace scabo::contact {

Certificate certify(const Problem& problem, const Vector& p, const Vector& a, const Scales& scales) {
  Vector motion = problem.q + problem.W * p;
  if (a.size() > 0) motion += problem.G * a;
  Certificate certificate;
  if (!motion.allFinite() || !p.allFinite()) {  // comparisons with nan would all look right
    certificate.penetration = HUGE_VAL;
    return certificate;
  }
  const double work = scales.force * scales.length;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double g = motion[2 * i], ds = motion[2 * i + 1], pn = p[2 * i], pt = p[2 * i + 1];
    const double bound = problem.mu[i] * std::max(pn, 0.0);
    const auto raise = [](double& figure, double value) { figure = std::max(figure, value); };
    raise(certificate.penetration, -g / scales.length);
    raise(certificate.tension, -pn / scales.force);
    raise(certificate.friction_excess, (std::abs(pt) - bound) / scales.force);
    raise(certificate.complementarity, std::abs(pn * g) / work);
    raise(certificate.slip_direction, pt * ds / work);                                     // friction opposes slip
    raise(certificate.slip_direction, (bound - std::abs(pt)) * std::abs(ds) / work);       // slip only at the bound
  }
  if (a.size() > 0)
    certificate.rigid_balance = (problem.G.transpose() * p + problem.f).lpNorm<Eigen::Infinity>() / scales.force;
  return certificate;
}

}  // namespace scabo::contact
