// Is the shape of a cell one that an element can have?
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scabo/base/types.hpp"
#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// More corners than this are refused: no mesh has such cells, and the check of a polygon takes time.
inline constexpr int most_corners = 1000;

/// Position among `points` (corners counter-clockwise, then middle nodes) where the Jacobian of the element is not
/// positive, or where a polygon is not simple; none if the shape is good. Zero is what is less than 1e-12 of the square
/// of the diameter.
std::optional<int> folded_at(CellKind kind, std::span<const Vec2> points);

}  // namespace scabo::files
