// Visibility of the boundary from the scaling centre, and search for a better centre.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/geometry/plane/outline_checks.hpp"

namespace scabo::geometry {

namespace {

constexpr double margin = 1e-6;  // relative to the size of the body; closer to a tangent counts as not visible

/// Whether an angle lies within those of an arc.
bool covers(const Arc& arc, double angle) {
  const double full = 2.0 * std::numbers::pi;
  double turn = angle - arc.start_angle;
  turn = arc.sweep > 0.0 ? turn - full * std::floor(turn / full) : turn - full * std::ceil(turn / full);
  return std::abs(turn) <= std::abs(arc.sweep);
}

/// Smallest distance at which a tangent of the edge passes the centre on its left.
double least_tangent_distance(const Edge& edge, const Vec2& centre) {
  if (!edge.arc) {
    return cross(edge.start - centre, edge.end - centre) / (edge.end - edge.start).norm();
  }
  const Arc& arc = *edge.arc;
  const double sense = arc.sweep > 0.0 ? 1.0 : -1.0;
  const Vec2 offset = arc.centre - centre;
  const auto distance = [&](double angle) {
    return sense * (arc.radius + offset.dot(Vec2(std::cos(angle), std::sin(angle))));
  };
  double least = std::min(distance(arc.start_angle), distance(arc.start_angle + arc.sweep));
  if (offset.norm() > 0.0) {
    const double extreme = std::atan2(-sense * offset.y(), -sense * offset.x());
    if (covers(arc, extreme)) least = std::min(least, distance(extreme));
  }
  return least;
}

/// The part of a convex polygon on the left of the line through `point` along the unit vector `along`, at a
/// distance of at least `least`.
std::vector<Vec2> clip(const std::vector<Vec2>& polygon, const Vec2& point, const Vec2& along, double least) {
  const auto left = [&](const Vec2& p) { return cross(along, p - point) - least; };
  std::vector<Vec2> kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double la = left(a);
    const double lb = left(b);
    if (la >= 0.0) kept.push_back(a);
    if ((la > 0.0 && lb < 0.0) || (la < 0.0 && lb > 0.0)) kept.push_back(a + la / (la - lb) * (b - a));
  }
  return kept;
}

/// The kernel: all points to the left of every tangent.
std::vector<Vec2> kernel(const Outline& outline, double size) {
  constexpr int tangents = 32;
  const Vec2 origin = outline.edges.front().start;
  const double reach = 2.0 * size;
  std::vector<Vec2> region{origin + Vec2(-reach, -reach), origin + Vec2(reach, -reach), origin + Vec2(reach, reach),
                           origin + Vec2(-reach, reach)};
  for (const Edge& edge : outline.edges) {
    for (int k = 0; k <= (edge.arc ? tangents : 0) && !region.empty(); ++k) {
      Vec2 along = (edge.end - edge.start).normalized();
      if (edge.arc) {
        const double angle = edge.arc->start_angle + edge.arc->sweep * k / tangents;
        along = (edge.arc->sweep > 0.0 ? 1.0 : -1.0) * Vec2(-std::sin(angle), std::cos(angle));
      }
      region = clip(region, edge.at(double(k) / tangents), along, 2.0 * margin * size);
    }
  }
  return region;
}

/// Smallest distance at which any tangent passes the point on its left.
double clearance(const Outline& outline, const Vec2& point) {
  double least = least_tangent_distance(outline.edges.front(), point);
  for (const Edge& edge : outline.edges) least = std::min(least, least_tangent_distance(edge, point));
  return least;
}

Vec2 rounded(const Vec2& point, double unit) {
  return {unit * std::round(point.x() / unit), unit * std::round(point.y() / unit)};
}

}  // namespace

std::vector<int> unseen_edges(const Outline& outline, const Vec2& centre) {
  const double least = margin * outline_size(outline);
  std::vector<int> unseen;
  for (std::size_t i = 0; i < outline.edges.size(); ++i) {
    if (!(least_tangent_distance(outline.edges[i], centre) > least)) unseen.push_back(static_cast<int>(i));
  }
  return unseen;
}

std::optional<Vec2> seeing_point(const Outline& outline) {
  const double size = outline_size(outline);
  const std::vector<Vec2> region = kernel(outline, size);
  if (region.size() < 3) return {};
  Vec2 moment = Vec2::Zero();
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < region.size(); ++i) {
    const double part = cross(region[i] - region[0], region[i + 1] - region[0]);
    area += part;
    moment += part * (region[i] + region[i + 1] - 2.0 * region[0]) / 3.0;
  }
  if (!(area > 0.0)) return {};
  const Vec2 middle = region[0] + moment / area;
  const double best = clearance(outline, middle);
  if (!(best > margin * size)) return {};
  // As few digits as still give good visibility, because the user will type them.
  const double decade = std::pow(10.0, std::floor(std::log10(size)));
  for (int digits = 1; digits <= 6; ++digits) {
    const Vec2 candidate = rounded(middle, decade * std::pow(10.0, -digits));
    if (clearance(outline, candidate) > std::max(0.5 * best, margin * size)) return candidate;
  }
  return middle;
}

}  // namespace scabo::geometry
