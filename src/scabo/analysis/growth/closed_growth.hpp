// The body on the mesh of its longer cracks, with these closed along their new parts: cracks as they were, on the mesh
// on which they have grown.
//
// It follows from the flexibility A of the open body. The two differ in few cells, of stiffness K_p:
//
//  - All cells at an old tip together are one open super-element with the tip as its scaling centre, as it is on the
//    mesh before: it has the singular field of the closed body.
//  - The cell around a new tip, with its rings if the faces are in contact, is one without a crack.
//
// K_c: stiffness of these. The displacements v of the closed body give those of the open one on the degrees of freedom
// of the cells and of the new faces, S, as u = T v: opposite nodes of the new faces have the same, and nodes inside the
// joined cells follow from its field. Forces q on S hold the open body, with displacements u_0 there, in that shape:
//
//     u_0 + A q = T v,      T'q = (T'K_p T - K_c) v                                                                (1)
//
// Where something acts on faces inside these cells, their nodes move by w besides, the boundary of the cell at rest:
// u = T v + W w, with the stiffness W'K_p W of the open body's cells. The field of v does no work with w, as it is in
// balance. Both make one vector (v, w), with (T, W) for T, and with W'K_p W beside K_c for K_c.
//
// The second line is the balance of the closed body. Both under the same loads, its potential energy is larger by
//
//     Pi_c - Pi_0 = 1/2 q'A q - 1/2 v'T'K_p T v + 1/2 v'K_c v = -1/2 q'u_0                                          (2)
//
// With the displacements d = A q of the whole body, which are 0 at supports, it stores more by
//
//     f'd + 1/2 q'A q - 1/2 v'T'K_p T v + 1/2 v'K_c v                                                               (3)
//
// where f are loads and pair forces: d is needed where these act alone.
//
// Nodes inside these cells on which nothing acts are first eliminated from K_p and not among S.
#pragma once

#include <optional>
#include <vector>

#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

struct ClosedGrowth {
  std::vector<Vector> moved;  ///< d per part, where forces act, and anything elsewhere
  double elastic = 0.0;       ///< eq. (3), force times length
  double released = 0.0;      ///< eq. (2), force times length
};

/// `open`: a state with the cracks as they are. `before`: where each tip was, empty for those that have not moved.
/// Nothing if the cells at an old tip are not seen from it.
std::optional<ClosedGrowth> closed_growth(const Prepared& prepared, const State& open, const std::vector<Tip>& tips,
                                          const std::vector<std::optional<Vec2>>& before);

}  // namespace scabo::analysis
