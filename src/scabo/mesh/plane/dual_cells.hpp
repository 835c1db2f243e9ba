// Cells of the dual of a triangulation: second step of polygon_mesh (polygons.hpp), before short sides are collapsed
// and centres are placed (polygon_quality.hpp).
#pragma once

#include <unordered_map>
#include <vector>

#include "scabo/mesh/plane/domain.hpp"
#include "scabo/mesh/plane/dual_vertices.hpp"
#include "scabo/mesh/plane/triangulation.hpp"

namespace scabo::mesh {

/// Nodes and cells. The first nodes are the centroids of all triangles, in their order: only these may be moved.
struct DualCells {
  PolygonMesh mesh;  ///< a cell has its centre only where it is fixed
  std::vector<Triangle> triangles;
  std::vector<int> region;                                ///< of each triangle; -1: outside
  std::vector<double> spacing;                            ///< wanted size of cells at the centroid of each triangle
  std::vector<int> cell_of;                               ///< for corner i of triangle t, at 3 t + i; -1: none
  std::unordered_map<int, std::vector<int>> second_cell;  ///< of triangles where the cells at a corner are divided
  std::vector<bool> fixed_centre;                         ///< for each cell: a scaling centre of the domain
};

/// The cells of all vertices of `dual`. Throws Refusal if a scaling centre is not the end of a line.
DualCells dual_cells(const Domain& domain, DualTriangulation dual);

}  // namespace scabo::mesh
