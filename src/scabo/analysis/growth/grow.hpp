// Cracks that grow, with their length as the parameter: in every state the load factor lambda is that at which the
// leading tip is critical; then the crack is made longer, and the body divided anew.
//
// Bodies are linearly elastic. Factors of loads and supports are those at the end of the step, lambda times those that
// are scaled, so that at every tip, where nothing is in contact,
//
//     K(lambda) = K_0 + lambda K_1,        K*(K(lambda)) = K_Ic, or (E' G_c)^1/2                                    (1)
//
// (K*: criteria.hpp). The tip with the smallest lambda leads. It grows, together with those within a thousandth of it,
// by equal parts of the step: where several are critical at once, the symmetric growth is taken. The state at lambda is
// solved from rest on the present crack, as nothing depends on the history. The direction is that at the middle of the
// step: the kink at the tip, and the one that is left where the crack has gone half of the way that this shows.
//
// With contacts states follow each other: every one is reached from the one before, whose pairs are carried over to the
// longer crack (longer_pairs.hpp), and lambda is found by trial (sought.hpp).
//
// Under cycles of load (fatigue.hpp) the state is that at the highest load of a cycle; the tips share the step in
// proportion to their growth per cycle at its middle.
//
// It ends at a length, at a place, at a load factor, after a number of steps, or where the crack meets an edge, a
// region, another crack or itself within one and a half steps; with a reason in the result where no load makes the
// crack grow, or where its faces overlap.
#pragma once

#include <optional>

#include "scabo/analysis/march/options.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Throws InputError for a model with steps in which nothing can grow.
void check_growth(const model::Model& model);

/// Whether a run continues within the last step, in which cracks grow.
bool continues_growth(const model::Model& model, const Options& options);

/// Goes through the last step of the solution, in which cracks grow, from its first mesh with its systems. A run that
/// continues makes the cracks as long as they were, by the positions of the tips in its increments, and computes its
/// last state again, without telling it.
/// `before`: the state at the end of the steps before, which is where the history of contacts begins; empty: at rest.
void grow(StaticSolution& solution, const Options& options, std::optional<State> before);

}  // namespace scabo::analysis
