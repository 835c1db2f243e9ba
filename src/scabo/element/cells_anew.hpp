// Super-elements of a mesh that has changed in part.
#pragma once

#include <vector>

#include "scabo/element/cell_library.hpp"

namespace scabo::element {

/// solve_cells(), with the solutions of those that are the same to the last bit `before`, on another mesh of the model.
/// Results are those of solve_cells().
std::vector<SolvedCells> solve_cells_anew(const model::Model& model, const mesh::Mesh& mesh, int threads,
                                          const std::vector<SolvedCells>& before);

}  // namespace scabo::element
