// Whether bodies that only contact holds are close to the load under which they slide or fall without end.
//
// A collapse is not always an increment without equilibrium. With friction there may be other equilibria further away:
// bodies slip, come to rest against the next ones and slip again, and a wall that is pushed harder and harder moves by
// many times its elastic deformation although every increment is solved. Then it is no longer the deformation of the
// bodies that limits the slips, and friction dissipates several times the energy that they store (docs/guide.md).
#pragma once

#include <string>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// A sentence if, in step `step` (an index) so far, friction has dissipated several times the largest elastic energy of
/// the run; otherwise empty. It is also empty where slips have other reasons than loads that grow on bodies at rest:
/// prescribed displacements, temperatures or curves in this step, large slip, springs, gaps that have closed, and where
/// supports hold every body. `before`: the increments before this state.
std::string near_collapse(const Prepared& prepared, const State& state, const std::vector<IncrementResult>& before,
                          std::size_t step);

}  // namespace scabo::analysis
