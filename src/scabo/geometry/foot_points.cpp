#include "scabo/geometry/foot_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scabo::geometry {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// `angle` from the start of the arc in the direction of its sweep, relative to the sweep. A direction outside the arc
/// is measured beyond the closer end.
double parameter_on(const Arc& arc, double angle) {
  const double sweep = std::abs(arc.sweep);
  double turn = std::copysign(1.0, arc.sweep) * (angle - arc.start_angle);
  turn -= full_turn * std::floor(turn / full_turn);
  if (turn > sweep && full_turn - turn < turn - sweep) turn -= full_turn;
  return turn / sweep;
}

std::optional<Foot> foot_on_arc(const Arc& arc, const Vec2& point) {
  const Vec2 ray = point - arc.centre;
  const double distance = ray.norm();
  if (!(distance > 1e-12 * arc.radius)) return std::nullopt;
  const Vec2 outward = ray / distance;
  return Foot{parameter_on(arc, std::atan2(ray.y(), ray.x())), arc.centre + arc.radius * outward,
              arc.sweep > 0.0 ? outward : Vec2(-outward)};
}

/// +1 where the segment from a to b crosses the ray from the point towards +x upwards, -1 downwards, 0 nowhere.
int crossing_of_ray(const Vec2& a, const Vec2& b, const Vec2& point) {
  if ((a.y() > point.y()) == (b.y() > point.y())) return 0;
  if (!(point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))) return 0;
  return b.y() > a.y() ? 1 : -1;
}

}  // namespace

std::optional<Foot> foot_on(const Edge& edge, const Vec2& point) {
  if (edge.arc) return foot_on_arc(*edge.arc, point);
  const Vec2 along = edge.end - edge.start;
  const double t = (point - edge.start).dot(along) / along.squaredNorm();
  return Foot{t, edge.start + t * along, tangent_of(along).normalized()};
}

double closest_position(const Edge& edge, const Vec2& point) {
  if (!edge.arc) {
    const Vec2 along = edge.end - edge.start;
    return std::clamp((point - edge.start).dot(along) / along.squaredNorm(), 0.0, 1.0);
  }
  const Arc& arc = *edge.arc;
  const Vec2 ray = point - arc.centre;
  double turn = std::atan2(ray.y(), ray.x()) - arc.start_angle;
  turn -= full_turn * (arc.sweep > 0.0 ? std::floor(turn / full_turn) : std::ceil(turn / full_turn));
  if (std::abs(turn) <= std::abs(arc.sweep)) return turn / arc.sweep;
  return (point - edge.start).norm() <= (point - edge.end).norm() ? 0.0 : 1.0;
}

Vec2 closest_point(const Edge& edge, const Vec2& point) { return edge.at(closest_position(edge, point)); }

double distance_to(const Edge& edge, const Vec2& point) { return (closest_point(edge, point) - point).norm(); }

double distance_to(const Outline& outline, const Vec2& point) {
  double least = std::numeric_limits<double>::max();
  for (const Edge& edge : outline.edges) least = std::min(least, distance_to(edge, point));
  return least;
}

int winding_number(const Outline& outline, const Vec2& point) {
  // Around the polygon of the chords, and around the segments between chord and arc.
  int winding = 0;
  for (const Edge& edge : outline.edges) {
    if (!edge.arc) {
      winding += crossing_of_ray(edge.start, edge.end, point);
      continue;
    }
    const Arc& arc = *edge.arc;
    const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / (0.5 * std::numbers::pi))));
    const bool in_circle = (point - arc.centre).norm() < arc.radius;
    const int sense = arc.sweep > 0.0 ? 1 : -1;
    for (int k = 0; k < chords; ++k) {
      const Vec2 a = k == 0 ? edge.start : edge.at(static_cast<double>(k) / chords);
      const Vec2 b = k + 1 == chords ? edge.end : edge.at(static_cast<double>(k + 1) / chords);
      winding += crossing_of_ray(a, b, point);
      if (in_circle && sense * cross(b - a, point - a) < 0.0) winding += sense;
    }
  }
  return winding;
}

bool encloses(const Outline& outline, const Vec2& point) { return winding_number(outline, point) != 0; }

}  // namespace scabo::geometry
