// Super-elements of one mesh that are those of another one.
#pragma once

#include <vector>

#include "scabo/element/cell_library.hpp"

namespace scabo::element {

/// Takes solutions of `like`, another mesh, for those of `cells` that are equal to rounding. Which of several equal
/// cells was solved for all of them differs between meshes: with this the stiffness of the others stays, bit for bit.
void take_alike(std::vector<SolvedCells>& cells, const mesh::Mesh& mesh, const std::vector<SolvedCells>& like);

}  // namespace scabo::element
