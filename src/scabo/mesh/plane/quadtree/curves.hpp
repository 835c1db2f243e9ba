// The lines of a domain as curves that a quadtree cuts: straight lines and arcs of circles.
#pragma once

#include <optional>
#include <vector>

#include "scabo/mesh/plane/domain.hpp"

namespace scabo::mesh::quadtree {

struct Box {
  Vec2 lower = Vec2::Zero(), upper = Vec2::Zero();

  bool contains(const Vec2& p) const {
    return (p.array() >= lower.array()).all() && (p.array() <= upper.array()).all();
  }
  Box grown(double by) const { return {lower - Vec2::Constant(by), upper + Vec2::Constant(by)}; }
};

/// A point of a curve: position from 0 at the start to 1 at the end.
struct CurvePoint {
  double t = 0.0;
  Vec2 point = Vec2::Zero();
};

struct Curve {
  Vec2 start, end;
  std::optional<geometry::Arc> arc;
  int first = -1, last = -1;  ///< corners at its ends, from 0; equal for a closed curve
  int left = -1, right = -1;  ///< regions
  bool crack = false;
  Box box;

  bool meets(const Box& other) const;                                     ///< whether a part is in the closed box
  CurvePoint foot(const Vec2& point) const;                               ///< the nearest point, on its ends at most
  std::vector<CurvePoint> crossings(const Vec2& a, const Vec2& b) const;  ///< with the straight piece from a to b
};

/// The curves of the lines, and their distinct ends.
struct Curves {
  std::vector<Curve> curves;
  std::vector<Vec2> corners;
  Box box;  ///< around all of them

  explicit Curves(const std::vector<DomainLine>& lines);
};

/// Finds the region of a point: the region beside the first curve that a horizontal ray meets.
class RegionFinder {
 public:
  explicit RegionFinder(const Curves& curves);
  /// Region of a point that is not on a curve, -1 outside. No curve lies within `clearance` above and below the point.
  int at(const Vec2& point, double clearance) const;

 private:
  int look(const Vec2& point, double near, bool& doubtful) const;

  const Curves& curves_;
  double lower_, step_;
  std::vector<std::vector<int>> rows_;  // curves that each horizontal strip touches
};

}  // namespace scabo::mesh::quadtree
