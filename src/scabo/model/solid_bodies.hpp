// The bodies that the cells of a mesh file are, and the faces by which they can be named.
//
// Cells that sides do not join are bodies of their own, whatever nodes they share. Faces of a body are
//     the side sets of the file        those sides that belong to one cell of the body only
//     to_NAME                          sides where cells of the set NAME lie on the other side, outside of the body
//     face_1, face_2, ...              all other outer sides, cut where the boundary turns by more than 30 degrees, in
//                                      the order of their first cells
// and the node sets of the file: the outer sides whose corners are all in one.
#pragma once

#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"

namespace scabo::model {

/// In the order of their first cells. `cell_set`: only of its cells; -1: of all. Each has the sets of the file with its
/// cells and nodes, and the faces above as side sets, of which one may be empty that has inner sides only.
std::vector<files::ImportedSolidMesh> solid_bodies(const files::ImportedSolidMesh& mesh, int cell_set);

}  // namespace scabo::model
