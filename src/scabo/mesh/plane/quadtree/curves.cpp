#include "scabo/mesh/plane/quadtree/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace scabo::mesh::quadtree {

namespace {

/// Position of an angle on an arc: 0 to 1 on it, otherwise outside of [0, 1].
double position_of(const geometry::Arc& arc, const Vec2& point) {
  const Vec2 from = point - arc.centre;
  const double full = 2.0 * std::numbers::pi;
  double turn = (std::atan2(from.y(), from.x()) - arc.start_angle) * (arc.sweep > 0.0 ? 1.0 : -1.0);
  turn -= full * std::floor(turn / full);
  const double sweep = std::abs(arc.sweep);
  // Beyond the arc the nearer end decides on which side of [0, 1] it is.
  if (turn > sweep && full - turn < turn - sweep) turn -= full;
  return turn / sweep;
}

Vec2 on_circle(const geometry::Arc& arc, const Vec2& point) {
  return arc.centre + arc.radius * (point - arc.centre).normalized();
}

/// Whether the straight piece from a to b has a point in the closed box.
bool straight_meets(const Vec2& a, const Vec2& b, const Box& box) {
  if (std::max(a.x(), b.x()) < box.lower.x() || std::min(a.x(), b.x()) > box.upper.x() ||
      std::max(a.y(), b.y()) < box.lower.y() || std::min(a.y(), b.y()) > box.upper.y()) {
    return false;
  }
  const Vec2 along = b - a, middle = 0.5 * (box.lower + box.upper) - a, half = 0.5 * (box.upper - box.lower);
  return std::abs(cross(along, middle)) <= std::abs(along.x()) * half.y() + std::abs(along.y()) * half.x();
}

Box box_of(const Curve& curve) {
  Box box{curve.start.cwiseMin(curve.end), curve.start.cwiseMax(curve.end)};
  if (!curve.arc) return box;
  for (const Vec2& towards : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) {
    const Vec2 extreme = curve.arc->centre + curve.arc->radius * towards;
    const double t = position_of(*curve.arc, extreme);
    if (t < 0.0 || t > 1.0) continue;
    box.lower = box.lower.cwiseMin(extreme);
    box.upper = box.upper.cwiseMax(extreme);
  }
  return box;
}

}  // namespace

bool Curve::meets(const Box& other) const {
  if ((box.upper.array() < other.lower.array()).any() || (box.lower.array() > other.upper.array()).any()) return false;
  if (!arc) return straight_meets(start, end, other);
  if (other.contains(start) || other.contains(end)) return true;
  const Vec2 nearest = arc->centre.cwiseMax(other.lower).cwiseMin(other.upper);
  const Vec2 farthest = (other.lower - arc->centre).cwiseAbs().cwiseMax((other.upper - arc->centre).cwiseAbs());
  if ((nearest - arc->centre).norm() > arc->radius || farthest.norm() < arc->radius) return false;
  const Vec2 corners[4] = {
      other.lower, {other.upper.x(), other.lower.y()}, other.upper, {other.lower.x(), other.upper.y()}};
  for (int k = 0; k < 4; ++k) {
    if (!crossings(corners[k], corners[(k + 1) % 4]).empty()) return true;
  }
  return false;
}

CurvePoint Curve::foot(const Vec2& point) const {
  double t;
  if (arc) {
    t = point == arc->centre ? 0.0 : position_of(*arc, point);
  } else {
    t = (point - start).dot(end - start) / (end - start).squaredNorm();
  }
  if (t <= 0.0) return {0.0, start};
  if (t >= 1.0) return {1.0, end};
  return {t, arc ? on_circle(*arc, point) : Vec2(start + t * (end - start))};
}

std::vector<CurvePoint> Curve::crossings(const Vec2& a, const Vec2& b) const {
  std::vector<CurvePoint> found;
  const Vec2 along = b - a;
  if (!arc) {
    const Vec2 line = end - start;
    const double from = cross(line, a - start), to = cross(line, b - start);
    if ((from > 0.0) == (to > 0.0) && from != 0.0 && to != 0.0) return found;
    if (from == to) return found;
    const Vec2 point = a + from / (from - to) * along;
    const double t = (point - start).dot(line) / line.squaredNorm();
    if (t >= 0.0 && t <= 1.0) found.push_back({t, point});
    return found;
  }
  // |a + s along - centre| = radius
  const Vec2 from = a - arc->centre;
  const double square = along.squaredNorm(), middle = from.dot(along);
  const double distance = std::abs(cross(from, along)) / std::sqrt(square);
  const double inside = (arc->radius - distance) * (arc->radius + distance) * square;
  if (inside < 0.0) return found;
  const double root = std::sqrt(inside);
  for (double s : {(-middle - root) / square, (-middle + root) / square}) {
    if (s < 0.0 || s > 1.0) continue;
    const Vec2 point = on_circle(*arc, a + s * along);
    const double t = position_of(*arc, point);
    if (t >= 0.0 && t <= 1.0) found.push_back({t, point});
  }
  return found;
}

