#include "scabo/analysis/static_analysis.hpp"

#include <algorithm>

#include "scabo/analysis/adaptive/adaptive.hpp"
#include "scabo/analysis/adaptive/goal.hpp"
#include "scabo/analysis/growth/grow.hpp"
#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/in_time.hpp"
#include "scabo/analysis/march/steps.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/analysis/state/outside.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/mesh/plane/output_points.hpp"
#include "scabo/model/validate.hpp"

namespace scabo::analysis {

mesh::Mesh check(const model::Model& model) {
  model::require_valid(model);
  if (model.analysis.type == model::AnalysisType::modal) {  // bodies may be free and do not interact
    model::Model apart = model;
    apart.contacts.clear();
    mesh::Mesh mesh = mesh::make_mesh(apart);
    system::constraints_of(apart, mesh, system::Dofs(apart, mesh));
    return mesh;
  }
  check_growth(model);
  mesh::Mesh mesh = mesh::make_mesh(model::has_growth(model) ? with_fine_tips(model) : model);
  if (!model::is_all_dynamic(model)) system::check_supports(model, mesh);
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
         !model.output.error && !model::is_dynamic(model) && !model::has_growth(model) && !model.analysis.revolved();
}

namespace {

StaticSolution solve_in_time(model::Model model, mesh::Mesh mesh, const Options& options) {
  return solve_on_mesh(std::move(model), std::move(mesh), options,
                       [](Quasistatic& statics, StaticSolution& solution, const Options& with) {
                         StaticThenDynamic scheme(statics, solution);
                         march(scheme, solution, with);
                       });
}

/// Quasi-static steps, then one in which cracks grow.
StaticSolution solve_with_growth(model::Model model, mesh::Mesh mesh, const Options& options) {
  return solve_on_mesh(std::move(model), std::move(mesh), options,
                       [](Quasistatic& statics, StaticSolution& solution, const Options& with) {
                         Options before = with;
                         before.on_end = {};
                         std::optional<State> reached;
                         if (with.from && !continues_growth(solution.model, with))
                           complete(statics.now(), reached.emplace(with.from->at.state));
                         before.on_state = [&](const Prepared& prepared, const State& state, const StaticSolution& at) {
                           reached = state;
                           if (with.on_state) with.on_state(prepared, state, at);
                         };
                         if (!continues_growth(solution.model, with))
                           march(statics, solution, before, solution.model.steps.size() - 1);
                         if (solution.outcome == Outcome::solved) grow(solution, with, std::move(reached));
                       });
}

}  // namespace

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
  const bool in_time = model::is_dynamic(model);
  StaticSolution solution = in_time                    ? solve_in_time(std::move(model), std::move(mesh), here)
                            : model::has_growth(model) ? solve_with_growth(std::move(model), std::move(mesh), here)
                            : wants_bars(model)        ? solve_with_bars(std::move(model), std::move(mesh), here)
                            : wants_refinement(model)  ? solve_refined(std::move(model), here)
                            : model.output.error       ? solve_with_error(std::move(model), std::move(mesh), here)
                                                       : solve_on_mesh(std::move(model), std::move(mesh), options);
  solution.timing.mesh += seconds;
  return solution;
}

}  // namespace scabo::analysis
