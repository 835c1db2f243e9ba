#include "scabo/mesh/plane/polygon_kernel.hpp"

#include <algorithm>
#include <limits>

namespace scabo::mesh {

double polygon_area(std::span<const Vec2> polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)  // relative to a corner: no digits are lost far from the origin
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return 0.5 * twice;
}

Vec2 polygon_centroid(std::span<const Vec2> polygon) {
  double twice = 0.0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
    const double part = cross(a, b);
    twice += part;
    moment += part * (a + b);
  }
  return polygon[0] + moment / (3.0 * twice);
}

double visibility(std::span<const Vec2> chain, const Vec2& centre, bool open) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + (open ? 1 : 0) < chain.size(); ++i) {
    const Vec2 &a = chain[i], &b = chain[(i + 1) % chain.size()];
    const double squared = (b - a).squaredNorm();
    least = std::min(least, squared > 0.0 ? cross(a - centre, b - centre) / squared : -1.0);
  }
  return least;
}

namespace {

// The part of `polygon` whose points see the sides of `of` with a measure of at least `measure`; into `part`.
void clip_to_kernel(std::span<const Vec2> of, double measure, std::vector<Vec2>& part, std::vector<Vec2>& work) {
  for (std::size_t i = 0; i < of.size() && !part.empty(); ++i) {
    const Vec2 &a = of[i], &b = of[(i + 1) % of.size()];
    const Vec2 side = b - a;
    const double least = measure * side.squaredNorm();
    work.clear();
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vec2 &p = part[k], &q = part[(k + 1) % part.size()];
      const double at_p = cross(side, p - a) - least, at_q = cross(side, q - a) - least;
      if (at_p >= 0.0) work.push_back(p);
      if ((at_p >= 0.0) != (at_q >= 0.0)) work.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    part.swap(work);
  }
}

}  // namespace

KernelCentre kernel_centre(std::span<const Vec2> polygon, double enough) {
  KernelCentre best{polygon[0], -1.0};
  if (polygon.size() < 3) return best;
  if (polygon_area(polygon) > 0.0) {
    best.centre = polygon_centroid(polygon);
    best.visibility = visibility(polygon, best.centre);
    if (best.visibility >= enough) return best;
  }
  // The largest measure by bisection; the points with at least that measure form a convex polygon, whose corners' mean
  // is one of them.
  Vec2 low = polygon[0], high = polygon[0];
  for (const Vec2& p : polygon) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<Vec2> part, work;
  double reached = 0.0, failed = 1.0;
  for (int step = 0; step < 24; ++step) {
    const double measure = step == 0 ? 0.0 : 0.5 * (reached + failed);
    part = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    clip_to_kernel(polygon, measure, part, work);
    if (part.empty()) {
      if (step == 0) break;
      failed = measure;
      continue;
    }
    reached = measure;
    Vec2 mean = Vec2::Zero();
    for (const Vec2& p : part) mean += p;
    mean /= static_cast<double>(part.size());
    if (const double seen = visibility(polygon, mean); seen > best.visibility) best = {mean, seen};
  }
  return best;
}

std::vector<std::vector<int>> divide_by_diagonal(std::span<const Vec2> polygon) {
  const auto n = static_cast<int>(polygon.size());
  std::vector<std::vector<int>> best;
  double best_visibility = 0.0;
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i)
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      std::vector<std::vector<int>> parts(2);
      for (int k = i; k <= j; ++k) parts[0].push_back(k);
      for (int k = j; k <= i + n; ++k) parts[1].push_back(k % n);
      double least = std::numeric_limits<double>::infinity();
      for (const std::vector<int>& part : parts) {
        points.clear();
        for (const int k : part) points.push_back(polygon[static_cast<std::size_t>(k)]);
        least = std::min(least, kernel_centre(points).visibility);
        if (least <= best_visibility) break;
      }
      if (least > best_visibility) {
        best_visibility = least;
        best = parts;
      }
    }
  return best;
}

}  // namespace scabo::mesh
