// Rings around the tip of a crack whose faces are in contact.
//
// The cell around a tip is one open super-element, which represents the singular field exactly but has no nodes on its
// side faces. It is divided into rings between similar copies of its boundary, scaled by xi_k = ratio^k about the tip,
//
//     ring k: xi_(k+1) < xi < xi_k,   k = 0 ... count - 1
//
// and each ring into a quadrilateral super-element for every boundary element. The sides of these along the two side
// faces are elements of the faces of the crack, with nodes as on any other. The innermost copy remains an open
// super-element with faces free of traction: from it come the stress intensity factors. A traction p on its faces is
// missing, which changes them by 2 p sqrt(2 d / pi), d = xi_count times the size of the cell.
#pragma once

#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// With these values a crack that slides everywhere has K_II to 1.3e-4 and |K_I| below 8e-5 K_II, for a cell of a tenth
/// of its half length; the number of the rings determines K_I, their ratio and order the rest
/// (docs/methods/22_many_cells.md).
struct TipRings {
  int count = 14;      ///< 1 or more; fewer where the coordinates do not have enough digits
  double ratio = 0.3;  ///< of the sizes of neighbouring copies, between 0 and 1
  int order = 4;       ///< of the sides between copies, at least; otherwise that of the boundary elements
};

/// Divides the cells at the tips of `cracks`.
void add_tip_rings(BodyMesh& mesh, const model::Body& body, const std::vector<int>& cracks, const TipRings& rings = {});

}  // namespace scabo::mesh
