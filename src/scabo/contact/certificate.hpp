// The conditions that every increment must satisfy to count as solved. All figures are dimensionless: forces are
// divided by the largest force, lengths by the largest motion that the acting forces cause (judge.hpp defines both
// scales and the criterion).
//
// Gaps and slips are those beyond the rounding of the rigid motions, eps sum_j |G_ij| |a_j|, of which at most 1e-8 of
// the length scale is granted. The top of a leaning tower of 200 blocks moves so far that the last digit of its motion
// alone would be a slip of 1e-10: no numbers in double precision let its blocks stick better.
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
  double energy_balance = 0.0;   ///< in time, of a time step, over the largest energy so far (set by the analysis)

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

/// What the last digits of the rigid motions a may add to the motions of the pairs (dN numbers), at most 1e-8 of the
/// length scale: gaps and slips below it are none.
Vector rounding_of_rigid_motions(const Problem& problem, const Vector& a, double length);
/// The part of the certificate that follows from the discrete problem, for forces `p` (dN) and rigid motions `a` (m).
Certificate certify(const Problem& problem, const Vector& p, const Vector& a, const Scales& scales);
/// The same for known motions u of these rigid motions.
Certificate certify_at(const Problem& problem, const Vector& p, const Vector& a, const Vector& motion,
                       const Scales& scales);

}  // namespace scabo::contact
