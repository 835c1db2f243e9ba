// Constrained Delaunay triangulation of points in the plane, with exact predicates.
//
// The triangulation covers the convex hull of the points. Its edges include all segments; the circle around a triangle
// contains no other point that the triangle sees past the segments. The library behind it is CGAL (Debian: libcgal-dev,
// headers only), included by triangulation.cpp alone. The same input gives the same triangulation, and so does the
// input scaled by a power of two.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

struct Triangle {
  std::array<int, 3> vertices{};              ///< counter-clockwise, as indices of points
  std::array<int, 3> neighbours{-1, -1, -1};  ///< triangle across the side opposite to each vertex; -1: none
  std::array<bool, 3> constrained{};          ///< whether that side is one of the segments
};

/// An order of the points in which neighbours follow each other (a Hilbert curve).
std::vector<std::size_t> spatial_order(const std::vector<Vec2>& points);

/// The triangulation of distinct `points` with `segments`, pairs of indices of points, which meet only at their ends.
/// Throws InputError, without a place in a file, if points coincide or segments cross; a segment that contains another
/// point becomes two. `order`: in which points are inserted; that of spatial_order, of these points or of such that
/// lie near to them, is fast.
std::vector<Triangle> triangulate(const std::vector<Vec2>& points, const std::vector<std::pair<int, int>>& segments,
                                  const std::vector<std::size_t>& order);

}  // namespace scabo::mesh
