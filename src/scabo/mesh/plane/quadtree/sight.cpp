// Visibility of the sides of a polygon, and its division into parts that are visible.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/mesh/plane/quadtree/pieces.hpp"

namespace scabo::mesh::quadtree {

double polygon_area(const std::vector<Vec2>& corners) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return 0.5 * twice;
}

double clearance_from(const Vec2& centre, const std::vector<Vec2>& corners, bool closed) {
  double least = std::numeric_limits<double>::infinity();
  int turns = 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[i + 1 < corners.size() ? i + 1 : 0];
    const double length = (b - a).norm();
    if (!(length > 0.0)) return -1.0;
    least = std::min(least, cross(a - centre, b - centre) / length);
    if (a.y() <= centre.y() && b.y() > centre.y()) ++turns;
  }
  // All sides seen, but more than once around: with sides counter-clockwise each turn goes up once.
  if (closed && least > 0.0 && turns != 1) return -1.0;
  return least;
}

namespace {

/// The part of a convex polygon at least `least` to the left of the line from a to b.
void cut_off(std::vector<Vec2>& convex, std::vector<Vec2>& kept, const Vec2& a, const Vec2& b, double least) {
  const Vec2 along = (b - a).normalized();
  kept.clear();
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2& p = convex[i];
    const Vec2& q = convex[i + 1 < convex.size() ? i + 1 : 0];
    const double from = cross(along, p - a) - least, to = cross(along, q - a) - least;
    if (from >= 0.0) kept.push_back(p);
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0)) kept.push_back(p + from / (from - to) * (q - p));
  }
  convex.swap(kept);
}

}  // namespace

Sight best_sight(const std::vector<Vec2>& corners) {
  const double area = polygon_area(corners);
  if (!(area > 0.0)) return {corners.front(), -1.0};
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    moment +=
        cross(corners[i] - corners[0], corners[i + 1] - corners[0]) * (corners[i] + corners[i + 1] - 2.0 * corners[0]);
  }
  Sight best{corners[0] + moment / (6.0 * area), 0.0};
  best.clearance = clearance_from(best.centre, corners, true);
  const double scale = std::sqrt(area);
  if (best.clearance > 0.2 * scale) return best;
  Vec2 lower = corners[0], upper = corners[0];
  for (const Vec2& corner : corners) {
    lower = lower.cwiseMin(corner);
    upper = upper.cwiseMax(corner);
  }
  double possible = std::max(best.clearance, 0.0), impossible = 0.6 * scale;  // a disc of that radius is larger
  std::vector<Vec2> region, spare;
  for (int step = 0; step < 24; ++step) {
    const double tried = step == 0 ? possible : 0.5 * (possible + impossible);
    region = {lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}};
    for (std::size_t i = 0; i < corners.size() && !region.empty(); ++i) {
      cut_off(region, spare, corners[i], corners[i + 1 < corners.size() ? i + 1 : 0], tried);
    }
    if (region.empty()) {
      if (step == 0) break;
      impossible = tried;
      continue;
    }
    possible = tried;
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : region) middle += p / double(region.size());
    const double clearance = clearance_from(middle, corners, true);
    if (clearance > 1.2 * best.clearance && clearance > 0.0) best = {middle, clearance};
    if (impossible - possible < 1e-3 * impossible) break;
  }
  return best;
}

namespace {

std::vector<Vec2> places_of(const std::vector<int>& polygon, const std::vector<Vec2>& nodes) {
  std::vector<Vec2> places;
  places.reserve(polygon.size());
  for (int node : polygon) places.push_back(nodes[node]);
  return places;
}

/// Whether the diagonal from corner i starts into the inside of the polygon.
bool enters(const std::vector<Vec2>& p, int i, const Vec2& towards) {
  const int n = int(p.size());
  const Vec2 next = p[(i + 1) % n] - p[i], back = p[(i + n - 1) % n] - p[i], along = towards - p[i];
  if (cross(next, back) > 0.0) return cross(next, along) > 0.0 && cross(along, back) > 0.0;
  return !(cross(back, along) >= 0.0 && cross(along, next) >= 0.0);
}

bool crosses_side(const std::vector<Vec2>& p, int i, int j) {
  const Vec2 a = p[i], b = p[j];
  const int n = int(p.size());
  for (int k = 0; k < n; ++k) {
    const Vec2 &c = p[k], &d = p[(k + 1) % n];
    if (c == a || d == a || c == b || d == b) continue;
    if (cross(b - a, c - a) * cross(b - a, d - a) <= 0.0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0.0)
      return true;
  }
  return false;
}

}  // namespace

Halves best_division(const std::vector<int>& polygon, const std::vector<Vec2>& nodes, int from) {
  const int n = int(polygon.size());
  const std::vector<Vec2> places = places_of(polygon, nodes);
  Halves best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (int i = from < 0 ? 0 : from; i < (from < 0 ? n : from + 1); ++i) {
    for (int k = from < 0 ? i + 2 : 0; k < n; ++k) {
      const int apart = (k - i + n) % n;
      if (apart < 2 || apart > n - 2 || polygon[k] == polygon[i]) continue;
      if (!enters(places, i, places[k]) || !enters(places, k, places[i]) || crosses_side(places, i, k)) continue;
      Halves tried;
      for (int at = i;; at = (at + 1) % n) {
        tried.first.push_back(polygon[at]);
        if (at == k) break;
      }
      for (int at = k;; at = (at + 1) % n) {
        tried.second.push_back(polygon[at]);
        if (at == i) break;
      }
      const Sight first = best_sight(places_of(tried.first, nodes)),
                  second = best_sight(places_of(tried.second, nodes));
      tried.clearance = std::min(first.clearance, second.clearance);
      const double score = tried.clearance + 1e-3 * std::max(first.clearance, second.clearance);
      if (score > best_score) {
        best_score = score;
        best = std::move(tried);
      }
    }
  }
  return best;
}

}  // namespace scabo::mesh::quadtree
