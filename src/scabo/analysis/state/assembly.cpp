#include "scabo/analysis/state/assembly.hpp"

#include <algorithm>

#include "scabo/analysis/state/outside.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/system/sliding_sides.hpp"

namespace scabo::analysis {

namespace {

double force_scale(const system::Structure& structure) {
  double largest = 0.0;
  for (const std::vector<Vector>& load : structure.loads)
    for (const Vector& forces : load)
      if (forces.size() > 0) largest = std::max(largest, forces.lpNorm<Eigen::Infinity>());
  return largest;
}

}  // namespace

Assembly::Assembly(system::Structure made, const StaticSolution& solution,
                   std::function<void(const contact::Iteration&)> on_iteration)
    : structure(std::move(made)),
      contact(system::condense(structure, solution.model, solution.mesh, solution.threads)),
      prepared{solution.model,
               solution.mesh,
               structure,
               contact,
               force_scale(structure),
               references_of(solution.model, solution.mesh, solution.cells, structure.dofs),
               std::move(on_iteration),
               {}} {}

std::vector<element::SolvedCells> solved_cells(const StaticSolution& solution, const mesh::Mesh& mesh) {
  return element::solve_cells(solution.model, mesh, solution.threads,
                              system::divided_bodies(solution.ranks, solution.model, mesh), solution.cells);
}

std::unique_ptr<const Assembly> assemble(StaticSolution& solution,
                                         const std::function<void(const std::string&)>& on_stage,
                                         const std::function<void(const contact::Iteration&)>& on_iteration) {
  const auto stage = [&](const char* what) {
    if (on_stage) on_stage(what);
  };
  Timing& timing = solution.timing;
  stage("factorisation");
  system::Structure structure = timed(timing.factorise, [&] {
    return system::make_structure(solution.model, solution.mesh, solution.cells, solution.threads, solution.ranks);
  });
  timing.factorise -= structure.assembly_seconds;
  timing.assemble += structure.assembly_seconds;
  timed(timing.assemble, [&] { system::add_loads(structure, solution.model, solution.mesh, solution.cells); });
  timed(timing.assemble, [&] { system::let_slide(structure, solution.model, solution.mesh); });
  stage("condensation to the contact pairs");
  return timed(timing.condense,
               [&] { return std::make_unique<const Assembly>(std::move(structure), solution, on_iteration); });
}

}  // namespace scabo::analysis
