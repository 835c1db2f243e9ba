// Points from which all sides of a polygon are visible (its kernel).
//
// A point c sees the side from a to b (counter-clockwise) if the triangle (c, a, b) is positive. Its measure is the
// triangle's height over the side's length,
//     h / L = 2 area(c, a, b) / |b - a|^2,
// and the measure of a point the least over all sides: free of units, 0.87 in an equilateral triangle's corner opposite
// to a side, at most cot(pi / n) / 2 in a regular polygon of n sides.
#pragma once

#include <span>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

double polygon_area(std::span<const Vec2> polygon);    ///< positive if counter-clockwise
Vec2 polygon_centroid(std::span<const Vec2> polygon);  ///< of a polygon with an area

/// Least h / L over the sides seen from `centre`; an `open` chain has no side from its last point to its first. A point
/// that does not see a side has a measure <= 0.
double visibility(std::span<const Vec2> chain, const Vec2& centre, bool open = false);

struct KernelCentre {
  Vec2 centre = Vec2::Zero();
  double visibility = 0.0;  ///< of the centre; <= 0: no point sees all sides
};

/// The centroid if it sees all sides well (h / L >= `enough`), otherwise the point of the kernel with the largest
/// measure.
KernelCentre kernel_centre(std::span<const Vec2> polygon, double enough = 0.2);

/// Divides a simple polygon by the diagonal that maximises the smaller `visibility` of the two parts, given as indices
/// of its corners. Empty if no diagonal leaves two parts with an inside.
std::vector<std::vector<int>> divide_by_diagonal(std::span<const Vec2> polygon);

}  // namespace scabo::mesh
