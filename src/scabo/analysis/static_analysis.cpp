#include "scabo/analysis/static_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/adaptive.hpp"
#include "scabo/analysis/continuation.hpp"
#include "scabo/analysis/cracks.hpp"
#include "scabo/analysis/edge_forces.hpp"
#include "scabo/analysis/goal.hpp"
#include "scabo/analysis/increment.hpp"
#include "scabo/analysis/large_slip.hpp"
#include "scabo/analysis/outside.hpp"
#include "scabo/analysis/quantities.hpp"
#include "scabo/analysis/restart.hpp"
#include "scabo/analysis/stages.hpp"
#include "scabo/analysis/undetermined_forces.hpp"
#include "scabo/analysis/warnings.hpp"
#include "scabo/analysis/worthwhile_threads.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/contact/laws/evolution.hpp"
#include "scabo/contact/uniqueness.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/mesh/output_points.hpp"
#include "scabo/model/validate.hpp"

namespace scabo::analysis {

namespace {

/// Part of an increment that is no longer divided because its sides pass each other too far.
constexpr double smallest_part_of_slip = 1e-5;

/// Result of an attempt to reach the end of an increment.
struct Reached {
  State state;
  double part = 0.0;  ///< of the increment that was reached: 1, or less of an automatic increment
  Changes changes;    ///< of an automatic increment
  contact::Certificate certificate;
  int last_iterations = 0;  ///< of the attempt that was accepted
  int iterations = 0, coarse_iterations = 0, halvings = 0;
  double residual = 0.0;
  Matrix undetermined;
  contact::Problem problem;  ///< that was solved last
  std::optional<UniquenessResult> uniqueness;
  bool mechanism = false, collapse = false, stopped = false;
  std::string reason;          ///< empty if the end was reached
  bool pairs_are_due = false;  ///< the end was not reached: before going on, pairs are to be found anew
  std::vector<AttemptResult> attempts;
  std::vector<DiscreteProblem> problems;  ///< of the attempts, if requested
};

/// Whether the model has joints whose strength is lost when they fail.
bool breaks(const Prepared& prepared) {
  const auto& contacts = prepared.model.contacts;
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const model::Contact& contact) { return contact.cohesion > 0.0; });
}

/// What to do about a tolerance that is missed by a figure of the certificate well below the default tolerance; empty for
/// larger figures.
std::string tolerance_to_set(const Prepared& prepared, double figure) {
  constexpr double margin = 3.0;  // figures of other increments and machines differ
  if (!(figure > prepared.model.solver.tolerance && margin * figure < model::SolverOptions().tolerance)) return {};
  return fmt::format(
      "; rounding leaves {:.2g} in {} degrees of freedom: set solver.tolerance to 1e{} or leave it out, as its default of "
      "{:g} is far below the error of any mesh",
      figure, 2 * prepared.mesh.nodes(), static_cast<int>(std::ceil(std::log10(margin * figure))),
      model::SolverOptions().tolerance);
}

/// Reason why an increment with a contact solution is not accepted.
std::string above_tolerance(const Prepared& prepared, const Attempt& tried, double tolerance) {
  const double worst = tried.certificate.worst();
  std::string reason =
      fmt::format("the largest figure of the certificate, {:.3g}, is above the tolerance {:.3g}", worst, tolerance);
  if (const std::string remedy = tolerance_to_set(prepared, worst); !remedy.empty())
    reason += remedy;
  else if (worst == std::max(tried.certificate.equilibrium, tried.certificate.rigid_balance) && worst <= tried.rounding)
    reason +=
        "; with parts this stiff or bodies this slender, rounding of the displacements alone can cause this: make "
        "stiff parts less stiff or rigid, give a slender body mesh {kind: fem}, or raise solver.tolerance";
  else if (const std::string stiff = stiff_springs(prepared.model, prepared.structure, stiff_beside); !stiff.empty())
    reason += "; " + stiff;
  return reason;
}

/// Where motions are so large beside deformations that forces are lost in rounding; empty where they are not.
std::string lost_in_rounding(const Attempt& tried, double tolerance) {
  constexpr double allowance = 1e-3;  // Attempt::rounding allows for a thousand roundings
  const double lost = allowance * tried.rounding;
  if (!(lost > tolerance) || !std::isfinite(lost)) return {};
  return fmt::format(
      "; the motion is so large beside the deformation of the bodies that rounding of the displacements may leave "
      "{:.1g} of the forces unbalanced: a smaller motion, or a larger interference or load, is needed",
      lost);
}

