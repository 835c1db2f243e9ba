// The internal levels of super-elements in time steps (system/internal_levels.hpp): eliminated before the problem of a
// step is posed, recovered after it, and their part of the balance of energy.
#pragma once

#include "scabo/analysis/dynamics/time_step.hpp"

namespace scabo::analysis {

/// Of one level in one step.
struct InternalStep {
  Vector r;      ///< acceleration that acts on it, mean of the step
  Vector right;  ///< right-hand side of w
};
/// Per part, one for each level.
using InternalSteps = std::vector<std::vector<InternalStep>>;

/// Adds to the forces of the step what the levels leave of theirs.
InternalSteps eliminate_levels(const InTime& in, const State& from, const Acting& acting, std::vector<Vector>& forces);

/// w and its velocity at the end, from the lengths h v+ of all parts.
void recover_levels(const InTime& in, const State& from, const InternalSteps& steps, const std::vector<Vector>& lengths,
                    State& to);

/// 1/2 y'Q y - v'Z y and 1/2 w'Z w of one part.
double internal_kinetic(const system::PartInertia& part, const State& state, std::size_t p);
double internal_elastic(const system::PartInertia& part, const State& state, std::size_t p);

/// What the levels of a part add in a step to damping and to the work of what acts. `v`: mean velocity of the part.
struct InternalWork {
  double damping = 0.0, external = 0.0;
};
InternalWork internal_work(const InTime& in, const InternalSteps& steps, const State& from, const State& to,
                           const Vector& v, std::size_t p);

}  // namespace scabo::analysis
