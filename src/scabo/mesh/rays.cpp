#include "scabo/mesh/rays.hpp"

#include <array>
#include <cmath>
#include <vector>

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

/// The points where a ray meets the line or circle that contains an edge, or a chain with its continuations.
std::vector<Vec2> meetings(const geometry::Edge& edge, const Ray& ray) {
  if (!edge.arc) {
    std::vector<Vec2> points;
    const int last = edge.segments() - 1;
    const double slack = 1e-9;
    for (int i = 0; i <= last; ++i) {
      const Vec2& from = edge.chain_point(i);
      const Vec2 along = edge.chain_point(i + 1) - from;
      const double steepness = cross(along, ray.direction);
      if (std::abs(steepness) < 1e-9 * along.norm()) continue;
      const double t = cross(ray.point - from, ray.direction) / steepness;
      if ((i > 0 && t < -slack) || (i < last && t > 1.0 + slack)) continue;  // on another segment of the chain
      points.push_back(from + t * along);
    }
    return points;
  }
  const Vec2 from_centre = ray.point - edge.arc->centre;
  const double half = from_centre.dot(ray.direction);
  const double past = cross(ray.direction, from_centre);  // distance of the centre from the ray
  const double square = edge.arc->radius * edge.arc->radius - past * past;
  if (square < 0.0) return {};
  const double root = std::sqrt(square);
  return {ray.point + (root - half) * ray.direction, ray.point - (root + half) * ray.direction};
}

double radius_around(const Vec2& centre, const geometry::Edge& chain) {
  double sum = 0.0;
  for (int i = 0; i < chain.segments(); ++i) sum += (chain.chain_point(i) - centre).norm();
  return sum / chain.segments();
}

/// A chain as the line or arc whose rays suit it; other edges as they are. Of an arc only the centre, the radius and the
/// sense are meant.
geometry::Edge smoothed(const geometry::Edge& edge) {
  if (!edge.is_chain()) return edge;
  geometry::Edge smooth;
  smooth.start = edge.start;
  smooth.end = edge.end;
  if (edge.start == edge.end) {
    geometry::Outline closed;
    closed.edges = {edge};
    const Vec2 centre = closed.centroid();
    smooth.arc = geometry::Arc{centre, radius_around(centre, edge), 0.0, closed.area() > 0.0 ? 1.0 : -1.0};
    return smooth;
  }
  const Vec2 chord = edge.end - edge.start, arm = edge.at(0.5) - edge.start;
  const double turn = cross(arm, chord);  // > 0 where the chain runs to the right of its chord, and so turns left
  if (std::abs(turn) < 1e-3 * chord.squaredNorm()) return smooth;
  // Circle through the ends and the middle: the centre is equally far from all three.
  const Vec2 offset = (chord * arm.squaredNorm() - arm * chord.squaredNorm()) / (2.0 * turn);
  const Vec2 centre = edge.start + Vec2(offset.y(), -offset.x());
  const double radius = (edge.start - centre).norm(), near = 0.05 * std::abs(turn) / chord.norm();
  for (const Vec2& point : edge.points)
    if (std::abs((point - centre).norm() - radius) > near) return smooth;
  smooth.arc = geometry::Arc{centre, radius, 0.0, turn > 0.0 ? 1.0 : -1.0};
  return smooth;
}

/// The fraction on a closed edge, where 0 and 1 are the same point, that is nearest to another one.
double fraction_near(const geometry::Edge& edge, double t, double expected) {
  const bool closed = (edge.end - edge.start).norm() < 1e-9 * edge.length();
  return closed ? t + std::round(expected - t) : t;
}

}  // namespace

Rays::Rays(const geometry::Edge& of_a, const geometry::Edge& of_b) {
  const geometry::Edge a = smoothed(of_a), b = smoothed(of_b);
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
  std::optional<double> nearest;
  for (const Vec2& point : meetings(edge, ray)) {
    const std::optional<geometry::Foot> foot = geometry::foot_on(edge, point);
    if (!foot) continue;
    const double t = fraction_near(edge, foot->t, expected);
    if (!nearest || std::abs(t - expected) < std::abs(*nearest - expected)) nearest = t;
  }
  return nearest;
}

std::optional<double> facing_point(const geometry::Edge& edge, const Ray& ray, const Vec2& normal, double cosine,
                                   double tolerance) {
  std::optional<double> nearest;
  double shortest = 0.0;
  for (const Vec2& point : meetings(edge, ray)) {
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
