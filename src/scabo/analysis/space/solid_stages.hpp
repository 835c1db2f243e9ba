// Staged construction in space, as in the plane (analysis/quasistatic/stages.hpp): a stage is the same system with
// fewer pairs and rigid motions, so that nothing is factorised again.
#pragma once

#include "scabo/analysis/space/prepared_solids.hpp"

namespace scabo::analysis {

/// Part of its loads that acts on every body at the end of a step, 0 or 1; step -1: before the first. Empty if no body
/// is ever absent.
Vector presence_at(const SolidModel& model, int step);

/// Whether bodies or supports are taken away in a step.
bool takes_away(const SolidModel& model, int step);

/// Goes on to a step from the accepted state at the end of the step before it; `moved`: what the parts do then, before
/// and after.
void enter_step(PreparedSolids& prepared, int step, SolidState& state, MovedSolids& moved);

}  // namespace scabo::analysis
