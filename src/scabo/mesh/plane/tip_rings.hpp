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
// factors (analysis/state/cracks.cpp) and in the pressures beside them (system/tributary_lengths.hpp). Where supports
// hold its faces, its stiffness is that of held faces (HeldFaces, element/plane/held_faces.hpp).
//
// A body that is one open super-element is divided in the same way as soon as supports or springs act on a side face:
// its faces get nodes, and all else is that of a body of many cells. Its boundary may be divided far more finely than
// the field near the scaling centre needs: elements of one edge that together are short as seen from the centre have
// one element in the copies.
#pragma once

#include <limits>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// With these values a crack that slides everywhere has K_II to 1e-7 and |K_I| below 5e-7 K_II, for a cell of a tenth
/// of its half length, and its pressure is uniform to 2e-4 from 1e-6 of the tip on (docs/methods/22_many_cells.md).
struct TipRings {
  int count = 14;      ///< 1 or more; fewer where the coordinates do not have enough digits
  double ratio = 0.3;  ///< of the sizes of neighbouring copies, between 0 and 1
  int order = 8;       ///< of all sides of copies and between them, at least; otherwise that of the boundary elements
  /// Elements of one edge have one element in the copies while their length is below this times their least distance
  /// from the tip; 0: each has its own. At 0.8 an element of order 8 represents what varies with the distance from the
  /// tip to 2e-6, and one from copy to copy to 5e-5.
  double joined = 0.0;
  double longest = std::numeric_limits<double>::infinity();  ///< length of joined elements at most
  /// Neighbouring copies differ in size, relative to the boundary, by this at most; `count` does not count the rings
  /// for which this is less than `ratio` would give.
  double step = 1.0;
};

/// Divides the cells at the tips of `cracks`.
void add_tip_rings(BodyMesh& mesh, const model::Body& body, const std::vector<int>& cracks, const TipRings& rings = {});

/// Divides a body that is one open super-element, which keeps its nodes and their numbers; the innermost copy is cell
/// 0. Number of rings.
int divide_side_faces(BodyMesh& mesh, const model::Body& body, const TipRings& rings);

/// Sets Cell::held of the cells at the tips of cracks, and of the innermost copies, from the supports of the model.
void hold_tips(BodyMesh& mesh, const model::Model& model, int body);

}  // namespace scabo::mesh
