// What two models must have in common so that one starts where the other ended (restart.hpp).
#pragma once

#include <vector>

#include "scabo/analysis/state/restart.hpp"

namespace scabo::analysis {

/// Digests of bodies, supports, springs, contacts and the loads that act in a state, in or at the end of `step`.
/// `in_motion`: the energies of the bodies depend on their mass and damping, too.
std::vector<EndState::Agreement> agreements_of(const Prepared& now, const State& state, int step, bool in_motion);

}  // namespace scabo::analysis
