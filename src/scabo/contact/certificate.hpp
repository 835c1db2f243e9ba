// The conditions that every increment must satisfy to count as solved. All figures are dimensionless: forces are
// divided by the largest force, lengths by the largest motion that the acting forces cause (judge.hpp defines both
// scales and the criterion).
#pragma once

#include <algorithm>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

struct Certificate {
  double equilibrium = 0.0;      ///< largest residual force of a node (set by the analysis)
  double penetration = 0.0;      ///< most negative gap
  double tension = 0.0;          ///< largest tensile force beyond the strength of the pair
  double friction_excess = 0.0;  ///< largest |p_t| - (cohesion + mu p_n), mu that of the direction p_t opposes
  double complementarity = 0.0;  ///< largest (p_n + tension) g
  double slip_direction = 0.0;   ///< largest slip in the direction of friction, or slip below the friction bound
  double rigid_balance = 0.0;    ///< force and moment balance of a body (contact part; completed by the analysis)

  double worst() const {
    return std::max(
        {equilibrium, penetration, tension, friction_excess, complementarity, slip_direction, rigid_balance});
  }
};

/// Scales by which the figures of a certificate are divided.
struct Scales {
  double force = 1.0;   ///< > 0
  double length = 1.0;  ///< > 0
};

/// The part of the certificate that follows from the discrete problem, for forces `p` (dN) and rigid motions `a` (m).
Certificate certify(const Problem& problem, const Vector& p, const Vector& a, const Scales& scales);
/// The same for known motions u.
Certificate certify_at(const Problem& problem, const Vector& p, const Vector& motion, const Scales& scales);

}  // namespace scabo::contact
