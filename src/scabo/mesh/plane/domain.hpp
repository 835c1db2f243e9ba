// What a mesher of many cells is given, and what it gives: straight-sided polygons. Their sides are made line elements
// of any order, curved where they lie on arcs, afterwards (many_cells.hpp).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scabo/geometry/plane/outline.hpp"

namespace scabo::mesh {

/// A straight or circular piece of the border of a region, or of a crack. Lines meet only at their ends.
struct DomainLine {
  /// From its start to its end, both included, two or more; a mesh of polygons has a node at each of them and none
  /// between them. On an arc they lie on the arc.
  std::vector<Vec2> points;
  std::optional<geometry::Arc> arc;  ///< empty: straight
  int left = 0, right = -1;          ///< region on its left and right; -1: outside of the body
  bool crack = false;                ///< its two sides have nodes of their own, except at its tips
};

/// The plane region of a body. Regions are numbered from 0; all of them are bounded by lines, which need not be in any
/// order. A body with holes is bounded by several closed chains of lines.
struct Domain {
  std::vector<DomainLine> lines;
  std::function<double(const Vec2&)> size;  ///< wanted length of the sides of a cell, > 0, at a point
  /// Points at which lines end and which are to be scaling centres (crack tips, re-entrant corners); their cells have
  /// no node there.
  std::vector<Vec2> centres;
};

/// A cell: a polygon all of whose sides are visible from its scaling centre.
struct PolygonCell {
  std::vector<int> nodes;         ///< counter-clockwise; three or more, or two or more if it is open
  Vec2 centre = Vec2::Zero();     ///< strictly inside; of an open cell it is the point where its two side faces meet
  int region = 0;                 ///< of its first side, if its sides are of several regions
  std::vector<int> side_regions;  ///< empty: all of `region`. Otherwise the region of each side (node i to node i + 1)
  bool open = false;  ///< no side leads from the last node back to the first: between them are two side faces
};

struct PolygonMesh {
  std::vector<Vec2> nodes;
  std::vector<PolygonCell> cells;
  /// For each line of the domain the nodes along it from its start to its end, as its left side has them: one for each
  /// of its points, except for an end that is a scaling centre (and one more at the middle of a single facet between
  /// two of them, or between two crack tips). `right` differs from `left` only for cracks, whose sides share at most
  /// the node of a tip.
  std::vector<std::vector<int>> left, right;
};

}  // namespace scabo::mesh
