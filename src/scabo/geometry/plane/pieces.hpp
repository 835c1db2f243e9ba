// Edges cut where they meet, so that what remains meets at its ends only, or coincides.
#pragma once

#include <vector>

#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// For each edge the positions on it, ascending from 0 to 1, at which another one crosses it, ends on it or begins to
/// lie on it. Lengths up to `tolerance` are rounding. None of the edges is a chain.
std::vector<std::vector<double>> meeting_positions(const std::vector<const Edge*>& edges, double tolerance);

/// The part of an edge, not a chain, from position `from` to position `to`.
Edge part_of(const Edge& edge, double from, double to);

/// How closed outlines lie to each other. Parts of them may coincide.
struct Overlap {
  bool share_area = false;    ///< some points are inside both
  bool first_beyond = false;  ///< some points are inside the first only
  bool second_beyond = false;
  Vec2 crossing = Vec2::Zero();  ///< where a boundary enters the other outline, if all three are true
};

/// `a` and `b` run counter-clockwise, around holes clockwise.
Overlap overlap_of(const Outline& a, const Outline& b, double tolerance);

}  // namespace scabo::geometry
