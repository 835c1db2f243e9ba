// Geometry of outlines: points, lengths, area and centroid, arcs and chains included exactly.
#include "scabo/geometry/plane/outline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scabo::geometry {

namespace {

Vec2 on_chain(const Edge& edge, double t) {
  double rest = t * edge.length();
  for (int i = 0; i < edge.segments(); ++i) {
    const Vec2 along = edge.chain_point(i + 1) - edge.chain_point(i);
    const double length = along.norm();
    if (rest < length) return edge.chain_point(i) + rest / length * along;
    rest -= length;
  }
  return edge.end;
}

}  // namespace

Vec2 Edge::at(double t) const {
  if (t <= 0.0) return start;
  if (t >= 1.0) return end;
  if (is_chain()) return on_chain(*this, t);
  if (!arc) return start + t * (end - start);
  // Radii at both ends may differ by the rounding of the given coordinates; in between they are interpolated.
  const double radius = (1.0 - t) * (start - arc->centre).norm() + t * (end - arc->centre).norm();
  const double angle = arc->start_angle + t * arc->sweep;
  return arc->centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

namespace {

/// First edge and last + 1 of the chain of an edge.
std::pair<int, int> chain_of(const Outline& outline, int edge) {
  const auto after = std::upper_bound(outline.holes.begin(), outline.holes.end(), edge);
  return {after == outline.holes.begin() ? 0 : *(after - 1),
          after == outline.holes.end() ? static_cast<int>(outline.edges.size()) : *after};
}

}  // namespace

bool runs_straight(const Edge& edge) {
  if (edge.arc) return false;
  const Vec2 along = edge.end - edge.start;
  const double length = along.norm();
  return edge.points.empty() ||
         (length > 0.0 && std::all_of(edge.points.begin(), edge.points.end(), [&](const Vec2& x) {
            return std::abs(cross(along, Vec2(x - edge.start))) <= 1e-9 * length * length;
          }));
}

Edge translated(const Edge& edge, const Vec2& by) {
  Edge moved = edge;
  if (by.isZero(0.0)) return moved;  // bit by bit, the signs of zeros included
  moved.start += by;
  moved.end += by;
  if (moved.arc) moved.arc->centre += by;
  for (Vec2& point : moved.points) point += by;
  return moved;
}

int Outline::next(int edge) const {
  const auto [first, end] = chain_of(*this, edge);
  return edge + 1 == end ? first : edge + 1;
}

int Outline::previous(int edge) const {
  const auto [first, end] = chain_of(*this, edge);
  return edge == first ? end - 1 : edge - 1;
}

double Edge::length() const {
  if (arc) return arc->radius * std::abs(arc->sweep);
  double sum = 0.0;
  for (int i = 0; i < segments(); ++i) sum += (chain_point(i + 1) - chain_point(i)).norm();
  return sum;
}

namespace {

/// Twice the area between an arc and its chord, and three times its first moment about the centre of the arc;
/// negative where the arc runs clockwise.
struct Segment {
  double twice_area = 0.0;
  Vec2 triple_moment = Vec2::Zero();
};

Segment segment_of(const Arc& arc) {
  const double half = std::sin(0.5 * arc.sweep);
  const double middle = arc.start_angle + 0.5 * arc.sweep;
  const double r2 = arc.radius * arc.radius;
  return {r2 * (arc.sweep - std::sin(arc.sweep)),
          2.0 * r2 * arc.radius * half * half * half * Vec2(std::cos(middle), std::sin(middle))};
}

}  // namespace

double Outline::area() const {
  if (edges.empty()) return 0.0;
  const Vec2 origin = edges.front().start;  // near the body, because large coordinates would lose digits
  double twice = 0.0;
  for (const Edge& edge : edges) {
    for (int i = 0; i < edge.segments(); ++i)
      twice += cross(edge.chain_point(i) - origin, edge.chain_point(i + 1) - origin);
    if (edge.arc) twice += segment_of(*edge.arc).twice_area;
  }
  return 0.5 * twice;
}

Vec2 Outline::centroid() const {
  if (edges.empty()) return Vec2::Zero();
  const Vec2 origin = edges.front().start;
  double twice = 0.0;
  Vec2 sixfold = Vec2::Zero();  // six times the first moment about the origin
  for (const Edge& edge : edges) {
    for (int i = 0; i < edge.segments(); ++i) {
      const Vec2 a = edge.chain_point(i) - origin;
      const Vec2 b = edge.chain_point(i + 1) - origin;
      const double c = cross(a, b);
      twice += c;
      sixfold += c * (a + b);
    }
    if (edge.arc) {
      const Segment segment = segment_of(*edge.arc);
      twice += segment.twice_area;
      sixfold += 3.0 * segment.twice_area * (edge.arc->centre - origin) + 2.0 * segment.triple_moment;
    }
  }
  return origin + sixfold / (3.0 * twice);
}

namespace {

/// 1/4 of the integral of r^2 (x dy - y dx) along an arc, r from `about`: of r^2 over the area, by Green's theorem.
double polar_along(const Arc& arc, const Vec2& about) {
  const Vec2 c = arc.centre - about;
  const double R = arc.radius, begin = arc.start_angle, end = begin + arc.sweep;
  const double first = c.x() * (std::sin(end) - std::sin(begin)) - c.y() * (std::cos(end) - std::cos(begin));
  const double phi = std::atan2(c.y(), c.x());
  const double second =
      c.squaredNorm() * (0.5 * arc.sweep + 0.25 * (std::sin(2.0 * (end - phi)) - std::sin(2.0 * (begin - phi))));
  const double squares = c.squaredNorm() + R * R;
  return 0.25 * (squares * R * R * arc.sweep + (squares + 2.0 * R * R) * R * first + 2.0 * R * R * second);
}

}  // namespace

double Outline::polar_moment() const {
  const Vec2 about = centroid();
  double sum = 0.0;
  for (const Edge& edge : edges) {
    if (edge.arc) {
      sum += polar_along(*edge.arc, about);
      continue;
    }
    for (int i = 0; i < edge.segments(); ++i) {
      const Vec2 a = edge.chain_point(i) - about, b = edge.chain_point(i + 1) - about;
      sum += cross(a, b) / 12.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
  }
  return sum;
}

void turn_round(Outline& outline) {
  const std::size_t n = outline.edges.size();
  // Edge i, from corner i to i + 1, becomes number n - 1 - i and then starts at corner i + 1.
  Outline turned;
  for (std::size_t k = 0; k < n; ++k) {
    Edge edge = outline.edges[n - 1 - k];
    std::swap(edge.start, edge.end);
    std::reverse(edge.points.begin(), edge.points.end());
    if (edge.arc) {
      edge.arc->start_angle += edge.arc->sweep;
      edge.arc->sweep = -edge.arc->sweep;
    }
    turned.edges.push_back(std::move(edge));
    turned.corners.push_back(outline.corners[(n - k) % n]);
  }
  turned.rectangle = outline.rectangle;
  outline = std::move(turned);
}

}  // namespace scabo::geometry
