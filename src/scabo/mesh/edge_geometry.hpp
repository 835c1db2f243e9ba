// Exact geometry of an outline: the foot of a point on a line or arc, outward normals, inside or outside.
#pragma once

#include <optional>

#include "scabo/base/types.hpp"
#include "scabo/model/model.hpp"

namespace scabo::mesh {

/// The foot of the perpendicular from a point on the line, or on the circle, that carries an edge.
struct Foot {
  double t = 0.0;  ///< along the edge, 0 at its start and 1 at its end; outside [0, 1] it lies beyond an end
  Vec2 point = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  ///< unit, out of the body, at `point`
};

/// Nothing only for the centre of an arc, whose feet are all alike.
std::optional<Foot> foot_on(const model::Edge& edge, const Vec2& point);

/// Whether the outline encloses the point; arcs are taken exactly.
bool encloses(const model::Outline& outline, const Vec2& point);

}  // namespace scabo::mesh
