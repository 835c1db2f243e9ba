// Rings around the tip of a crack whose faces are in contact.
//
// The cell around a tip is one open super-element, which represents the singular field exactly but has no nodes on its
// side faces. It is divided into rings between similar copies of its boundary, scaled by xi_k = ratio^k about the tip,
//
//     ring k: xi_(k+1) < xi < xi_k,   k = 0 ... count - 1
//
// and each ring into a quadrilateral super-element for every boundary element. The sides of these along the two side
// faces are elements of the faces of the crack, with nodes as on any other. The copies have a higher order than the
// boundary: what a discretised field of K_II leaves of pressure on the faces grows towards the tip as r^(-1/2). The
// innermost copy remains an open super-element with faces free of traction: from it come the stress intensity factors.
// The traction that is missing on its faces, of length d = xi_count times the size of the cell, is accounted for in the
// factors (analysis/cracks.cpp) and in the pressures beside them (system/tributary_lengths.hpp).
#pragma once

#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// With these values a crack that slides everywhere has K_II to 7e-6 and |K_I| below 5e-7 K_II, for a cell of a tenth
/// of its half length, and its pressure is uniform to 2e-4 from 1e-6 of the tip on (docs/methods/22_many_cells.md).
struct TipRings {
  int count = 14;      ///< 1 or more; fewer where the coordinates do not have enough digits
  double ratio = 0.3;  ///< of the sizes of neighbouring copies, between 0 and 1
  int order = 8;       ///< of all sides of copies and between them, at least; otherwise that of the boundary elements
};

/// Divides the cells at the tips of `cracks`.
void add_tip_rings(BodyMesh& mesh, const model::Body& body, const std::vector<int>& cracks, const TipRings& rings = {});

}  // namespace scabo::mesh
