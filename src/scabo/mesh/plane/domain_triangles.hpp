// Triangulations of a domain: by the points of its lines alone, or with points inside at the wanted distances.
#pragma once

#include <map>
#include <vector>

#include "scabo/mesh/plane/domain.hpp"
#include "scabo/mesh/plane/triangulation.hpp"

namespace scabo::mesh {

/// Points of lines, each once, and the segments between them.
struct LinePoints {
  std::vector<Vec2> points;
  std::vector<std::vector<int>> lines;  ///< for each line of the domain, the indices of its points
  /// For each segment (its smaller index first) the line and the position along it of its first point in the direction
  /// of the line.
  struct Segment {
    int from = -1, to = -1;  ///< in the direction of the line
    int line = -1;
    int first = 0, last = 0;  ///< the points of the line at its ends
  };
  std::map<std::pair<int, int>, Segment> segments;
};

/// All points of the lines, or only their ends and on arcs points that divide it into pieces of at most `turn` radians.
LinePoints points_of_lines(const Domain& domain);
LinePoints coarse_points_of_lines(const Domain& domain, double turn);

/// Triangles of the domain and their regions; those outside are left out, and neighbours in another region or outside
/// are -1 or constrained.
struct RegionTriangles {
  std::vector<Triangle> triangles;
  std::vector<int> regions;
};
RegionTriangles triangles_of(const std::vector<Vec2>& points, const LinePoints& lines, const Domain& domain);

/// A mesh of triangles of the wanted size, with a node at every point of the lines. Its cells are triangles with their
/// centroids as centres.
PolygonMesh triangle_mesh(const Domain& domain);

}  // namespace scabo::mesh
