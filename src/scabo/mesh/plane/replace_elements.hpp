// Changes of single line elements of a body: in its edges and in the boundaries of its cells.
#pragma once

#include <map>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// For the nodes of a line element, the elements that take its place, in its direction and from end to end.
using Replacements = std::map<std::vector<int>, std::vector<LineElement>>;

/// Replaces line elements in edges, faces of cracks and cells, in whichever direction they run there. Finite elements
/// that would no longer be ones become super-elements.
void replace_elements(BodyMesh& mesh, const Replacements& replacements);

/// Makes a finite element a super-element with the centroid as scaling centre.
void become_superelement(Cell& cell, const std::vector<Vec2>& nodes);

/// Moves end nodes of line elements (node -> new position). Line elements of cells that end there, except the
/// `replaced` ones, follow: their inner nodes are displaced in proportion to the distance from the other end.
void move_nodes(BodyMesh& mesh, const std::map<int, Vec2>& moved, const Replacements& replaced);

/// The mesh without unused nodes. The nodes of a body that is one super-element are numbered along its boundary.
BodyMesh renumbered(const BodyMesh& mesh);

}  // namespace scabo::mesh
