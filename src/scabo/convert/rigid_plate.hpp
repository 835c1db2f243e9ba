// A layer of elements on a face: the rigid plate by which the face moves as one piece.
#pragma once

#include <string>
#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"

namespace scabo::convert {

/// Whether sides (4 times the cell and the side) hang together by their edges.
bool hang_together(const files::ImportedSolidMesh& mesh, const std::vector<int>& sides);

/// Nodes and tetrahedra of the plate as text of a mesh file, with the element set `region` and the node set `face` of
/// its nodes on the sides. Both numbers are the first ones that are free, and become those after the plate.
std::string plate_text(const files::ImportedSolidMesh& mesh, const std::vector<int>& sides, const std::string& region,
                       const std::string& face, std::int64_t& node, std::int64_t& cell);

}  // namespace scabo::convert
