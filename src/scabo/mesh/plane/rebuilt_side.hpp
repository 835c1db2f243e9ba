// The elements of a side of a contact between its break points (matched_side.hpp), put into the mesh of its body.
#pragma once

#include <vector>

#include "scabo/mesh/plane/matched_side.hpp"
#include "scabo/mesh/plane/node_matching.hpp"

namespace scabo::mesh {

/// Break points nearer than this fraction of the adjacent elements become opposite each other: 1/10, less what rounding
/// makes of it, as beside 10 elements and 11.
constexpr double snapping = 0.1 * (1.0 - 1e-6);
/// Those nearer than this fraction are opposite each other already.
constexpr double coincidence = matching_tolerance;

/// The element of a side between break points k and k + 1.
struct Piece {
  int old = -1;             ///< element that it is, or is a part of
  bool whole = true;        ///< the element is not divided
  bool placed = false;      ///< its inner nodes have to be where `inner` says
  std::vector<Vec2> inner;  ///< inner nodes: one less than its order
};

/// Pieces with the orders of their elements, and inner nodes at the Gauss-Lobatto-Legendre points along the edge.
std::vector<Piece> pieces_of(const MatchedSide& side);

/// Gives `mesh` new break points, moves those that have moved, and replaces elements that are divided, raised or not in
/// place. New nodes of curved elements of files are on these elements. Returns whether anything has changed.
bool rebuild_side(MatchedSide& side, std::vector<Piece> pieces, BodyMesh& mesh);

/// Whether the break points are ascending, as the nodes of the edge are.
bool is_ascending(const MatchedSide& side);

}  // namespace scabo::mesh
