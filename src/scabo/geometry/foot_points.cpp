#include "scabo/geometry/foot_points.hpp"

#include <algorithm>
#include <cmath>
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

/// Whether a ray from the point towards +x crosses the segment from a to b.
bool crosses(const Vec2& a, const Vec2& b, const Vec2& point) {
  if ((a.y() > point.y()) == (b.y() > point.y())) return false;
  return point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

}  // namespace

std::optional<Foot> foot_on(const Edge& edge, const Vec2& point) {
  if (edge.arc) return foot_on_arc(*edge.arc, point);
  const Vec2 along = edge.end - edge.start;
  const double t = (point - edge.start).dot(along) / along.squaredNorm();
  return Foot{t, edge.start + t * along, tangent_of(along).normalized()};
}

bool encloses(const Outline& outline, const Vec2& point) {
  // Inside the polygon of the chords, except for the segments between chord and arc, which change sides.
  bool inside = false;
  for (const Edge& edge : outline.edges) {
    if (!edge.arc) {
      inside ^= crosses(edge.start, edge.end, point);
      continue;
    }
    const Arc& arc = *edge.arc;
    const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / (0.5 * std::numbers::pi))));
    const bool in_circle = (point - arc.centre).norm() < arc.radius;
    const double side = std::copysign(1.0, arc.sweep);
    for (int k = 0; k < chords; ++k) {
      const Vec2 a = k == 0 ? edge.start : edge.at(static_cast<double>(k) / chords);
      const Vec2 b = k + 1 == chords ? edge.end : edge.at(static_cast<double>(k + 1) / chords);
      inside ^= crosses(a, b, point);
      inside ^= in_circle && side * cross(b - a, point - a) < 0.0;
    }
  }
  return inside;
}

double distance_to(const Edge& edge, const Vec2& point) {
  const double ends = std::min((point - edge.start).norm(), (point - edge.end).norm());
  const std::optional<Foot> foot = foot_on(edge, point);
  if (!foot) return edge.arc->radius;
  return foot->t >= 0.0 && foot->t <= 1.0 ? std::min(ends, (point - foot->point).norm()) : ends;
}

}  // namespace scabo::geometry
