// The point of the sides of a finite element that is nearest to another point.
#include <algorithm>
#include <limits>

#include "scabo/element/plane/finite_element.hpp"

namespace scabo::element {

NearestOnSides nearest_on_sides(const FiniteElement& element, const Vec2& x) {
  NearestOnSides best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto corners = static_cast<std::size_t>(element.corners());
  const bool quadratic = element.size() > element.corners();
  for (std::size_t side = 0; side < corners; ++side) {
    const Vec2 &a = element.x[side], &b = element.x[(side + 1) % corners];
    // Position c + t d + t^2 e, -1 <= t <= 1.
    const Vec2 middle = 0.5 * (a + b), c = quadratic ? element.x[side + corners] : middle, d = 0.5 * (b - a),
               e = middle - c;
    const auto distance = [&](double t) { return (c + t * d + t * t * e - x).norm(); };
    constexpr int starts = 8;
    double t = -1.0;
    for (int k = 1; k <= starts; ++k)
      if (const double other = -1.0 + 2.0 * k / starts; distance(other) < distance(t)) t = other;
    for (int iteration = 0; iteration < 30; ++iteration) {  // of the squared distance
      const Vec2 miss = c + t * d + t * t * e - x, along = d + 2.0 * t * e;
      const double curvature = along.squaredNorm() + 2.0 * miss.dot(e);
      if (!(curvature > 0.0)) break;
      const double next = std::clamp(t - miss.dot(along) / curvature, -1.0, 1.0);
      if (!(distance(next) < distance(t))) break;
      t = next;
    }
    if (distance(t) >= best.distance) continue;
    const std::span<const Vec2> natural = natural_nodes(element.kind);
    best = {0.5 * (1.0 - t) * natural[side] + 0.5 * (1.0 + t) * natural[(side + 1) % corners], distance(t)};
  }
  return best;
}

}  // namespace scabo::element
