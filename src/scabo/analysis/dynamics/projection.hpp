// Removal of what overlaps at the end of a time step, and of what moving supports have drifted (time_step.hpp).
#pragma once

#include "scabo/analysis/dynamics/time_step.hpp"

namespace scabo::analysis {

struct Projection {
  std::vector<Vector> displacement;  ///< d, per part; empty: nothing overlapped
};

/// Values of the constraints of a part under a displacement of it.
Vector support_values(const system::BodySystem& part, const Vector& u);

/// Changes displacements and gaps of `to`. `t`: the state of eq. (1), with one prescribed value for each constraint.
Projection project(const InTime& in, const State& t, State& to);

}  // namespace scabo::analysis
