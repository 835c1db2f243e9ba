// Bounding boxes of edges and outlines.
#pragma once

#include <limits>

#include "scabo/base/types.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// A rectangle along x and y; empty until something is added.
struct Box {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max());
  Vec2 high = Vec2::Constant(std::numeric_limits<double>::lowest());
  void add(const Vec2& x) { low = low.cwiseMin(x), high = high.cwiseMax(x); }
  void add(const Box& box) { low = low.cwiseMin(box.low), high = high.cwiseMax(box.high); }
};

/// The smallest box around an edge or an outline, arcs included exactly.
Box box_of(const Edge& edge);
Box box_of(const Outline& outline);

/// Diagonal of the bounding box; 0 without edges.
double outline_size(const Outline& outline);

}  // namespace scabo::geometry
