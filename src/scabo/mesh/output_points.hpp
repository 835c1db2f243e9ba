// The points at which results are requested (`output` of the model), each with a body that contains it.
//
// A body contains the points inside and on its outline, with arcs treated exactly, to within 1e-9 of its size. A point
// on an edge where two bodies touch belongs to both.
#pragma once

#include <string>
#include <vector>

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

/// Whether the body contains the point.
bool holds(const model::Body& body, const Vec2& point);

}  // namespace scabo::mesh
