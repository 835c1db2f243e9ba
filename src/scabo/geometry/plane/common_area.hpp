// Whether two bodies occupy the same place.
#pragma once

#include <optional>

#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// A point of the area that two outlines have in common: on the boundary of one of them, and inside the other or on a
/// part of its boundary with the material on the same side. Nothing where they are apart or only touch. Both run
/// counter-clockwise, around holes clockwise. Distances up to `tolerance` are rounding.
std::optional<Vec2> common_area(const Outline& a, const Outline& b, double tolerance);

}  // namespace scabo::geometry
