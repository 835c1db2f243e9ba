#include "scabo/geometry/box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scabo::geometry {

Box box_of(const Edge& edge) {
  Box box{edge.start.cwiseMin(edge.end), edge.start.cwiseMax(edge.end)};
  for (const Vec2& point : edge.points) box.add(point);
  if (!edge.arc) return box;
  const Arc& arc = *edge.arc;
  const double first = std::min(arc.start_angle, arc.start_angle + arc.sweep);
  const double last = std::max(arc.start_angle, arc.start_angle + arc.sweep);
  const double quarter = std::numbers::pi / 2.0;
  for (double k = std::ceil(first / quarter); k * quarter <= last; k += 1.0) {
    const int side = static_cast<int>(k - 4.0 * std::floor(k / 4.0));  // exactly along x or y
    const double out = side < 2 ? arc.radius : -arc.radius;
    const Vec2 extreme = arc.centre + (side % 2 == 0 ? Vec2(out, 0.0) : Vec2(0.0, out));
    box.low = box.low.cwiseMin(extreme);
    box.high = box.high.cwiseMax(extreme);
  }
  return box;
}

Box box_of(const Outline& outline) {
  Box box;
  for (const Edge& edge : outline.edges) box.add(box_of(edge));
  return box;
}

double outline_size(const Outline& outline) {
  if (outline.edges.empty()) return 0.0;
  const Box box = box_of(outline);
  return (box.high - box.low).norm();
}

}  // namespace scabo::geometry
