// The end of a run in space, from which another run may start, as in the plane (analysis/state/restart.hpp).
#pragma once

#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/analysis/state/end_state.hpp"

namespace scabo::analysis {

/// At the stage of the state.
EndState end_state_of_solids(const PreparedSolids& now, const model::SpaceModel& model, const SolidState& state);

/// The state from which the first step of a model with `restart` starts, at its stage. Throws InputError, at the place
/// of `restart` in the file, if the other run cannot be read or does not agree with the model.
SolidState state_of_restart(const PreparedSolids& now, const model::SpaceModel& model, const PosedSolids& posed);

}  // namespace scabo::analysis
