// Pairs of contacts as cracks become longer.
//
// Pairs at the same places keep what they carry bit by bit, those beside old tips get it by interpolation along the
// crack. Pairs ahead of an old tip begin with neither gap, slip, force nor strength.
#pragma once

#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/state/carried_over.hpp"

namespace scabo::analysis {

/// The state `from` of `shorter` on a mesh of longer cracks, under the same loads and pair forces: the tips have moved,
/// nothing else. `tips`: those that may have.
State on_longer(const Prepared& longer, const Prepared& shorter, const State& from, const std::vector<Tip>& tips);

/// Whether no pair of the crack of a tip slips or is open, so that there is no singularity at the tip.
bool is_stuck(const Prepared& prepared, const State& state, const Tip& tip);

/// Whether the faces of the crack of a tip are in contact with each other, as far as they touch.
bool has_contact(const model::Model& model, const Tip& tip);

}  // namespace scabo::analysis
