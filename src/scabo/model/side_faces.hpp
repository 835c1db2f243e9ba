// Side faces of open super-elements whose scaling centre is a corner of the outline.
#pragma once

#include "scabo/model/model.hpp"

namespace scabo::model {

/// Whether an edge of the outline is a side face: it ends at the scaling centre `corner` (-1: none) and is not divided.
inline bool is_side_face(const Outline& outline, int corner, int edge) {
  const int count = static_cast<int>(outline.edges.size());
  return corner >= 0 && (edge == corner || edge == (corner + count - 1) % count);
}
inline bool is_side_face(const Body& body, int edge) {
  return is_side_face(body.outline, body.mesh.centre_corner, edge);
}

/// Name of the corner at the scaling centre, the one given by the user if there is one; empty without such a corner.
inline std::string name_of_centre_corner(const Body& body) {
  if (body.mesh.centre_corner < 0) return {};
  const std::vector<std::string>& names = body.outline.corners[static_cast<std::size_t>(body.mesh.centre_corner)].names;
  return names.size() > 1 ? names[1] : names[0];
}

/// Number of the side face that an edge forms at a notch or corner: 0 at the start of the boundary of the
/// super-element, 1 at its end; -1 for other edges.
inline int side_face_of(const Body& body, int edge) {
  if (!is_side_face(body, edge)) return -1;
  return (edge == body.mesh.centre_corner) != body.outside ? 0 : 1;
}

/// From the scaling centre to the end of side face 0 or 1 of a body that is one open super-element, of finite size.
inline Vec2 side_face_arm(const Body& body, int face) {
  if (body.mesh.centre_corner < 0) return body.cracks.front().mouth - body.cracks.front().tip;
  const auto count = body.outline.edges.size(), corner = static_cast<std::size_t>(body.mesh.centre_corner);
  const Edge &leaves = body.outline.edges[corner], &arrives = body.outline.edges[(corner + count - 1) % count];
  return face == 0 ? Vec2(leaves.end - leaves.start) : Vec2(arrives.start - arrives.end);
}

/// Its outward unit normal: the material begins counter-clockwise of face 0 and ends at face 1.
inline Vec2 side_face_normal(const Body& body, int face) {
  const Vec2 along = side_face_arm(body, face).stableNormalized();
  return face == 0 ? Vec2(along.y(), -along.x()) : Vec2(-along.y(), along.x());
}

}  // namespace scabo::model
