// The points at which results are requested (`output` of the model), each with a body that contains it.
//
// A body contains the points inside and on its outline, with arcs treated exactly, to within 1e-9 of its size. A point
// on an edge where two bodies touch belongs to both.
#pragma once

#include <string>
#include <vector>

#include "scabo/geometry/box.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

struct OutputPoint {
  std::string name;  ///< name of the point or of its line, or `grid`
  int body = -1;
  Vec2 at = Vec2::Zero();
  double distance = 0.0;  ///< distance along its line from the first point
};

struct OutputPoints {
  std::vector<OutputPoint> points, lines, grid;  ///< points.csv, lines.csv, grid.csv
};

/// Throws InputError for points, and points of lines, that lie in no body. Points of a grid that lie in no body are
/// left out.
OutputPoints output_points(const model::Model& model);

/// The bodies that contain each of many points.
class BodyFinder {
 public:
  explicit BodyFinder(const model::Model& model);  ///< keeps a reference
  /// Indices of the bodies, ascending; with `only` (an index), that body or none.
  std::vector<int> at(const Vec2& point, int only = -1) const;
  /// Why a point that no body contains has no value, with a remedy.
  std::string why_outside(const Vec2& point, int only = -1) const;

 private:
  const model::Model& model_;
  std::vector<geometry::Box> boxes_;
};

/// Whether the body contains the point.
bool holds(const model::Body& body, const Vec2& point);

}  // namespace scabo::mesh
