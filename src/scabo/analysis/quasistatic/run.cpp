#include "scabo/analysis/quasistatic/run.hpp"

#include <optional>

#include "scabo/analysis/diagnostics/warnings.hpp"
#include "scabo/analysis/march/steps.hpp"
#include "scabo/analysis/quasistatic/scheme.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/system/worthwhile_threads.hpp"

namespace scabo::analysis {

namespace {

/// What finds pairs anew, if contacts of the model slip far. The mesh becomes that in which they were found last, in
/// this run or in another one.
std::optional<LargeSlip> large_slip_of(StaticSolution& solution, const Options& options) {
  if (!model::has_large_slip(solution.model.contacts)) return std::nullopt;
  LargeSlip large(solution.model);
  const mesh::Placement at_start = options.from             ? options.from->at.state.replaced.placement
                                   : solution.model.restart ? placement_of_restart(solution.model)
                                                            : mesh::Placement();
  if (at_start.empty()) return large;
  auto found = large.mesh_in(solution.model, at_start);
  if (auto* wrong = std::get_if<std::vector<Diagnostic>>(&found))
    throw InputError(solution.model.file, std::move(*wrong));
  solution.mesh = std::get<mesh::Mesh>(std::move(found));
  return large;
}

}  // namespace

StaticSolution solve_on_mesh(model::Model model, mesh::Mesh mesh, const Options& options, const GoThrough& go_through) {
  const int threads = system::worthwhile_threads(model, mesh, options.threads);
  linalg::set_blas_threads(threads);
  StaticSolution solution;
  solution.model = std::move(model);
  solution.mesh = std::move(mesh);
  solution.threads = threads;
  solution.ranks = options.ranks;
  if (options.from) solution.timing = options.from->timing;

  std::optional<LargeSlip> large = large_slip_of(solution, options);
  try {
    discretise(solution, options.on_stage, solution.timing);
    if (options.on_mesh) options.on_mesh(solution);
  } catch (const EndAtOnce&) {
    if (options.from) solution.increments = options.from->increments;
    solution.warnings = options.from ? options.from->warnings : solution.model.warnings;
    interrupt(solution);
    drop_systems(solution);
    return solution;
  }
  solution.warnings = solution.model.warnings;
  for (Warning& warning : slender_warnings(solution.model, solution.mesh))
    solution.warnings.push_back(std::move(warning));
  for (Warning& warning : load_warnings(solution.model, *solution.structure))
    solution.warnings.push_back(std::move(warning));
  {
    Quasistatic scheme(solution, std::move(large), options.from ? options.from->at.step : 0, options.on_iteration);
    if (go_through)
      go_through(scheme, solution, options);
    else
      march(scheme, solution, options);
  }
  drop_systems(solution);
  for (Warning& warning : contact_warnings(solution)) solution.warnings.push_back(std::move(warning));
  return solution;
}

}  // namespace scabo::analysis
