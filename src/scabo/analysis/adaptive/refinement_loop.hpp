// Refinement, whatever for: solve on a mesh, estimate, mark the parts that have the largest share of the error, refine
// them (refinement.hpp), and solve again on the finer mesh, until the estimate is small enough or meshes become too
// large. What is estimated, and which share of it a part has, is the aim.
#pragma once

#include <optional>
#include <string>

#include "scabo/analysis/adaptive/refinement.hpp"
#include "scabo/analysis/march/options.hpp"

namespace scabo::analysis {

struct RefinementLimits {
  int dofs = 5000;              ///< in a body that is one super-element
  int dofs_of_cells = 100'000;  ///< in a body of many cells
  int passes = 40;
  int without_progress = 4;  ///< number of passes that together reduce the sum by less than a fifth
};

/// What the estimate says of a solution.
struct Estimate {
  double error = 0.0;  ///< RefinementPass::error
  double sum = 0.0;    ///< of the shares of all parts: what refinement reduces
  bool ends = false;   ///< it is small enough, or no finer mesh would help: then the solution says why
};

class Aim {
 public:
  virtual ~Aim() = default;
  /// The analysis on a mesh and what its estimate needs. `name`: what users are told that is being solved.
  virtual StaticSolution solve(mesh::Mesh mesh, const std::string& name) = 0;
  /// Of the solution that was solved last, on a mesh made from `of`. Nothing if there is none, for the reason that the
  /// solution then has.
  virtual std::optional<Estimate> estimate(StaticSolution& solution, const ModelRefinement& of) = 0;
  /// Shares of the parts in that estimate.
  virtual MeshErrors errors(const StaticSolution& solution) = 0;
  /// The last solution as the result, where there is no finer mesh, with the reason.
  virtual StaticSolution not_reached(StaticSolution solution, const ModelRefinement& of, const std::string& why) = 0;
};

/// The solution on the first mesh that satisfies the aim, or the last one, with all passes. `refinement` makes the
/// meshes.
StaticSolution refine(Aim& aim, ModelRefinement& refinement, const RefinementLimits& limits);

}  // namespace scabo::analysis
