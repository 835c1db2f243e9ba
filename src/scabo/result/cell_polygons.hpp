// The mesh as it was divided, for cells.vtu: every cell as one polygon through the nodes of its boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"

namespace scabo::result {

/// Stored in the arrays that are written to the file. Boundary elements of an unbounded body are lines from
/// node to node; a rigid body has no cells.
struct CellPolygons {
  std::vector<double> points;              // 3 per node, z = 0
  std::vector<double> displacement;        // 3 per node
  std::vector<std::int32_t> connectivity;  // point numbers of all cells in sequence
  std::vector<std::int32_t> offsets;       // one per cell: end of its points in `connectivity`
  std::vector<std::uint8_t> types;         // one per cell: VTK cell type
  // One per cell
  std::vector<std::int32_t> body;            // number from 1, in the order of the model
  std::vector<std::int32_t> material;        // number from 1, of its first side
  std::vector<std::uint8_t> finite_element;  // 1, or 0 for a super-element
};

/// `state`: of the same analysis; its displacements are shown relative to the reference point.
CellPolygons cell_polygons(const analysis::Discretisation& discretisation, const analysis::FieldState& state);

}  // namespace scabo::result
