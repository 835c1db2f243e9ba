// Supports in space over a restart, as in the plane (analysis/state/restart_points.hpp): what a support exerts is kept
// by body and point, since one that lasts in one run, and is a constraint there, may end in the next one, and is pairs
// there.
#pragma once

#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/analysis/state/end_state.hpp"

namespace scabo::analysis {

/// What supports hold at the end of a run.
std::vector<EndState::Held> solids_held_at_end(const PreparedSolids& now, const SolidState& state);

/// Takes the forces of held points from there, and the motions of their bodies, so that these are where they were.
void continue_held_points(const PreparedSolids& now, const EndState& end, SolidState& state);

}  // namespace scabo::analysis
