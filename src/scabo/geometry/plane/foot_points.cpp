#include "scabo/geometry/plane/foot_points.hpp"

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

/// The point of a chain that is closest to another one.
struct OnChain {
  int segment = 0;
  double s = 0.0;       ///< fraction of the segment, 0 to 1
  double before = 0.0;  ///< length of the segments before it
  double total = 0.0;   ///< length of the chain
};

OnChain closest_on_chain(const Edge& edge, const Vec2& point) {
  OnChain closest;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < edge.segments(); ++i) {
    const Vec2& from = edge.chain_point(i);
    const Vec2 along = edge.chain_point(i + 1) - from;
    const double s = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (from + s * along - point).squaredNorm();
    if (distance < least) {
      least = distance;
      closest.segment = i;
      closest.s = s;
      closest.before = closest.total;
    }
    closest.total += along.norm();
  }
  return closest;
}

Vec2 segment_normal(const Edge& edge, int i) {
  return tangent_of(Vec2(edge.chain_point(i + 1) - edge.chain_point(i))).normalized();
}

/// Between the normals of two segments at the point where they meet, elsewhere that of the segment.
Vec2 chain_normal(const Edge& edge, int segment, double s) {
  constexpr double at_point = 1e-9;
  const Vec2 own = segment_normal(edge, segment);
  const int last = edge.segments() - 1;
  int other = s < at_point ? segment - 1 : s > 1.0 - at_point ? segment + 1 : segment;
  if (edge.start == edge.end) other = other < 0 ? last : other > last ? 0 : other;
  if (other < 0 || other > last) return own;
  const Vec2 sum = own + segment_normal(edge, other);
  return sum.norm() > 1e-9 ? sum.normalized() : own;
}

Foot foot_on_chain(const Edge& edge, const Vec2& point) {
  OnChain at = closest_on_chain(edge, point);
  const Vec2& from = edge.chain_point(at.segment);
  const Vec2 along = edge.chain_point(at.segment + 1) - from;
  // Beyond an end the first or last segment continues.
  const bool is_first = at.segment == 0 && at.s <= 0.0, is_last = at.segment + 1 == edge.segments() && at.s >= 1.0;
  if ((is_first || is_last) && edge.start != edge.end) at.s = (point - from).dot(along) / along.squaredNorm();
  return {(at.before + at.s * along.norm()) / at.total, from + at.s * along, chain_normal(edge, at.segment, at.s)};
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
  if (edge.is_chain()) return foot_on_chain(edge, point);
  const Vec2 along = edge.end - edge.start;
  const double t = (point - edge.start).dot(along) / along.squaredNorm();
  return Foot{t, edge.start + t * along, tangent_of(along).normalized()};
}

double closest_position(const Edge& edge, const Vec2& point) {
  if (edge.is_chain()) {
    const OnChain at = closest_on_chain(edge, point);
    const double length = (edge.chain_point(at.segment + 1) - edge.chain_point(at.segment)).norm();
    return std::min((at.before + at.s * length) / at.total, 1.0);
  }
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
      for (int i = 0; i < edge.segments(); ++i)
        winding += crossing_of_ray(edge.chain_point(i), edge.chain_point(i + 1), point);
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
