#include "scabo/mesh/plane/rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scabo/geometry/plane/foot_points.hpp"

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
    const bool open = edge.start != edge.end;  // a closed chain has no continuations
    for (int i = 0; i <= last; ++i) {
      const Vec2& from = edge.chain_point(i);
      const Vec2 along = edge.chain_point(i + 1) - from;
      const double steepness = cross(along, ray.direction);
      if (std::abs(steepness) < 1e-9 * along.norm()) continue;
      const double t = cross(ray.point - from, ray.direction) / steepness;
      const bool before = t<-slack, beyond = t> 1.0 + slack;
      if ((before && !(open && i == 0)) || (beyond && !(open && i == last))) continue;  // on another segment
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

/// A closed chain as a circle around its centroid. Of the arc only the centre, the radius and the sense are meant.
geometry::Edge around_centroid(const geometry::Edge& chain) {
  geometry::Outline closed;
  closed.edges = {chain};
  const Vec2 centre = closed.centroid();
  geometry::Edge circle = chain;
  circle.points.clear();
  circle.arc = geometry::Arc{centre, radius_around(centre, chain), 0.0, closed.area() > 0.0 ? 1.0 : -1.0};
  return circle;
}

/// The circle through three points, in the direction of the chain; nothing if they are on a line.
std::optional<geometry::Arc> circle_through(const Vec2& from, const Vec2& middle, const Vec2& to) {
  const Vec2 chord = to - from, arm = middle - from;
  const double turn = cross(arm, chord);  // > 0 where the chain runs to the right of its chord, and so turns left
  if (std::abs(turn) < 1e-3 * chord.squaredNorm()) return std::nullopt;
  const Vec2 offset = (chord * arm.squaredNorm() - arm * chord.squaredNorm()) / (2.0 * turn);
  const Vec2 centre = from + Vec2(offset.y(), -offset.x());
  return geometry::Arc{centre, (from - centre).norm(), 0.0, turn > 0.0 ? 1.0 : -1.0};
}

bool all_near(const geometry::Edge& chain, const geometry::Arc& arc, double near) {
  return std::all_of(chain.points.begin(), chain.points.end(),
                     [&](const Vec2& point) { return std::abs((point - arc.centre).norm() - arc.radius) <= near; });
}

geometry::Edge straightened(const geometry::Edge& edge) {
  geometry::Edge line;
  line.start = edge.start;
  line.end = edge.end;
  return line;
}

/// A chain as the line or arc that is near all of it; other edges as they are. Nothing if a chain is neither.
std::optional<geometry::Edge> plain(const geometry::Edge& edge) {
  if (!edge.is_chain()) return edge;
  geometry::Edge smooth = straightened(edge);
  if (edge.start == edge.end) {
    smooth = around_centroid(edge);
    if (all_near(edge, *smooth.arc, 0.02 * smooth.arc->radius)) return smooth;
    return std::nullopt;
  }
  const Vec2 middle = edge.at(0.5);
  smooth.arc = circle_through(edge.start, middle, edge.end);
  if (!smooth.arc) return smooth;
  const Vec2 chord = edge.end - edge.start;
  const double rise = std::abs(cross(Vec2(middle - edge.start), chord)) / chord.norm();
  if (all_near(edge, *smooth.arc, 0.05 * rise)) return smooth;
  return std::nullopt;
}

/// How far a chain is from another edge: its nearest point, and the largest distance.
struct Approach {
  int nearest = 0;
  double least = std::numeric_limits<double>::max(), most = 0.0;
};
Approach approach_of(const geometry::Edge& chain, const geometry::Edge& other) {
  const int stride = std::max(1, chain.segments() / 200);
  Approach approach;
  const auto look = [&](int i) {
    const double distance = geometry::distance_to(other, chain.chain_point(i));
    if (distance < approach.least) approach.least = distance, approach.nearest = i;
    approach.most = std::max(approach.most, distance);
  };
  for (int i = 0; i < chain.segments(); i += stride) look(i);
  look(chain.segments());
  const int from = std::max(0, approach.nearest - stride), to = std::min(chain.segments(), approach.nearest + stride);
  for (int i = from; i <= to; ++i) look(i);
  return approach;
}

/// A chain that is neither line nor arc. Where it follows the other edge, rays along its chord, or from the middle of a
/// closed one, meet both alike. Where they touch in a short zone, the circle of its curvature there counts.
geometry::Edge smoothed(const geometry::Edge& chain, const geometry::Edge& other) {
  constexpr double following = 0.05, part = 1.0 / 16.0;  // of the length
  const Approach approach = approach_of(chain, other);
  const bool closed = chain.start == chain.end;
  if (approach.most <= following * chain.length()) return closed ? around_centroid(chain) : straightened(chain);
  const double middle = geometry::closest_position(chain, chain.chain_point(approach.nearest));
  const auto at = [&](double t) { return chain.at(closed ? t - std::floor(t) : std::clamp(t, 0.0, 1.0)); };
  geometry::Edge local;
  local.start = at(middle - part);
  local.end = at(middle + part);
  local.arc = circle_through(local.start, at(middle), local.end);
  return local;
}

/// The fraction on a closed edge, where 0 and 1 are the same point, that is nearest to another one.
double fraction_near(const geometry::Edge& edge, double t, double expected) {
  const bool closed = (edge.end - edge.start).norm() < 1e-9 * edge.length();
  return closed ? t + std::round(expected - t) : t;
}

}  // namespace

Rays::Rays(const geometry::Edge& of_a, const geometry::Edge& of_b) {
  const std::optional<geometry::Edge> plain_a = plain(of_a), plain_b = plain(of_b);
  if (plain_a.has_value() != plain_b.has_value() && !(plain_a ? plain_a : plain_b)->arc) {
    const geometry::Edge& straight = plain_a ? *plain_a : *plain_b;  // its normal is between those of any convex edge
    direction_ = normal_at(straight, straight.start);
    return;
  }
  const geometry::Edge a = plain_a ? *plain_a : smoothed(of_a, of_b), b = plain_b ? *plain_b : smoothed(of_b, of_a);
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
