#include "scabo/mesh/rays.hpp"

#include <array>
#include <cmath>

#include "scabo/geometry/foot_points.hpp"

namespace scabo::mesh {

namespace {

/// Radii that differ by less, relative to their sum, count as equal.
constexpr double equal_radii = 1e-9;

Vec2 normal_at(const geometry::Edge& edge, const Vec2& point) {
  const std::optional<geometry::Foot> foot = geometry::foot_on(edge, point);
  return foot ? foot->normal : Vec2(0.0, 0.0);
}

double signed_radius(const geometry::Arc& arc) { return std::copysign(arc.radius, arc.sweep); }

/// Point of the circle that is farthest from the straight edge.
Vec2 far_point(const geometry::Arc& arc, const geometry::Edge& straight) {
  return arc.centre + signed_radius(arc) * normal_at(straight, arc.centre);
}

/// The points where a ray meets the line or circle that contains an edge.
struct Meetings {
  std::array<Vec2, 2> points;
  int count = 0;
};
Meetings meetings(const geometry::Edge& edge, const Ray& ray) {
  if (!edge.arc) {
    const Vec2 along = edge.end - edge.start;
    const double steepness = cross(along, ray.direction);
    if (std::abs(steepness) < 1e-9 * along.norm()) return {};
    const double t = cross(ray.point - edge.start, ray.direction) / steepness;
    return {{Vec2(edge.start + t * along), Vec2::Zero()}, 1};
  }
  const Vec2 from_centre = ray.point - edge.arc->centre;
  const double half = from_centre.dot(ray.direction);
  const double past = cross(ray.direction, from_centre);  // distance of the centre from the ray
  const double square = edge.arc->radius * edge.arc->radius - past * past;
  if (square < 0.0) return {};
  const double root = std::sqrt(square);
  return {{Vec2(ray.point + (root - half) * ray.direction), Vec2(ray.point - (root + half) * ray.direction)}, 2};
}

/// The fraction on a closed edge, where 0 and 1 are the same point, that is nearest to another one.
double fraction_near(const geometry::Edge& edge, double t, double expected) {
  const bool closed = (edge.end - edge.start).norm() < 1e-9 * edge.length();
  return closed ? t + std::round(expected - t) : t;
}

}  // namespace

Rays::Rays(const geometry::Edge& a, const geometry::Edge& b) {
  if (!a.arc && !b.arc) {
    direction_ = normal_at(a, a.start) - normal_at(b, b.start);
    if (direction_.norm() < 1e-6) direction_ = normal_at(a, a.start);  // they do not face each other
    direction_.normalize();
    return;
  }
  if (a.arc && b.arc) {
    const double r_a = signed_radius(*a.arc), r_b = signed_radius(*b.arc);
    if (std::abs(r_b - r_a) < equal_radii * (std::abs(r_a) + std::abs(r_b))) {
      direction_ = b.arc->centre - a.arc->centre;
      direction_ = direction_.norm() > 0.0 ? direction_.normalized() : normal_at(a, a.at(0.5));
      return;
    }
    centre_ = (r_b * a.arc->centre - r_a * b.arc->centre) / (r_b - r_a);
  } else {
    centre_ = a.arc ? far_point(*a.arc, b) : far_point(*b.arc, a);
  }
  parallel_ = false;
}

Ray Rays::through(const Vec2& point) const {
  if (parallel_) return {point, direction_};
  const Vec2 arm = point - centre_;
  return {point, arm.norm() > 0.0 ? arm.normalized() : Vec2(1.0, 0.0)};
}

Ray Rays::between(const Vec2& from, const Vec2& to, double s) const {
  if (parallel_) return {from + s * (to - from), direction_};
  const Vec2 first = from - centre_, last = to - centre_;
  const double angle = s * std::atan2(cross(first, last), first.dot(last));
  const Vec2 turned(std::cos(angle) * first.x() - std::sin(angle) * first.y(),
                    std::sin(angle) * first.x() + std::cos(angle) * first.y());
  return through(centre_ + turned);
}

std::optional<double> meet(const geometry::Edge& edge, const Ray& ray, double expected) {
  const Meetings found = meetings(edge, ray);
  std::optional<double> nearest;
  for (int k = 0; k < found.count; ++k) {
    const std::optional<geometry::Foot> foot = geometry::foot_on(edge, found.points[static_cast<std::size_t>(k)]);
    if (!foot) continue;
    const double t = fraction_near(edge, foot->t, expected);
    if (!nearest || std::abs(t - expected) < std::abs(*nearest - expected)) nearest = t;
  }
  return nearest;
}

std::optional<double> facing_point(const geometry::Edge& edge, const Ray& ray, const Vec2& normal, double cosine,
                                   double tolerance) {
  const Meetings found = meetings(edge, ray);
  std::optional<double> nearest;
  double shortest = 0.0;
  for (int k = 0; k < found.count; ++k) {
    const Vec2& point = found.points[static_cast<std::size_t>(k)];
    const std::optional<geometry::Foot> foot = geometry::foot_on(edge, point);
    if (!foot || foot->t < -tolerance || foot->t > 1.0 + tolerance) continue;
    if (foot->normal.dot(normal) > cosine) continue;
    const double distance = (point - ray.point).norm();
    if (nearest && distance >= shortest) continue;
    nearest = foot->t;
    shortest = distance;
  }
  return nearest;
}

}  // namespace scabo::mesh
