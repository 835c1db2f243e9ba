// Conditions on a boundary before it can be meshed: it is simple, and all of it is visible from the scaling centre.
#pragma once

#include <optional>
#include <vector>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::geometry {

/// Two edges that intersect although they must not.
struct Crossing {
  enum class Kind {
    cross,      ///< they cross or touch at `point`
    fold_back,  ///< neighbouring edges that overlap, beginning at `point`
  };
  Kind kind = Kind::cross;
  int first = -1;  ///< index of an edge, less than `second`
  int second = -1;
  Vec2 point = Vec2::Zero();
};

/// The first crossing of the closed outline with itself, if there is one; chains, which come from meshes, are passed
/// over. A sweep along x or y compares the bounding box of an edge only with those that it overlaps in that direction.
std::optional<Crossing> find_crossing(const Outline& outline);

/// The points that two edges share, up to `tolerance` apart from either, each once. Of edges that lie on each other:
/// the ends of what they share.
std::vector<Vec2> shared_points(const Edge& a, const Edge& b, double tolerance);

/// Edges, none of them a chain, that are not entirely visible from `centre`. An edge is visible when the tangent at
/// each of its points passes the centre on its left at a distance of more than 1e-6 of the size of the body. For a
/// straight edge this is the distance of its line. For an arc with centre m and radius r it is the minimum over its
/// angles of r + (m - c).(cos, sin) if it runs counter-clockwise, and of -r - (m - c).(cos, sin) if it runs clockwise.
std::vector<int> unseen_edges(const Outline& outline, const Vec2& centre);

/// A point from which every edge is visible, if there is one. Arcs are represented by 32 tangents each; the point found
/// is then checked exactly.
std::optional<Vec2> seeing_point(const Outline& outline);

}  // namespace scabo::geometry
