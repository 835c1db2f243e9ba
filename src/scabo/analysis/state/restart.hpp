// The end of a run (end_state.hpp), from which another run may start: `restart` of a model.
//
// Displacements at rest are not kept: they follow from the factors, the contact forces and the rigid motions, as those
// of a checkpoint do, if bodies, supports, springs, contacts and the loads that act are the same. Digests tell whether
// they are. Bodies that are absent at the end (stages.hpp) may be left out of the other model, and it may have others
// that are added later. Laws of contacts may change: a joint keeps its forces, its slip and whether it is broken. Of
// contacts with large slip (large_slip.hpp) the end tells where their sides were when their pairs were found: the other
// run divides them there before anything is compared.
#pragma once

#include "scabo/analysis/state/continuation.hpp"
#include "scabo/analysis/state/end_state.hpp"

namespace scabo::analysis {

/// `now`: at the stage of the state.
EndState end_state(const Prepared& now, const State& state);

/// Where the sides of contacts with large slip are at the start of a model with `restart`; empty if all are where they
/// are drawn. Throws InputError as state_of_restart().
mesh::Placement placement_of_restart(const model::Model& model);

/// The state from which the first step of a model with `restart` starts; its mesh is in placement_of_restart(). Throws
/// InputError, at the place of `restart` in the file, if the other run cannot be read or does not agree with the model.
State state_of_restart(const Prepared& now);

}  // namespace scabo::analysis
