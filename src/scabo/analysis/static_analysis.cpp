#include "scabo/analysis/static_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/adaptive.hpp"
#include "scabo/analysis/continuation.hpp"
#include "scabo/analysis/cracks.hpp"
#include "scabo/analysis/edge_forces.hpp"
#include "scabo/analysis/goal.hpp"
#include "scabo/analysis/increment_warnings.hpp"
#include "scabo/analysis/large_rotations.hpp"
#include "scabo/analysis/large_slip.hpp"
#include "scabo/analysis/outside.hpp"
#include "scabo/analysis/reach.hpp"
#include "scabo/analysis/restart.hpp"
#include "scabo/analysis/stages.hpp"
#include "scabo/analysis/step_factors.hpp"
#include "scabo/analysis/warnings.hpp"
#include "scabo/analysis/worthwhile_threads.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/mesh/output_points.hpp"
#include "scabo/model/validate.hpp"

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

/// Finds pairs anew in the state that was reached; false, with the reason, if that fails. `since`: as find_pairs_anew.
bool find_pairs(const LargeSlip& large, StaticSolution& solution, std::unique_ptr<const Assembly>& assembly,
                const State& since, PairsFound& found, Reached& reached) {
  const FoundAnew anew = find_pairs_anew(large, solution, assembly, since, reached.state);
  reached.iterations += anew.iterations;
  reached.reason = anew.reason;
  if (!reached.reason.empty()) return false;
  reached.certificate = anew.certificate;
  reached.residual = anew.residual;
  ++found.times;
  found.jump = std::max(found.jump, anew.jump);
  for (IncrementResult& increment : solution.increments) increment.fields = {};  // of another mesh
  return true;
}

/// reach() from a state, on pairs that are found anew wherever they are due, and then on another assembly. Where sides
/// slide off each other, that is also at the end.
Reached reach_with_pairs(StaticSolution& solution, std::unique_ptr<const Assembly>& assembly,
                         const std::function<const Prepared&()>& now, const State& from,
                         const std::function<Factors(double)>& factors_at, std::optional<double> least,
                         const LargeSlip* large, const Options& options, std::optional<PairsFound>& found) {
  Reached reached;
  reached.state = from;
  State since;  // on the present pairs
  if (large) {
    since = from;
    found.emplace();
  }
  const auto find = [&] {
    const bool there = find_pairs(*large, solution, assembly, since, *found, reached);
    since = reached.state;
    return there;
  };
  do {
    if (large && large->is_due(now(), reached.state) && !find()) return reached;
    reached = timed(solution.timing.newton,
                    [&] { return reach(now(), std::move(reached), factors_at, least, large, options); });
  } while (reached.pairs_are_due);
  if (large && reached.reason.empty() && !reached.stopped && large->overlap_changed(now(), reached.state)) find();
  return reached;
}

RunState start_of_run(const Prepared& prepared, StaticSolution& solution, const Options& options) {
  if (!options.from && prepared.model.restart) return {0, {}, state_of_restart(prepared)};
  if (!options.from) return {0, {}, initial_state(prepared)};
  RunState run = options.from->at;
  ensure(run.state.states.size() == prepared.contact.pairs.size() &&
             run.state.a.size() == prepared.contact.rigid_motions() &&
             run.state.factors.loads.size() == prepared.model.loads.size() &&
             run.state.factors.supports.size() == prepared.model.supports.size(),
         "the state from which the run continues belongs to this model");
  complete(prepared, run.state);
  solution.increments = options.from->increments;
  solution.warnings = options.from->warnings;
  ensure(!solution.increments.empty(), "the state from which the run continues has increments");
  IncrementResult again = described(prepared, run.state);
  solution.increments.back().fields = std::move(again.fields);
  solution.increments.back().contacts = std::move(again.contacts);
  return run;
}

void interrupt(StaticSolution& solution) {
  solution.outcome = Outcome::interrupted;
  solution.reason = "interrupted: the increments finished so far are kept";
}

/// Reports that increment `k` of a step begins.
void tell_begin(const Options& options, const model::Step& step, std::size_t index, int k) {
  if (options.on_increment_begin)
    options.on_increment_begin(
        {static_cast<int>(index) + 1, step.name, k, step.automatic ? std::nullopt : std::optional(step.increments)});
  if (options.on_stage)
    options.on_stage(step.automatic ? fmt::format("step {}, increment {}", step.name, k)
                                    : fmt::format("step {}, increment {} of {}", step.name, k, step.increments));
}

double largest_component(const State& state) {
  double largest = 0.0;
  for (const Vector& u : state.u)
    if (u.size() > 0) largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
  return largest;
}

