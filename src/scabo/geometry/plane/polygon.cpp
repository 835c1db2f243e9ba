#include "scabo/geometry/plane/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scabo::geometry {

std::vector<Vec2> polygon_of(const Outline& outline) {
  constexpr double largest_turn = 3.0 / 180.0 * std::numbers::pi;
  constexpr int fewest = 8;  // of an arc: a flat segment of a circle has an area
  std::vector<Vec2> points;
  for (const Edge& edge : outline.edges) {
    const int pieces =
        edge.arc ? std::max(fewest, static_cast<int>(std::ceil(std::abs(edge.arc->sweep) / largest_turn))) : 1;
    for (int i = 0; i < pieces; ++i) points.push_back(edge.at(static_cast<double>(i) / pieces));
  }
  return points;
}

}  // namespace scabo::geometry
