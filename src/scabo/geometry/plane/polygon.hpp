// Outlines as polygons, for pictures and where an arc need not be exact.
#pragma once

#include <vector>

#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// Points along the edges of an outline, in their order, arcs in pieces of at most 3 degrees, eight at least; without
/// the inner points of chains.
std::vector<Vec2> polygon_of(const Outline& outline);

}  // namespace scabo::geometry
