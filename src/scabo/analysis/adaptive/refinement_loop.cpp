#include "scabo/analysis/adaptive/refinement_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace scabo::analysis {

namespace {

/// Why no further pass is made after those with these sums; empty if one is.
std::string stalled(const std::vector<double>& sums, const RefinementLimits& limits) {
  const auto back = static_cast<std::size_t>(limits.without_progress);
  if (sums.size() > back && sums.back() > 0.8 * sums[sums.size() - 1 - back])
    return "further refinement does not reduce it";
  if (static_cast<int>(sums.size()) >= limits.passes) return fmt::format("{} passes were made", limits.passes);
  return {};
}

/// Why the next mesh is not made; empty if it is.
std::string too_fine(const ModelRefinement& next, const mesh::Mesh& mesh, const RefinementLimits& limits) {
  int present = 0;
  for (const mesh::BodyMesh& body : mesh.bodies)
    if (body.cells.size() == 1)
      present = std::max(present, static_cast<int>(mesh.components().count(body.nodes.size())));
  const int dofs = next.boundaries.largest_body(), of_cells = next.cells.largest_body();
  const auto text = [](const char* about, int would, int most) {
    return fmt::format("a finer mesh would have {}{} degrees of freedom in one body, more than {}", about, would, most);
  };
  if (dofs > std::max(limits.dofs, present)) return text("", dofs, limits.dofs);
  if (of_cells > limits.dofs_of_cells) return text("about ", of_cells, limits.dofs_of_cells);
  return {};
}

/// The last solution, where another one is interrupted before its first increment.
StaticSolution interrupted(StaticSolution last) {
  last.outcome = Outcome::interrupted;
  last.reason = "interrupted: the tolerance is not reached";
  return last;
}

}  // namespace

StaticSolution refine(Aim& aim, ModelRefinement& refinement, const RefinementLimits& limits) {
  std::vector<RefinementPass> passes;
  std::vector<double> sums;
  const auto end = [&](StaticSolution solution) {
    solution.passes = passes;
    return solution;
  };
  std::optional<StaticSolution> last;
  std::optional<ModelRefinement> of_last;  // from which its mesh was made
  while (true) {
    StaticSolution solution;
    try {
      solution = aim.solve(refinement.mesh(), fmt::format("pass {}", passes.size() + 1));
    } catch (const InputError& error) {
      if (!last) throw;
      return end(aim.not_reached(std::move(*last), *of_last, error.diagnostics().front().message));
    }
    if (last && solution.outcome == Outcome::interrupted && solution.increments.empty())
      return end(interrupted(std::move(*last)));
    const std::optional<Estimate> estimate = aim.estimate(solution, refinement);
    if (!estimate) return end(std::move(solution));
    passes.push_back({solution.mesh.dofs(), estimate->error, 0, 0});
    sums.push_back(estimate->sum);
    if (estimate->ends) return end(std::move(solution));

    of_last.emplace(refinement);
    std::string obstacle = stalled(sums, limits);
    if (obstacle.empty()) {
      const MeshErrors errors = aim.errors(solution);
      const RefinementPass refined = refinement.refine(errors, mark(refinement.parts(errors)));
      passes.back().raised = refined.raised;
      passes.back().divided = refined.divided;
      obstacle = refined.raised + refined.divided == 0 ? "no element can be refined further"
                                                       : too_fine(refinement, solution.mesh, limits);
    }
    if (!obstacle.empty()) return end(aim.not_reached(std::move(solution), *of_last, obstacle));
    last = std::move(solution);
  }
}

}  // namespace scabo::analysis
