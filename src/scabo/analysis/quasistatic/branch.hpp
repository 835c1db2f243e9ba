// Selection of the solution branch connected to the history if there are several solutions
// (docs/methods/21_uniqueness.md).
#pragma once

#include "scabo/analysis/state/results.hpp"
#include "scabo/contact/laws/evolution.hpp"

namespace scabo::analysis {

/// Searches for other solutions. If one of them is closer to the accepted forces than the present one, the increment
/// takes it, so that the branch connected to the history is followed. Returns nothing if `evolution` is not solved.
std::optional<UniquenessResult> follow_history(const contact::Problem& problem, const contact::JointLaws& laws,
                                               const contact::History& history, const contact::Start& start,
                                               const contact::SolverOptions& options, contact::Evolution& evolution);

}  // namespace scabo::analysis
