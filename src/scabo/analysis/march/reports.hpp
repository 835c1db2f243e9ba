// What an analysis tells of its increments, and how it ends.
#pragma once

#include "scabo/analysis/march/reached.hpp"
#include "scabo/analysis/state/continuation.hpp"

namespace scabo::analysis {

/// The state in which a run was left, completed; the solution gets its increments and warnings.
RunState continued_run(const Prepared& prepared, const Continuation& from, StaticSolution& solution);

/// Increment `number` of a step begins, which is `index` of the model.
void tell_begin(const Options& options, const model::Step& step, std::size_t index, int number);

/// The results of what was reached, if that is the end of the increment; otherwise its history alone. The reason of
/// `reached` says so if the results are no finite numbers.
IncrementResult result_of(const Prepared& prepared, Reached& reached, StaticSolution& solution);

/// The last increment of the solution is accepted, and `run` is where it has come to.
void tell_accepted(const Prepared& prepared, const RunState& run, StaticSolution& solution, const Options& options);

/// The last increment of the solution was not solved.
void end_unsolved(Reached& reached, StaticSolution& solution, const Options& options);

void interrupt(StaticSolution& solution);

}  // namespace scabo::analysis
