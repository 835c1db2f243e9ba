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

struct TipRings {
  int count = 24;      ///< 1 or more
  double ratio = 0.5;  ///< of the sizes of neighbouring copies, between 0 and 1
};

/// Divides the cells at the tips of `cracks`.
void add_tip_rings(BodyMesh& mesh, const model::Body& body, const std::vector<int>& cracks, const TipRings& rings = {});

}  // namespace scabo::mesh
