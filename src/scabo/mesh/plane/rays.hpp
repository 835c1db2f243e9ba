// Lines of sight between two edges in contact: a point of one edge faces the point of the other edge on the same ray.
//
// Curved edges that are not concentric have no common perpendicular, and the foot of a point on the other edge depends
// on the side from which one looks. One family of rays serves both sides: all of them parallel, or all through one
// centre,
//
//     two straight edges         parallel to the common normal, n_A - n_B
//     two arcs                   through the centre of similitude, S = (r_B C_A - r_A C_B) / (r_B - r_A), with the
//     radius
//                                r > 0 where the body is convex and r < 0 where it is concave; parallel to C_B - C_A if
//                                r_A = r_B
//     a straight edge, an arc    through the point of the circle that is farthest from the straight edge, the limit of
//     S
//     a chain                    as the circle through its ends and its middle, or around the centroid of a closed one,
//                                if that is near all of it; else, beside a straight edge, parallel to its normal;
//                                beside a curved edge that it follows, as the line from end to end, or the circle
//                                around the centroid; else as the circle of its curvature where it is nearest
//
// Every ray has a direction between the normals of the two edges where it meets them, so that nodes on one ray match in
// the sense of interface.hpp. Parallel straight edges and concentric arcs are seen along their normals.
#pragma once

#include <optional>

#include "scabo/geometry/plane/outline.hpp"

namespace scabo::mesh {

struct Ray {
  Vec2 point, direction;  ///< unit; both senses are meant
};

class Rays {
 public:
  Rays(const geometry::Edge& a, const geometry::Edge& b);

  Ray through(const Vec2& point) const;
  /// The point through which all rays pass; nothing if they are parallel.
  std::optional<Vec2> centre() const { return parallel_ ? std::nullopt : std::optional(centre_); }
  /// The ray at the fraction s of the distance (parallel) or angle (through a centre) between the rays through two
  /// points.
  Ray between(const Vec2& from, const Vec2& to, double s) const;

 private:
  bool parallel_ = true;
  Vec2 direction_ = Vec2::Zero();  // parallel: unit
  Vec2 centre_ = Vec2::Zero();     // otherwise
};

/// Where the ray meets the edge, as a fraction of its length, nearest to the fraction `expected`; a little below 0 or
/// above 1 for a point just beyond an end. Empty if it passes by.
std::optional<double> meet(const geometry::Edge& edge, const Ray& ray, double expected);

/// Where the ray through a point with outward normal `normal` meets an edge that faces it, nearest to the point: the
/// cosine of the angle between the normals is at most `cosine`. A fraction of the length of the edge, from -tolerance
/// to 1 + tolerance; empty if there is none.
std::optional<double> facing_point(const geometry::Edge& edge, const Ray& ray, const Vec2& normal, double cosine,
                                   double tolerance = 0.0);

}  // namespace scabo::mesh
