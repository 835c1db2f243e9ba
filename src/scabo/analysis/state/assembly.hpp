// The systems of all bodies on one mesh, condensed to the pairs: what all increments on this mesh need.
#pragma once

#include <memory>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Refers to the model, mesh and super-elements of a solution.
struct Assembly {
  Assembly(system::Structure made, const StaticSolution& solution,
           std::function<void(const contact::Iteration&)> on_iteration);
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  const system::Structure structure;
  const system::ContactSystem contact;
  const Prepared prepared;
};

/// Super-elements of a mesh of a solution, with what it has of them; those of bodies that are divided among its ranks
/// are solved there.
std::vector<element::SolvedCells> solved_cells(const StaticSolution& solution, const mesh::Mesh& mesh);

/// Of a solution with model, mesh and solved super-elements, on its threads; adds to its timing. `on_stage` and
/// `on_iteration`: as of Options, or empty.
std::unique_ptr<const Assembly> assemble(StaticSolution& solution,
                                         const std::function<void(const std::string&)>& on_stage,
                                         const std::function<void(const contact::Iteration&)>& on_iteration);

}  // namespace scabo::analysis
