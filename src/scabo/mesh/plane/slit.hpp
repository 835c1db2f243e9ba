// Cracks along sides of cells that are there already: finite elements, and the cells of a mesh file.
//
// A crack is a path along which every part of it is a side of cells. Three steps open it:
//  1. The nodes on the path are doubled, one for each group of cells that hang together around a node. The end of a
//     path where all cells hang together is a tip. Sides that have nodes of their own on either side already (a file
//     may have been slit when it was made) stay as they are.
//  2. The cells around a tip become one open super-element with the tip as scaling centre: those with a node at the tip
//     and, as long as the tip sees the whole boundary and nothing else lies inside, `layers` of cells around them. The
//     crack within it becomes its two side faces.
//  3. Sides of that cell that the tip sees under more than 22.5 degrees are divided. Finite elements beside them have
//     then more nodes than an element has, and become super-elements.
#pragma once

#include <variant>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

struct SlitOptions {
  /// Rows of cells around a tip that become one cell. Measured with finite elements in docs/methods/22_many_cells.md.
  int layers = 3;
};

/// `mesh` with the cracks of `body` (all have a path), whose faces it gets; or what of a crack is wrong.
std::variant<BodyMesh, Diagnostic> slit(BodyMesh mesh, const model::Body& body, const SlitOptions& options = {});

}  // namespace scabo::mesh