/// In an attempt to go from part `from` of an increment to part `to`.
std::string describe_collapse(const Prepared& prepared, const contact::Solution& solution, double from, double to) {
  std::string text = "collapse: ";
  if (solution.held > 0.0)
    text +=
        fmt::format("equilibrium ends at {:.4g} of the increment, where the bodies move on without any further load",
                    from + solution.held * (to - from));
  else
    text +=
        "no equilibrium was found, and on every path of equilibria that was followed the bodies in the end move on "
        "without any further load";
  return text + " (" + describe_motions(prepared, solution.motion) + ")";
}

/// Proceeds from `from` along `factors_at` (0: its factors, 1: the end of the increment), halving the step if an
/// attempt is not accepted; every part starts from the last accepted state. With `least`, that of an automatic
/// increment, it ends with the first attempt that is accepted, and is halved as long as its part is not less than that.
/// With large slip it also ends where pairs are to be found anew, and goes on from what it then `reached`; an attempt
/// whose sides pass each other too far is made again in equal smaller parts.
Reached reach(const Prepared& prepared, Reached reached, const std::function<Factors(double)>& factors_at,
              std::optional<double> least, const LargeSlip* large, const Options& options) {
  const IncrementRule rule;
  const State from = reached.state;
  double part = 1.0 - reached.part;
  int repeats = 0;
  reached.pairs_are_due = false;
  while (reached.part < 1.0) {
    const double next = std::min(1.0, reached.part + part);
    Attempt tried = attempt(prepared, reached.state, factors_at(next));
    reached.iterations += tried.solution.iterations;
    reached.coarse_iterations += tried.solution.coarse_iterations;
    if (large && tried.accepted) {
      const double passed = large->passed(prepared, reached.state, tried.state);
      if (passed > 1.0 && part > smallest_part_of_slip) {
        part = (next - reached.part) / std::min(std::ceil(passed - 0.01), 64.0);
        reached.attempts.push_back({tried.solution.trace, false});
        if (options.on_problems && tried.problem.pairs() > 0) {
          tried.accepted = false;
          reached.problems.push_back(discrete_problem(prepared, tried));
        }
        continue;
      }
    }
    const bool may_halve = least ? 0.5 * part >= *least : reached.halvings < prepared.model.solver.halvings;
    if (tried.accepted && least) {
      reached.changes = changes_between(prepared, from, tried.state);
      if (reached.changes.too_many(rule) && may_halve && repeats < rule.repeats) {
        ++repeats;
        tried.accepted = false;
      }
    }
    reached.attempts.push_back({tried.solution.trace, tried.accepted});
    if (options.on_problems && tried.problem.pairs() > 0) reached.problems.push_back(discrete_problem(prepared, tried));
    if (tried.accepted) {
      reached.state = std::move(tried.state);
      reached.certificate = tried.certificate;
      reached.residual = tried.solution.residual;
      reached.undetermined = std::move(tried.solution.undetermined);
      reached.problem = std::move(tried.problem);
      reached.uniqueness = tried.uniqueness;
      reached.part = next;
      reached.last_iterations = tried.solution.iterations;
      if (least) break;
      reached.pairs_are_due = large && reached.part < 1.0 && large->is_due(prepared, reached.state);
      if (reached.pairs_are_due) break;
      continue;
    }
    const bool mechanism = tried.solution.status == contact::Status::mechanism,
               collapse = tried.solution.status == contact::Status::collapse;
    const bool smaller_steps_may_help = !mechanism && !collapse;
    reached.stopped = smaller_steps_may_help && options.stop && *options.stop;
    if (reached.stopped) return reached;
    if (!smaller_steps_may_help || !may_halve) {
      reached.residual = tried.solution.residual;
      reached.certificate = tried.certificate;
      reached.mechanism = mechanism;
      reached.collapse = collapse;
      if (mechanism)
        reached.reason = fmt::format("mechanism: {}, held neither by supports nor by contact and friction",
                                     describe_motions(prepared, tried.solution.motion));
      else if (collapse)
        reached.reason = describe_collapse(prepared, tried.solution, reached.part, next);
      else if (tried.solution.status == contact::Status::solved)
        reached.reason = above_tolerance(prepared, tried, prepared.model.solver.tolerance);
      else
        reached.reason =
            fmt::format("contact did not converge after {} halvings: {}", reached.halvings, tried.solution.reason);
      if (tried.solution.status == contact::Status::not_converged) {
        if (const auto motion = breaks(prepared)
                                    ? contact::mechanism_once_broken(
                                          tried.problem, laws_at(prepared, tried.state.factors), reached.state.history)
                                    : std::nullopt) {
          reached.mechanism = true;
          reached.reason = fmt::format(
              "mechanism: {}, which only the strength of the joints could prevent; no equilibrium was found with their "
              "remaining strength after {} halvings",
              describe_motions(prepared, *motion), reached.halvings);
          return reached;
        }
        contact::SolverOptions solver;
        solver.tolerance = prepared.model.solver.tolerance;
        solver.force_scale = tried.force_scale;
        if (const std::string why = contact::why_no_solution(tried.problem, solver); !why.empty())
          reached.reason += "; " + why;
        const std::string remedy = tolerance_to_set(prepared, tried.certificate.worst());
        reached.reason += remedy.empty() ? lost_in_rounding(tried, prepared.model.solver.tolerance) : remedy;
      }
      return reached;
    }
    ++reached.halvings;
    part *= 0.5;
  }
  return reached;
}

