// What every mesh of polygons owes its domain. Failures are reported as texts, the first few of each kind.
#pragma once

#include <string>

#include "scabo/mesh/plane/domain.hpp"

namespace scabo::test {

struct MeshSummary {
  std::vector<double> areas;      ///< of the cells of each region
  double least_clearance = 1e30;  ///< of a centre from the line of a side, in parts of the root of the cell's area
  double least_side = 1e30;       ///< in parts of the root of the cell's area
  int open = 0, squares = 0;      ///< open cells; rectangles with no nodes but corners and middles of sides
  double worst_ratio = 1.0;       ///< of the widths of two such rectangles with a common node
  std::string faults;             ///< empty if the mesh is valid
};

/// Checks that all cells are simple, counter-clockwise and visible from their centres, that every side is shared by two
/// cells of one region or lies on a line with the right regions on its sides, that chains run from end to end on their
/// lines, and that the areas of the regions are those that the chains enclose.
MeshSummary check_polygon_mesh(const mesh::Domain& domain, const mesh::PolygonMesh& mesh);

}  // namespace scabo::test
