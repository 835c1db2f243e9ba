// What a boundary must be before it can be meshed: simple, and seen as a whole from the scaling centre.
#pragma once

#include <optional>
#include <vector>

#include "scabo/model/model.hpp"

namespace scabo::model {

/// Two edges that meet where they should not.
struct Crossing {
  enum class Kind {
    cross,      ///< or touch, in `point`
    fold_back,  ///< neighbours that run back over each other, from `point`
  };
  Kind kind = Kind::cross;
  int first = -1;  ///< index of an edge, less than `second`
  int second = -1;
  Vec2 point = Vec2::Zero();
};

/// Diagonal of the box around the outline.
double outline_size(const Outline& outline);

/// A crossing; nothing when the closed outline does not meet itself. A sweep along x or y: the box of an edge
/// is compared only with those it overlaps there.
std::optional<Crossing> find_crossing(const Outline& outline);

/// Whether `point` is inside (arcs as chains of lines).
bool is_inside(const Outline& outline, const Vec2& point);

/// Edges of which a part is not seen from `centre`. An edge is seen when the tangent at each of its points
/// passes the centre on its left, at a distance of more than 1e-6 of the size of the body:
/// for a line the distance of its line, for an arc with centre m and radius r, run counter-clockwise,
/// min over its angles of r + (m - c).(cos, sin); run clockwise, min of -r - (m - c).(cos, sin).
std::vector<int> unseen_edges(const Outline& outline, const Vec2& centre);

/// A point that sees every edge; nothing when there is none (arcs as 32 tangents each, then checked exactly).
std::optional<Vec2> seeing_point(const Outline& outline);

}  // namespace scabo::model
