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

}  // namespace scabo::model
