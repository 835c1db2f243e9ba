// Supports over a restart (restart.hpp). What a support exerts at its points is kept by part and point, since a support
// that lasts in one run, and is a constraint there, may end in the next one, and is pairs there
// (system/held_points.hpp).
#pragma once

#include "scabo/analysis/state/restart.hpp"

namespace scabo::analysis {

/// What supports hold at the end of a run.
std::vector<EndState::Held> held_at_end(const Prepared& now, const State& state);

/// Takes the lasting fields of the points of supports that begin or end.
void continue_points(const Prepared& now, const EndState& end, State& state);

/// Takes the rigid motions of parts that constraints held in the other run, and points hold now, so that their
/// displacements, which are complete without them, are those of its end. Whether there are such parts.
bool continue_motions(const Prepared& now, const EndState& end, State& state);

}  // namespace scabo::analysis