Curves::Curves(const std::vector<DomainLine>& lines) {
  const double infinity = std::numeric_limits<double>::infinity();
  box = {Vec2(infinity, infinity), Vec2(-infinity, -infinity)};
  for (const DomainLine& line : lines) {
    Curve curve{line.points.front(), line.points.back(), line.arc, -1, -1, line.left, line.right, line.crack, {}};
    curve.box = box_of(curve);
    box.lower = box.lower.cwiseMin(curve.box.lower);
    box.upper = box.upper.cwiseMax(curve.box.upper);
    curves.push_back(curve);
  }
  // Ends that differ by rounding are one corner.
  const double same = 1e-12 * (box.upper - box.lower).norm();
  std::map<std::pair<double, double>, int> known;
  const auto corner = [&](Vec2& at) {
    for (auto it = known.lower_bound({at.x() - same, -infinity}); it != known.end() && it->first.first <= at.x() + same;
         ++it) {
      if (std::abs(it->first.second - at.y()) <= same) {
        at = corners[it->second];
        return it->second;
      }
    }
    corners.push_back(at);
    return known[{at.x(), at.y()}] = int(corners.size()) - 1;
  };
  for (Curve& curve : curves) {
    curve.first = corner(curve.start);
    curve.last = corner(curve.end);
  }
}

RegionFinder::RegionFinder(const Curves& curves) : curves_(curves) {
  const int count = std::clamp(2 * int(curves.curves.size()), 1, 100000);
  lower_ = curves.box.lower.y();
  step_ = (curves.box.upper.y() - lower_) / count;
  rows_.resize(count);
  for (std::size_t k = 0; k < curves.curves.size(); ++k) {
    const Box& box = curves.curves[k].box;
    const int from = std::clamp(int((box.lower.y() - lower_) / step_) - 1, 0, count - 1);
    const int to = std::clamp(int((box.upper.y() - lower_) / step_) + 1, 0, count - 1);
    for (int row = from; row <= to; ++row) rows_[row].push_back(int(k));
  }
}

int RegionFinder::at(const Vec2& point, double clearance) const {
  // A ray through a corner would be ambiguous: another one beside it is taken.
  int region = -1;
  for (double shift : {0.137, -0.291, 0.4142, -0.0719, 0.333, -0.4567}) {
    bool doubtful = false;
    region = look(point + Vec2(0.0, shift * clearance), 1e-7 * clearance, doubtful);
    if (!doubtful) break;
  }
  return region;
}

int RegionFinder::look(const Vec2& point, double near, bool& doubtful) const {
  const int row = std::clamp(int((point.y() - lower_) / step_), 0, int(rows_.size()) - 1);
  double nearest = std::numeric_limits<double>::infinity();
  int region = -1;
  const auto meet = [&](double x, bool up, const Curve& curve) {
    if (x <= point.x() || x >= nearest) return;
    nearest = x;
    region = up ? curve.left : curve.right;
  };
  for (int index : rows_[row]) {
    const Curve& curve = curves_.curves[index];
    if (curve.box.upper.x() < point.x()) continue;
    if (std::abs(curve.start.y() - point.y()) < near || std::abs(curve.end.y() - point.y()) < near) doubtful = true;
    if (!curve.arc) {
      const bool above = curve.start.y() > point.y();
      if (above == (curve.end.y() > point.y())) continue;
      const double t = (point.y() - curve.start.y()) / (curve.end.y() - curve.start.y());
      meet(curve.start.x() + t * (curve.end.x() - curve.start.x()), !above, curve);
      continue;
    }
    const double dy = point.y() - curve.arc->centre.y(), reach = curve.arc->radius;
    if (std::abs(std::abs(dy) - reach) < near) doubtful = true;
    if (std::abs(dy) >= reach) continue;
    const double half = std::sqrt((reach - dy) * (reach + dy));
    for (double dx : {-half, half}) {
      const double t = position_of(*curve.arc, curve.arc->centre + Vec2(dx, dy));
      if (t >= 0.0 && t <= 1.0) meet(curve.arc->centre.x() + dx, (curve.arc->sweep > 0.0) == (dx > 0.0), curve);
    }
  }
  return region;
}

}  // namespace scabo::mesh::quadtree