/// Adds each kind of warning once, for the increment where it first applies.
void add_warnings(const Prepared& prepared, const Reached& reached, const IncrementResult& at,
                  std::vector<Warning>& warnings) {
  const auto add = [&](WarningKind kind, const std::string& subject, const std::string& sentence) {
    for (const Warning& warning : warnings)
      if (warning.kind == kind && warning.subject == subject) return;
    warnings.push_back({kind, subject, fmt::format("step {}, increment {}: {}", at.step_name, at.increment, sentence)});
  };
  for (Eigen::Index column = 0; column < reached.undetermined.cols(); ++column) {
    const std::string motion = describe_motions(prepared, reached.undetermined.col(column));
    add(WarningKind::undetermined_motion, motion,
        fmt::format("supports, friction and loads do not determine {}; the smallest such motion was chosen: "
                    "add a support if the position matters",
                    motion));
  }
  const bool told_of_forces = std::any_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
    return warning.kind == WarningKind::undetermined_force;
  });
  if (!told_of_forces && reached.problem.pairs() == static_cast<int>(prepared.contact.pairs.size()))
    if (const auto forces = undetermined_forces_warning(prepared, reached.state, reached.problem))
      add(forces->kind, forces->subject, forces->text);
  if (reached.uniqueness && reached.uniqueness->others > 0)
    add(WarningKind::several_solutions, "",
        fmt::format("other solutions exist ({} found); the one closest to the previous "
                    "increment was chosen: see 'uniqueness' in summary.json",
                    reached.uniqueness->others));
  for (std::size_t c = 0; c < at.contacts.size(); ++c) {
    if (prepared.model.contacts[c].shear_strength.value_or(0.0) == 0.0) continue;
    if (at.contacts[c].open > 0)
      add(WarningKind::open_shear, at.contacts[c].name,
          fmt::format("open pairs of contact '{}' carry shear: a prescribed shear strength does not depend on pressure",
                      at.contacts[c].name));
  }
  constexpr double worth_saying = 3e-5;  // errors of three times the estimate were seen
  if (at.lost_to_rounding > worth_saying)
    add(WarningKind::rounding, "",
        fmt::format("rounding of the stiffness of a body this slender may change its displacements by a part of about "
                    "{:.0e}: give it mesh {{kind: fem}}, or longer elements",
                    at.lost_to_rounding));
  if (const std::string large = too_large(prepared, reached.state); !large.empty())
    add(WarningKind::large_displacement, "", large);
  if (const std::string relative = without_reference(prepared, reached.state); !relative.empty())
    add(WarningKind::no_reference, "", relative);
  for (const Warning& warning : crack_warnings(at.cracks)) add(warning.kind, warning.subject, warning.text);
  for (const Warning& warning : quantity_warnings(prepared.model, at)) add(warning.kind, warning.subject, warning.text);
}

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

/// Factors at the start of a step.
Factors start_of(const model::Model& model, std::size_t step) {
  const std::vector<double> presence = presence_at(model, static_cast<int>(step) - 1);
  const double release = takes_away(model, step) ? 1.0 : 0.0;
  if (step == 0 && model.restart)
    return {
        model.restart->load_factors, model.restart->support_factors, coefficients_at_start(model), presence, release,
        fits_at(model, -1)};
  if (step == 0)
    return {std::vector<double>(model.loads.size(), 0.0),
            std::vector<double>(model.supports.size(), 0.0),
            coefficients_at_start(model),
            presence,
            release,
            fits_at(model, -1)};
  const model::Step& before = model.steps[step - 1];
  return {before.load_factors,
          before.support_factors,
          model::coefficients_of(before),
          presence,
          release,
          fits_at(model, static_cast<int>(step) - 1)};
}

