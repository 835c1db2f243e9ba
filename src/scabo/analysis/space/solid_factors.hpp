// Factors of loads, supports, interferences and preloads, and what is there of bodies, over the steps of a model in
// space.
#pragma once

#include "scabo/analysis/space/posed_solids.hpp"

namespace scabo::analysis {

/// Before the first step: of the run from which this one starts, or without any load.
SolidFactors factors_at_start(const model::SpaceModel& model, const PosedSolids& posed);

/// Adds all increments to a model that is posed.
void add_steps(const model::SpaceModel& model, PosedSolids& posed);

}  // namespace scabo::analysis
