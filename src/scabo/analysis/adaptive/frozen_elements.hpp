// Elements and cells that refinement and estimates of errors leave as they are (adaptive.hpp says why).
#pragma once

#include <vector>

#include "scabo/analysis/march/options.hpp"

namespace scabo::analysis {

/// [body][cell], or [body][boundary element of all cells, in their order].
using Flags = std::vector<std::vector<bool>>;

/// Length around a point force in which cells are left out, relative to the size of the first mesh.
inline constexpr double spread_of_force = 0.15;

/// Whether the place is a point: a corner or a node.
bool is_point(const model::Place& place);

/// Whether the error of the body is estimated: it is elastic. The wider displacement of finite elements is that of
/// super-elements of the next order in their place.
bool has_estimate(const Discretisation& discretisation, std::size_t body);

/// Cells beside point forces, and similar places with infinite stress, in bodies of many cells.
Flags left_out_cells(const StaticSolution& solution);

/// Boundary elements that cannot be changed without separating pairs of nodes and, if `at_singular_places`, those
/// beside point forces and the like.
Flags frozen_elements(const StaticSolution& solution, bool at_singular_places);

/// The mesh with all sides of cells one order higher, except where that would separate pairs of nodes; finite elements
/// become super-elements. Sides keep their curves.
mesh::Mesh raised(const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::analysis