/// Factors at part `s` of a step.
Factors factors_in(const model::Model& model, std::size_t index, double s) {
  const model::Step& step = model.steps[index];
  Factors factors = between(start_of(model, index),
                            {step.load_factors, step.support_factors, model::coefficients_of(step),
                             presence_at(model, static_cast<int>(index)), 0.0, fits_at(model, static_cast<int>(index))},
                            s);
  if (s == 1.0) return factors;  // those of the curves
  const auto follow = [&](const std::vector<int>& curves, std::vector<double>& of) {
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (curves[i] >= 0) of[i] = model::value_of(model.curves[static_cast<std::size_t>(curves[i])], s);
  };
  follow(step.load_curves, factors.loads);
  follow(step.support_curves, factors.supports);
  return factors;
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

void add_slid_off(const LargeSlip& large, const State& state, const IncrementResult& at, StaticSolution& solution) {
  if (state.replaced.placement.empty()) return;
  for (const auto& [contact, sentence] : large.slid_off(solution.model, state.replaced.placement)) {
    const std::string& name = solution.model.contacts[contact].name;
    const bool told = std::any_of(solution.warnings.begin(), solution.warnings.end(), [&](const Warning& warning) {
      return warning.kind == WarningKind::slides_off && warning.subject == name;
    });
    if (!told)
      solution.warnings.push_back({WarningKind::slides_off, name,
                                   fmt::format("step {}, increment {}: {}", at.step_name, at.increment, sentence)});
  }
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
    if (options.on_increment_begin)
      options.on_increment_begin({static_cast<int>(run.step) + 1, step.name, k,
                                  step.automatic ? std::nullopt : std::optional(step.increments)});
    if (options.on_stage)
      options.on_stage(step.automatic ? fmt::format("step {}, increment {}", step.name, k)
                                      : fmt::format("step {}, increment {} of {}", step.name, k, step.increments));
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
    bool there = reached.reason.empty();
    IncrementResult result;
    if (there)
      result = timed(solution.timing.recover, [&] {
        IncrementResult of_state = described(prepared, reached.state);
        of_state.cracks = crack_results(solution, of_state);
        of_state.edges = edge_forces(prepared, reached.state, solution);
        return of_state;
      });
    if (there && !std::isfinite(result.energy.elastic)) {
      there = false;
      reached.reason =
          "the elastic energy exceeds the range of floating-point numbers: check the units of stiffness, loads and "
          "temperature";
    }
    result.step = static_cast<int>(run.step) + 1;
    result.step_name = step.name;
    result.increment = k;
    result.reached = reached.part == 1.0 ? end : begin + reached.part * (end - begin);
    result.converged = there;
    result.newton_iterations = reached.iterations;
    result.coarse_iterations = reached.coarse_iterations;
    result.halvings = reached.halvings;
    result.pairs_found = found;
    result.residual = reached.residual;
    result.certificate = reached.certificate;
    result.reason = reached.reason;
    result.attempts = std::move(reached.attempts);
    result.uniqueness = reached.uniqueness;
    if (there) add_warnings(prepared, reached, result, solution.warnings);
    if (there && large) add_slid_off(*large, reached.state, result, solution);
    solution.increments.push_back(std::move(result));
    if (!reached.problems.empty()) options.on_problems(solution.increments.back(), reached.problems);
    if (!there) {
      solution.outcome = reached.mechanism  ? Outcome::mechanism
                         : reached.collapse ? Outcome::collapse
                                            : Outcome::not_converged;
      solution.reason = fmt::format("step {}, increment {}: {}", step.name, k, reached.reason);
      if (options.on_increment) options.on_increment(solution, solution.increments.back());
      return;
    }
    run.state = std::move(reached.state);
    progress.increment = k;
    progress.reached = solution.increments.back().reached;
    if (step.automatic)
      progress.size = next_size(*step.automatic, progress.reached - begin, reached.halvings > 0, reached.changes,
                                reached.last_iterations);
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
  for (Warning& warning : load_warnings(solution.model, assembly->structure))
    solution.warnings.push_back(std::move(warning));
  run_steps(std::move(assembly), large ? &*large : nullptr, solution, options);
  for (Warning& warning : contact_warnings(solution)) solution.warnings.push_back(std::move(warning));
  return solution;
}

}  // namespace scabo::analysis
