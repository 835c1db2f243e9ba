// Which edges of different outlines lie on each other.
#pragma once

#include <vector>

#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// Two edges of different bodies that face each other.
struct TouchingEdges {
  int body_a = -1, edge_a = -1, body_b = -1, edge_b = -1;  ///< body_a < body_b
};

/// All pairs of edges of different outlines that face each other along a part of their length at a distance of at most
/// `reach` (length, >= 0; distances of up to 1e-6 of an edge's length are rounding). Ordered by bodies, then edges.
/// Edges that touch in a point only, or share less than a thousandth of the shorter one, are left out; with `reach`
/// also arcs whose nearest points are within it are found. `outlines`: null for a body that takes no part.
std::vector<TouchingEdges> touching_edges(const std::vector<const Outline*>& outlines, double reach);

}  // namespace scabo::geometry
