// The branch of solutions that is connected to the history, where there are several
// (docs/methods/21_uniqueness.md).
#pragma once

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/contact/laws/evolution.hpp"

namespace scabo::analysis {

/// Looks for other solutions; where one is nearer to the accepted forces than the one at hand, the increment
/// goes there, so that the branch connected to the history is followed. Nothing where `evolution` is not
/// solved.
std::optional<UniquenessResult> follow_history(const contact::Problem& problem, const contact::JointLaws& laws,
                                               const contact::History& history, const contact::Start& start,
                                               const contact::SolverOptions& options, contact::Evolution& evolution);

}  // namespace scabo::analysis
