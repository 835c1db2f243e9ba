// Self-crossing of outlines.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"

namespace scabo::geometry {

namespace {

/// Up to four points that the curves of two edges may share: intersections of their full lines and circles, without
/// regard to the ends.
struct Candidates {
  std::array<Vec2, 8> points;
  int count = 0;
  void add(const Vec2& point) {
    if (point.allFinite()) points[static_cast<std::size_t>(count++)] = point;
  }
};

void add_line_line(const Edge& a, const Edge& b, Candidates& candidates) {
  const Vec2 da = a.end - a.start;
  const Vec2 db = b.end - b.start;
  const double c = cross(da, db);
  if (std::abs(c) <= 1e-14 * da.norm() * db.norm()) return;  // parallel: determined by the ends
  candidates.add(a.start + cross(b.start - a.start, db) / c * da);
}

void add_line_arc(const Edge& line, const Arc& arc, Candidates& candidates) {
  const Vec2 along = (line.end - line.start).normalized();
  const Vec2 foot = line.start + (arc.centre - line.start).dot(along) * along;
  const double h2 = arc.radius * arc.radius - (foot - arc.centre).squaredNorm();
  if (h2 < -1e-6 * arc.radius * arc.radius) return;
  const double h = std::sqrt(std::max(h2, 0.0));
  candidates.add(foot + h * along);
  candidates.add(foot - h * along);
}

void add_arc_arc(const Arc& a, const Arc& b, Candidates& candidates) {
  const Vec2 between = b.centre - a.centre;
  const double d = between.norm();
  if (d <= 1e-12 * std::max(a.radius, b.radius)) return;  // same centre: determined by the ends
  const double x = (d * d + (a.radius - b.radius) * (a.radius + b.radius)) / (2.0 * d);
  const double h2 = a.radius * a.radius - x * x;
  if (h2 < -1e-6 * a.radius * a.radius) return;
  const double h = std::sqrt(std::max(h2, 0.0));
  const Vec2 along = between / d;
  const Vec2 across(-along.y(), along.x());
  candidates.add(a.centre + x * along + h * across);
  candidates.add(a.centre + x * along - h * across);
}

Candidates candidates_of(const Edge& a, const Edge& b) {
  Candidates candidates;
  if (!a.arc && !b.arc) add_line_line(a, b, candidates);
  if (!a.arc && b.arc) add_line_arc(a, *b.arc, candidates);
  if (a.arc && !b.arc) add_line_arc(b, *a.arc, candidates);
  if (a.arc && b.arc) add_arc_arc(*a.arc, *b.arc, candidates);
  for (const Vec2& end : {a.start, a.end, b.start, b.end}) candidates.add(end);
  return candidates;
}

/// Direction of travel at the start (or end) of an edge.
Vec2 direction_at(const Edge& edge, bool at_end) {
  if (!edge.arc) return (edge.end - edge.start).normalized();
  const double angle = edge.arc->start_angle + (at_end ? edge.arc->sweep : 0.0);
  const double sense = edge.arc->sweep > 0.0 ? 1.0 : -1.0;
  return sense * Vec2(-std::sin(angle), std::cos(angle));
}

/// Curvature of an edge, positive where it turns left.
double curvature(const Edge& edge) { return edge.arc ? (edge.arc->sweep > 0.0 ? 1.0 : -1.0) / edge.arc->radius : 0.0; }

/// Whether `next`, which starts where `edge` ends, runs back over it. A cusp of two different curves does not.
bool folds_back(const Edge& edge, const Edge& next) {
  const Vec2 back = -direction_at(edge, true);
  const Vec2 forth = direction_at(next, false);
  const double shorter = std::min(edge.length(), next.length());
  return back.dot(forth) > 0.0 && std::abs(cross(back, forth)) < 1e-9 &&
         std::abs(-curvature(edge) - curvature(next)) * shorter < 1e-6;
}

std::optional<Crossing> crossing_of(const Outline& outline, int i, int j, double size) {
  const Edge& a = outline.edges[static_cast<std::size_t>(i)];
  const Edge& b = outline.edges[static_cast<std::size_t>(j)];
  // Near a shared corner the curves are necessarily close: two tangential curves meet again, within the rounding of
  // their coordinates, at a point that is not a crossing.
  const double near_corner = 1e-3 * std::min(a.length(), b.length());
  const bool b_follows = outline.next(i) == j;
  const bool a_follows = outline.next(j) == i;
  if (b_follows && folds_back(a, b)) return Crossing{Crossing::Kind::fold_back, i, j, a.end};
  if (a_follows && folds_back(b, a)) return Crossing{Crossing::Kind::fold_back, i, j, b.end};
  const Candidates candidates = candidates_of(a, b);
  for (int k = 0; k < candidates.count; ++k) {
    const Vec2& point = candidates.points[static_cast<std::size_t>(k)];
    if (b_follows && (point - a.end).norm() <= near_corner) continue;
    if (a_follows && (point - b.end).norm() <= near_corner) continue;
    const double tolerance = 1e-9 * size;
    if ((closest_point(a, point) - point).norm() <= tolerance &&
        (closest_point(b, point) - point).norm() <= tolerance) {
      return Crossing{Crossing::Kind::cross, i, j, point};
    }
  }
  return {};
}

}  // namespace

std::vector<Vec2> shared_points(const Edge& a, const Edge& b, double tolerance) {
  std::vector<Vec2> shared;
  const Candidates candidates = candidates_of(a, b);
  for (int k = 0; k < candidates.count; ++k) {
    const Vec2& point = candidates.points[static_cast<std::size_t>(k)];
    if (distance_to(a, point) > tolerance || distance_to(b, point) > tolerance) continue;
    const auto near = [&](const Vec2& other) { return (other - point).norm() <= 2.0 * tolerance; };
    if (std::none_of(shared.begin(), shared.end(), near)) shared.push_back(point);
  }
  return shared;
}

std::optional<Crossing> find_crossing(const Outline& outline) {
  const double size = outline_size(outline);
  const double margin = 1e-9 * size;
  const std::size_t n = outline.edges.size();
  std::vector<Box> boxes;
  boxes.reserve(n);
  Vec2 widths = Vec2::Zero();
  for (const Edge& edge : outline.edges) {
    boxes.push_back(box_of(edge));
    widths += boxes.back().high - boxes.back().low;
  }
  // Sweep along the axis along which the edges are short, with a list of those still open.
  const int axis = widths.x() <= widths.y() ? 0 : 1;
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto box = [&](int i) -> const Box& { return boxes[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return box(i).low[axis] < box(j).low[axis]; });
  std::vector<int> open;
  for (const int i : order) {
    if (outline.edges[static_cast<std::size_t>(i)].is_chain()) continue;
    std::erase_if(open, [&](int j) { return box(j).high[axis] < box(i).low[axis] - margin; });
    std::optional<Crossing> first;
    for (const int j : open) {
      const int other = 1 - axis;
      if (box(j).low[other] > box(i).high[other] + margin || box(j).high[other] < box(i).low[other] - margin) {
        continue;
      }
      const auto crossing = crossing_of(outline, std::min(i, j), std::max(i, j), size);
      const auto rank = [](const Crossing& c) { return std::pair(c.first, c.second); };
      if (crossing && (!first || rank(*crossing) < rank(*first))) first = crossing;
    }
    if (first) return first;
    open.push_back(i);
  }
  return {};
}

}  // namespace scabo::geometry
