#include "scabo/analysis/march/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/cracks.hpp"
#include "scabo/analysis/state/edge_forces.hpp"
#include "scabo/analysis/state/outside.hpp"
#include "scabo/base/stopwatch.hpp"

namespace scabo::analysis {

namespace {

/// The results of an accepted state, apart from the history of its increment.
IncrementResult described(const Prepared& prepared, const State& state) {
  IncrementResult result = describe(prepared, state);
  refer_displacements(prepared, state, result);
  return result;
}

/// Only the last increment keeps fields and pairs.
void drop_fields(IncrementResult& increment) {
  increment.fields = {};
  for (ContactResult& contact : increment.contacts) contact.pairs = {};
}

double largest_component(const State& state) {
  double largest = 0.0;
  for (const Vector& u : state.u)
    if (u.size() > 0) largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
  return largest;
}

}  // namespace

RunState continued_run(const Prepared& prepared, const Continuation& from, StaticSolution& solution) {
  RunState run = from.at;
  ensure(run.state.states.size() == prepared.contact.pairs.size() &&
             run.state.rigid_motion.size() == prepared.contact.rigid_motions() &&
             run.state.factors.loads.size() == prepared.model.loads.size() &&
             run.state.factors.supports.size() == prepared.model.supports.size(),
         "the state from which the run continues belongs to this model");
  complete(prepared, run.state);
  solution.increments = from.increments;
  solution.warnings = from.warnings;
  ensure(!solution.increments.empty(), "the state from which the run continues has increments");
  IncrementResult again = described(prepared, run.state);
  solution.increments.back().fields = std::move(again.fields);
  solution.increments.back().contacts = std::move(again.contacts);
  return run;
}

void tell_begin(const Options& options, const model::Step& step, std::size_t index, int number) {
  if (options.on_increment_begin)
    options.on_increment_begin({static_cast<int>(index) + 1, step.name, number,
                                model::is_counted(step) ? std::optional(step.increments) : std::nullopt});
  if (options.on_stage)
    options.on_stage(model::is_counted(step)
                         ? fmt::format("step {}, increment {} of {}", step.name, number, step.increments)
                         : fmt::format("step {}, increment {}", step.name, number));
}

IncrementResult result_of(const Prepared& prepared, Reached& reached, StaticSolution& solution) {
  IncrementResult result;
  if (reached.reason.empty())
    result = timed(solution.timing.recover, [&] {
      IncrementResult of_state = described(prepared, reached.state);
      of_state.cracks = crack_results(solution, of_state);
      of_state.edges = edge_forces(prepared, reached.state);
      return of_state;
    });
  if (reached.reason.empty() && !std::isfinite(result.energy.elastic))
    reached.reason = fmt::format(
        "the elastic energy exceeds the range of floating-point numbers: displacements reach {:.3g} under "
        "forces of up to {:.3g}",
        largest_component(reached.state), largest_force(reached.state));
  result.converged = reached.reason.empty();
  result.newton_iterations = reached.iterations;
  result.coarse_iterations = reached.coarse_iterations;
  result.halvings = reached.halvings;
  result.residual = reached.residual;
  result.certificate = reached.certificate;
  result.reason = reached.reason;
  result.attempts = std::move(reached.attempts);
  result.uniqueness = reached.uniqueness;
  return result;
}

void tell_accepted(const Prepared& prepared, const RunState& run, StaticSolution& solution, const Options& options) {
  if (options.on_state) options.on_state(prepared, run.state, solution);
  try {
    if (options.on_increment) options.on_increment(solution, solution.increments.back());
  } catch (const EndAtOnce&) {  // an increment is finished when it has been told
    solution.increments.pop_back();
    throw;
  }
  if (options.on_accepted) options.on_accepted(run, solution);
  if (!options.keep_fields && solution.increments.size() > 1)
    drop_fields(solution.increments[solution.increments.size() - 2]);
}

void end_unsolved(Reached& reached, StaticSolution& solution, const Options& options) {
  const IncrementResult& last = solution.increments.back();
  solution.outcome = reached.mechanism  ? Outcome::mechanism
                     : reached.collapse ? Outcome::collapse
                                        : Outcome::not_converged;
  solution.reason = fmt::format("step {}, increment {}: {}", last.step_name, last.increment, reached.reason);
  solution.mechanism = std::move(reached.motion);
  if (options.on_increment) options.on_increment(solution, last);
}

void interrupt(StaticSolution& solution) {
  solution.outcome = Outcome::interrupted;
  solution.reason = "interrupted: the increments finished so far are kept";
}

}  // namespace scabo::analysis