/// The results of what was reached, if that is the end of the increment; otherwise its history alone. The reason of
/// `reached` says so if the results are no finite numbers.
IncrementResult result_of(const Prepared& prepared, Reached& reached, StaticSolution& solution) {
  IncrementResult result;
  if (reached.reason.empty())
    result = timed(solution.timing.recover, [&] {
      IncrementResult of_state = described(prepared, reached.state);
      of_state.cracks = crack_results(solution, of_state);
      of_state.edges = edge_forces(prepared, reached.state, solution);
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

/// One warning of large displacements is enough.
void add_large_rotation(const Prepared& prepared, const State& state, const IncrementResult& at,
                        StaticSolution& solution) {
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::large_displacement && warning.subject.empty()) return;
  if (const std::string sentence = large_rotation(prepared, state); !sentence.empty())
    solution.warnings.push_back({WarningKind::large_displacement, "",
                                 fmt::format("step {}, increment {}: {}", at.step_name, at.increment, sentence)});
}

void go_through_steps(std::unique_ptr<const Assembly> assembly, const LargeSlip* large, StaticSolution& solution,
                      const Options& options) {
  // Bodies come and go, or pairs are found anew (which replaces the assembly): not both in one model.
  Stages stages(assembly->prepared, options.from ? options.from->at.step : 0);
  const auto now = [&]() -> const Prepared& { return large ? assembly->prepared : stages.now(); };
  RunState run = start_of_run(now(), solution, options);
  for (;;) {
    if (run.progress.reached == 1.0) {
      ++run.step;
      run.progress = {};
    }
    if (run.step == solution.model.steps.size()) {
      if (options.on_end) options.on_end(end_state(now(), run.state));
      return;
    }
    if (run.progress.increment == 0 && !large) stages.enter(run.step, run.state);
    const model::Step& step = solution.model.steps[run.step];
    StepProgress& progress = run.progress;
    const int k = progress.increment + 1;
    if (options.stop && *options.stop) {
      interrupt(solution);
      return;
    }
    tell_begin(options, step, run.step, k);
    const double begin = progress.reached,
                 end = next_end(step, progress, model::corners_of(step, solution.model.curves));
    const Factors target = factors_in(solution.model, run.step, end);
    const bool curved = !step.load_curves.empty() || !step.support_curves.empty();
    const auto factors_at = [&](double part) {
      return curved && part < 1.0 ? factors_in(solution.model, run.step, begin + part * (end - begin))
                                  : between(run.state.factors, target, part);
    };
    const std::optional<double> least =
        step.automatic ? std::optional(step.automatic->smallest / (end - begin)) : std::nullopt;
    std::optional<PairsFound> found;
    Reached reached = reach_with_pairs(solution, assembly, now, run.state, factors_at, least, large, options, found);
    const Prepared& prepared = now();
    if (reached.stopped) {
      interrupt(solution);
      return;
    }
    IncrementResult result = result_of(prepared, reached, solution);
    const bool there = result.converged;
    result.step = static_cast<int>(run.step) + 1;
    result.step_name = step.name;
    result.increment = k;
    result.reached = reached.part == 1.0 ? end : begin + reached.part * (end - begin);
    result.pairs_found = found;
    if (there) add_warnings(prepared, reached, result, solution);
    if (there) add_large_rotation(prepared, reached.state, result, solution);
    if (there && large) add_slid_off(*large, reached.state, result, solution);
    solution.increments.push_back(std::move(result));
    if (!reached.problems.empty()) options.on_problems(solution.increments.back(), reached.problems);
    if (!there) {
      solution.outcome = reached.mechanism  ? Outcome::mechanism
                         : reached.collapse ? Outcome::collapse
                                            : Outcome::not_converged;
      solution.reason = fmt::format("step {}, increment {}: {}", step.name, k, reached.reason);
      solution.mechanism = std::move(reached.motion);
      if (options.on_increment) options.on_increment(solution, solution.increments.back());
      return;
    }
    run.state = std::move(reached.state);
    progress.increment = k;
    progress.reached = solution.increments.back().reached;
    if (step.automatic) {
      progress.size = next_size(*step.automatic, progress.reached - begin, reached.halvings > 0, reached.changes);
      if (reached.limit > 0.0) progress.limit = begin + reached.limit * (end - begin);
    }
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
}

void run_steps(std::unique_ptr<const Assembly> assembly, const LargeSlip* large, StaticSolution& solution,
               const Options& options) {
  try {
    go_through_steps(std::move(assembly), large, solution, options);
  } catch (const EndAtOnce&) {
    interrupt(solution);
  }
}

}  // namespace

mesh::Mesh check(const model::Model& model) {
  model::require_valid(model);
  if (model.analysis.type == model::AnalysisType::modal) {  // bodies may be free and do not interact
    model::Model apart = model;
    apart.contacts.clear();
    mesh::Mesh mesh = mesh::make_mesh(apart);
    system::constraints_of(apart, mesh, system::Dofs(apart, mesh));
    return mesh;
  }
  mesh::Mesh mesh = mesh::make_mesh(model);
  system::check_supports(model, mesh);
  check_references(model, mesh);
  check_refinable(model, mesh);
  mesh::output_points(model);
  check_bars(model, mesh);
  return mesh;
}

namespace {

bool has_automatic_steps(const model::Model& model) {
  return std::any_of(model.steps.begin(), model.steps.end(),
                     [](const model::Step& step) { return step.automatic.has_value(); });
}

/// A model whose results on several meshes are compared has the same increments on each: those of the first mesh. If
/// that has no solution, the model remains as it is, and its analysis says why.
model::Model with_its_increments(const model::Model& model, const mesh::Mesh& mesh, const Options& options) {
  Options with = quiet(options, "increments");
  with.ranks = nullptr;
  with.keep_fields = false;
  const StaticSolution solution = solve_on_mesh(model, mesh, with);
  if (solution.outcome != Outcome::solved) return model;
  model::Model fixed = model;
  for (std::size_t s = 0; s < fixed.steps.size(); ++s) {
    model::Step& step = fixed.steps[s];
    if (!step.automatic) continue;
    for (const IncrementResult& increment : solution.increments)
      if (increment.step == static_cast<int>(s) + 1) step.ends.push_back(increment.reached);
    step.increments = static_cast<int>(step.ends.size());
    step.automatic.reset();
  }
  return fixed;
}

}  // namespace

bool can_use_ranks(const model::Model& model) {
  return model.analysis.type == model::AnalysisType::static_ && !wants_bars(model) && !wants_refinement(model) &&
         !model.output.error;
}

StaticSolution solve_static(model::Model model, const Options& options) {
  double seconds = 0.0;
  if (options.on_stage) options.on_stage("mesh");
  mesh::Mesh mesh = timed(seconds, [&] {
    const Interruptible nobody(nullptr);  // every result contains a mesh
    return check(model);
  });
  const bool several_meshes = wants_bars(model) || wants_refinement(model) || model.output.error;
  if (several_meshes && has_automatic_steps(model)) {
    const Stopwatch finding(seconds);
    model = with_its_increments(model, mesh, options);
  }
  Options here = options;  // several meshes: by this process alone
  here.ranks = nullptr;
  StaticSolution solution = wants_bars(model)         ? solve_with_bars(std::move(model), std::move(mesh), here)
                            : wants_refinement(model) ? solve_refined(std::move(model), here)
                            : model.output.error      ? solve_with_error(std::move(model), std::move(mesh), here)
                                                      : solve_on_mesh(std::move(model), std::move(mesh), options);
  solution.timing.mesh += seconds;
  return solution;
}

StaticSolution solve_on_mesh(model::Model model, mesh::Mesh mesh, const Options& options) {
  const auto stage = [&](const char* what) {
    if (options.on_stage) options.on_stage(what);
  };
  const int threads = worthwhile_threads(model, mesh, options.threads);
  linalg::set_blas_threads(threads);
  StaticSolution solution;
  solution.model = std::move(model);
  solution.mesh = std::move(mesh);
  solution.threads = threads;
  solution.ranks = options.ranks;
  Timing& timing = solution.timing;
  if (options.from) timing = options.from->timing;

  std::optional<LargeSlip> large;
  if (has_large_slip(solution.model)) {
    large.emplace(solution.model);
    const mesh::Placement at_start = options.from             ? options.from->at.state.replaced.placement
                                     : solution.model.restart ? placement_of_restart(solution.model)
                                                              : mesh::Placement();
    if (!at_start.empty()) {  // it was found before, in this run or in another one
      auto found = large->mesh_in(solution.model, at_start);
      if (auto* wrong = std::get_if<std::vector<Diagnostic>>(&found))
        throw InputError(solution.model.file, std::move(*wrong));
      solution.mesh = std::get<mesh::Mesh>(std::move(found));
    }
  }
  std::unique_ptr<const Assembly> assembly;
  try {
    stage("super-elements");
    solution.cells = timed(timing.super_elements, [&] { return solved_cells(solution, solution.mesh); });
    assembly = assemble(solution, options.on_stage, options.on_iteration);
    if (options.on_mesh) options.on_mesh(solution);
  } catch (const EndAtOnce&) {
    if (options.from) solution.increments = options.from->increments;
    solution.warnings = options.from ? options.from->warnings : solution.model.warnings;
    interrupt(solution);
    return solution;
  }
  solution.warnings = solution.model.warnings;
  for (Warning& warning : slender_warnings(solution.model, solution.mesh))
    solution.warnings.push_back(std::move(warning));
  for (Warning& warning : load_warnings(solution.model, assembly->structure))
    solution.warnings.push_back(std::move(warning));
  run_steps(std::move(assembly), large ? &*large : nullptr, solution, options);
  for (Warning& warning : contact_warnings(solution)) solution.warnings.push_back(std::move(warning));
  return solution;
}

}  // namespace scabo::analysis
