// The steps of a model, increment by increment, by a scheme: progress, acceptance and reporting.
//
// Besides what reach() asks of it, a scheme tells the march
//
//     start()                          the state before the first step
//     enter(step, state)               that a step begins: bodies may come and go
//     begin(step, begin, end, from)    that an increment begins, between two parts of the step, from an accepted state
//     mesh_is_due_at_end(state)        whether the end of an increment needs another mesh of its own
//     remesh(reached)                  makes another mesh and carries the state over; false, with the reason, if not
//     pairs_found()                    what remesh() did in this increment; nothing of a scheme that never does
//     add_warnings(state, at, solution)   what its users ought to know of an accepted increment
#pragma once

#include <optional>

#include "scabo/analysis/march/increment_warnings.hpp"
#include "scabo/analysis/march/limit.hpp"
#include "scabo/analysis/march/reach.hpp"
#include "scabo/analysis/march/reports.hpp"
#include "scabo/analysis/state/continuation.hpp"
#include "scabo/analysis/state/restart.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/model/step.hpp"

namespace scabo::analysis {

/// The state from which a run starts or goes on.
template <typename Scheme>
RunState start_of_run(const Scheme& scheme, StaticSolution& solution, const Options& options) {
  if (!options.from) return {0, {}, scheme.start()};
  return continued_run(scheme.now(), *options.from, solution);
}

/// reach() from a state, on another mesh wherever one is due.
template <typename Scheme>
Reached reach_with_remeshing(Scheme& scheme, const State& from, std::optional<double> least, StaticSolution& solution,
                             const Options& options) {
  Reached reached;
  reached.state = from;
  do {
    if (scheme.mesh_is_due(reached.state) && !scheme.remesh(reached)) return reached;
    reached = timed(solution.timing.newton, [&] { return reach(scheme, std::move(reached), least, options); });
  } while (reached.mesh_is_due);
  if (reached.reason.empty() && !reached.stopped && scheme.mesh_is_due_at_end(reached.state)) scheme.remesh(reached);
  return reached;
}

/// The next increment of `run`; false if it is the end of the run.
template <typename Scheme>
bool advance(Scheme& scheme, RunState& run, StaticSolution& solution, const Options& options) {
  const model::Step& step = solution.model.steps[run.step];
  if (step.limit) return advance_to_limit(scheme, run, solution, options);
  StepProgress& progress = run.progress;
  const double begin = progress.reached, end = next_end(step, progress, model::corners_of(step, solution.model.curves));
  scheme.begin(run.step, begin, end, run.state);
  const std::optional<double> least =
      step.automatic ? std::optional(step.automatic->smallest / (end - begin)) : std::nullopt;
  Reached reached = reach_with_remeshing(scheme, run.state, least, solution, options);
  if (reached.stopped) {
    interrupt(solution);
    return false;
  }
  IncrementResult result = result_of(scheme.now(), reached, solution);
  result.step = static_cast<int>(run.step) + 1;
  result.step_name = step.name;
  result.increment = progress.increment + 1;
  result.reached = reached.part == 1.0 ? end : begin + reached.part * (end - begin);
  result.pairs_found = scheme.pairs_found();
  const bool there = result.converged;
  if (there) add_warnings(scheme.now(), reached, result, solution);
  if (there) scheme.add_warnings(reached.state, result, solution);
  solution.increments.push_back(std::move(result));
  if (!reached.problems.empty()) options.on_problems(solution.increments.back(), reached.problems);
  if (!there) {
    end_unsolved(reached, solution, options);
    return false;
  }
  run.state = std::move(reached.state);
  ++progress.increment;
  progress.reached = solution.increments.back().reached;
  if (step.automatic) {
    progress.size = next_size(*step.automatic, progress.reached - begin, reached.halvings > 0, reached.changes);
    if (reached.limit > 0.0) progress.limit = begin + reached.limit * (end - begin);
  }
  tell_accepted(scheme.now(), run, solution, options);
  return true;
}

/// The first `steps` steps, from where the run starts; at an EndAtOnce the solution is interrupted.
template <typename Scheme>
void march(Scheme& scheme, StaticSolution& solution, const Options& options, std::size_t steps) {
  try {
    RunState run = start_of_run(scheme, solution, options);
    do {
      const bool looks_for_limit = solution.model.steps[run.step].limit.has_value();  // which may be beyond part 1
      if (run.progress.reached == 1.0 && !looks_for_limit) {
        ++run.step;
        run.progress = {};
      }
      if (run.step == steps) {
        if (options.on_end) options.on_end(end_state(scheme.now(), run.state));
        return;
      }
      if (run.progress.increment == 0) scheme.enter(run.step, run.state);
      if (options.stop && *options.stop) {
        interrupt(solution);
        return;
      }
      tell_begin(options, solution.model.steps[run.step], run.step, run.progress.increment + 1);
    } while (advance(scheme, run, solution, options));
  } catch (const EndAtOnce&) {
    interrupt(solution);
  }
}

/// All steps.
template <typename Scheme>
void march(Scheme& scheme, StaticSolution& solution, const Options& options) {
  march(scheme, solution, options, solution.model.steps.size());
}

}  // namespace scabo::analysis
