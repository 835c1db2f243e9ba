// Exact geometry of an outline: foot of the perpendicular from a point to a line or arc, outward normals, and whether a
// point is enclosed.
#pragma once

#include <optional>

#include "scabo/base/types.hpp"
#include "scabo/geometry/outline.hpp"

namespace scabo::geometry {

/// The foot of the perpendicular from a point to the line or circle that contains an edge.
struct Foot {
  double t = 0.0;  ///< position along the edge: 0 at its start, 1 at its end, outside [0, 1] beyond an end
  Vec2 point = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  ///< unit, out of the body, at `point`
};

/// Empty only for the centre of an arc, where the foot is not unique.
std::optional<Foot> foot_on(const Edge& edge, const Vec2& point);

/// Distance of a point from a line or arc between its ends.
double distance_to(const Edge& edge, const Vec2& point);

/// Whether the outline encloses the point, with arcs treated exactly.
bool encloses(const Outline& outline, const Vec2& point);

}  // namespace scabo::geometry
