// The last step of a run, whose loads grow, or whose friction falls, until nothing is in equilibrium any more.
//
// A bracket closes from both sides. Increments of the factor double as long as there is equilibrium; then each goes
// from the last equilibrium halfway to the nearest factor at which none was found, until the two are as near as wanted.
// The last attempt is to that factor again, from the last equilibrium beside it, so that no large increment decides;
// where it is solved after all, the search goes on from there.
#pragma once

#include "scabo/analysis/march/increment_warnings.hpp"
#include "scabo/analysis/march/reach.hpp"
#include "scabo/analysis/march/reports.hpp"
#include "scabo/analysis/state/restart.hpp"
#include "scabo/base/stopwatch.hpp"

namespace scabo::analysis {

/// The next attempt in a step that looks for a limit.
struct LimitTrial {
  double end = 0.0;   ///< part of the step
  bool last = false;  ///< to the nearest part without equilibrium, once more
};

/// Nothing where factors so large are in equilibrium that there is no limit.
std::optional<LimitTrial> next_trial(const model::Step& step, const StepProgress& progress);

/// After an accepted trial.
StepProgress after_trial(const model::Step& step, StepProgress progress, const LimitTrial& trial);

/// `reached`: the last attempt, which was not accepted; null: none was.
Limit limit_at(const model::Step& step, const StepProgress& progress, const Reached* reached);

/// As advance() of march/steps.hpp.
template <typename Scheme>
bool advance_to_limit(Scheme& scheme, RunState& run, StaticSolution& solution, const Options& options) {
  const model::Step& step = solution.model.steps[run.step];
  StepProgress& progress = run.progress;
  const auto ends = [&](Reached* beyond) {
    solution.limit = limit_at(step, progress, beyond);
    if (beyond) solution.mechanism = std::move(beyond->motion);
    if (options.on_end) options.on_end(end_state(scheme.now(), run.state));
    return false;
  };
  const std::optional<LimitTrial> trial = next_trial(step, progress);
  if (!trial) return ends(nullptr);
  scheme.begin(run.step, progress.reached, trial->end, run.state);
  constexpr double at_once = 1.0;
  Reached reached;
  reached.state = run.state;
  reached = timed(solution.timing.newton, [&] { return reach(scheme, std::move(reached), at_once, options); });
  if (reached.stopped) {
    interrupt(solution);
    return false;
  }
  IncrementResult result = result_of(scheme.now(), reached, solution);
  if (!result.converged) {
    if (trial->last) return ends(&reached);
    progress.limit = trial->end;
    return true;
  }
  result.step = static_cast<int>(run.step) + 1;
  result.step_name = step.name;
  result.increment = progress.increment + 1;
  result.reached = trial->end;
  add_warnings(scheme.now(), reached, result, solution);
  solution.increments.push_back(std::move(result));
  if (!reached.problems.empty()) options.on_problems(solution.increments.back(), reached.problems);
  run.state = std::move(reached.state);
  progress = after_trial(step, progress, *trial);
  tell_accepted(scheme.now(), run, solution, options);
  return true;
}

}  // namespace scabo::analysis
