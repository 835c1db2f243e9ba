// Closed boundaries of straight lines, chains of straight lines and circular arcs, with the names that a model file
// gives them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::geometry {

/// An arc of a circle from `start_angle` through `sweep` (radians, counter-clockwise positive).
struct Arc {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
  double start_angle = 0.0;
  double sweep = 0.0;
};

/// One edge of the boundary of a body, a straight line, a chain of straight lines or an arc, directed counter-clockwise
/// around the body (material on the left). A chain comes from a mesh file, and only one, or a full circle, ends where
/// it starts.
struct Edge {
  std::vector<std::string> names;  ///< its own name first (`edge_3`), then those given by the user
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  std::optional<Arc> arc;    ///< empty for a straight line and a chain
  std::vector<Vec2> points;  ///< between start and end, of a chain of straight lines; empty otherwise
  Source source;

  Vec2 at(double t) const;  ///< point at 0 <= t <= 1 of the edge's length
  double length() const;

  bool is_chain() const { return !points.empty(); }
  /// A chain has one straight segment more than it has inner points; any other edge counts as one.
  int segments() const { return static_cast<int>(points.size()) + 1; }
  /// Segment i extends from chain_point(i) to chain_point(i + 1).
  const Vec2& chain_point(int i) const {
    return i == 0 ? start : i == segments() ? end : points[static_cast<std::size_t>(i - 1)];
  }
};

/// Whether it is a straight line, or a chain of which no point is farther from the line between its ends than 1e-9 of
/// its length.
bool runs_straight(const Edge& edge);

/// The same edge, moved by a translation.
Edge translated(const Edge& edge, const Vec2& by);

/// A corner is the start of the edge with the same index.
struct Corner {
  std::vector<std::string> names;
  Vec2 position = Vec2::Zero();
};

/// A closed boundary: one outer chain of edges, in which edges[i] ends where edges[i + 1] starts and the last one where
/// the first one starts, then one such chain for every hole.
struct Outline {
  std::vector<Edge> edges;
  std::vector<Corner> corners;
  std::vector<int> holes;  ///< index of the first edge of every hole, ascending
  bool rectangle = false;  ///< given as `rectangle`, which `fem` meshes require

  int next(int edge) const;      ///< the edge that starts where `edge` ends
  int previous(int edge) const;  ///< the edge that ends where `edge` starts

  double area() const;    ///< arcs included exactly
  Vec2 centroid() const;  ///< arcs included exactly
  /// Integral of the squared distance from the centroid, length^4; arcs included exactly.
  double polar_moment() const;
};

/// Reverses the direction of an outline without holes; every edge and corner keeps its names.
void turn_round(Outline& outline);

}  // namespace scabo::geometry
