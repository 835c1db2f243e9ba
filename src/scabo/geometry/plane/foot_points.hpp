// Exact geometry of an outline: foot of the perpendicular from a point to a line or arc, outward normals, and which
// point of it is closest, and whether it encloses a point.
#pragma once

#include <optional>

#include "scabo/base/types.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// The foot of the perpendicular from a point to the line or circle that contains an edge. Of a chain it is the closest
/// point, or beyond its ends a point of the line that contains its first or last segment; where two segments meet, the
/// normal is halfway between theirs.
struct Foot {
  double t = 0.0;  ///< position along the edge: 0 at its start, 1 at its end, outside [0, 1] beyond an end
  Vec2 point = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  ///< unit, out of the body, at `point`
};

/// Empty only for the centre of an arc, where the foot is not unique.
std::optional<Foot> foot_on(const Edge& edge, const Vec2& point);

/// Position along an edge, from 0 to 1, of its point closest to `point`.
double closest_position(const Edge& edge, const Vec2& point);
/// The point of the edge closest to `point`.
Vec2 closest_point(const Edge& edge, const Vec2& point);

/// Distance from `point` to an edge.
double distance_to(const Edge& edge, const Vec2& point);
/// Smallest distance from `point` to the edges; the largest double without edges.
double distance_to(const Outline& outline, const Vec2& point);

/// Number of times that the boundary runs counter-clockwise around a point, with arcs treated exactly: 1 inside an
/// outline that runs counter-clockwise, -1 inside one that runs clockwise, 0 outside. The edges may form several closed
/// loops: in a hole that runs clockwise the sum is 0. A point on the boundary belongs to one of its sides.
int winding_number(const Outline& outline, const Vec2& point);

/// Whether the outline encloses the point: the winding number is not 0.
bool encloses(const Outline& outline, const Vec2& point);

}  // namespace scabo::geometry
