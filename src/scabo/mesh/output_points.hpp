// The points at which values are wanted (`output` of the model), each with a body that holds it.
//
// A body holds the points inside its outline and on it, arcs taken exactly, to 1e-9 of its size. A point on an edge
// where two bodies touch belongs to both.
#pragma once

#include <string>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

struct OutputPoint {
  std::string name;  ///< of the point, of its line; `grid`
  int body = -1;
  Vec2 at = Vec2::Zero();
  double distance = 0.0;  ///< along its line, from the line's first point
};

struct OutputPoints {
  std::vector<OutputPoint> points, lines, grid;  ///< points.csv, lines.csv, grid.csv
};

/// Throws InputError for points that no body holds, those of lines included; of a grid they are left out.
OutputPoints output_points(const model::Model& model);

/// Whether the body holds the point.
bool holds(const model::Body& body, const Vec2& point);

}  // namespace scabo::mesh
