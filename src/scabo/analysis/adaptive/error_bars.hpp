// Bars of single numbers: their values on richer meshes, eq. (1) of goal.hpp.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/adaptive/adaptive.hpp"
#include "scabo/analysis/adaptive/refinement.hpp"

namespace scabo::analysis {

/// Eq. (1): the bar over the difference from the richest mesh.
inline constexpr double bar_factor = 2.0;

/// The numbers of a model that get a bar, that of its tolerance first.
std::vector<const model::Quantity*> quantities_of(const model::Model& model);

/// Where the mesh of the results comes from.
struct MeshSource {
  const model::Model& model;
  const ModelRefinement* refinement = nullptr;  ///< its division and sizes
  const mesh::Mesh* mesh = nullptr;             ///< a mesh refined for tolerances of bodies; only its orders are raised
};

/// Values of all quantities, [increment][quantity]; not a number where there is none.
using Values = std::vector<std::vector<double>>;

/// Values on richer meshes, the richest one last.
struct RicherValues {
  std::vector<Values> values;
  std::string why;  ///< if there are fewer than two of them
};

RicherValues richer_values(const MeshSource& source, const StaticSolution& solution, const Options& options);

/// Adds the bars to the increments of a solution, or a warning that there are none.
void add_bars(StaticSolution& solution, const model::Model& model, const RicherValues& richer);

}  // namespace scabo::analysis
