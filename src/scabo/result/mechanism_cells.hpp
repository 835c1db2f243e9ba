// The motion of a mechanism for mechanism.vtu: every body as it is drawn, by its cells as polygons (a rigid one by its
// outline), and every contact as a line through its pairs, on A.
#pragma once

#include <cstdint>
#include <vector>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::result {

/// Stored in the arrays that are written to the file. Bodies first, then contacts. Bodies that are absent have no
/// points.
struct MechanismCells {
  std::vector<double> points;              // 3 per point, z = 0, before any motion
  std::vector<std::int32_t> connectivity;  // point numbers of all cells in sequence
  std::vector<std::int32_t> offsets;       // one per cell: end of its points in `connectivity`
  std::vector<std::uint8_t> types;         // one per cell: VTK cell type
  // One per point
  std::vector<double> displacement;      // 3 per point; of a pair that of the point on A
  std::vector<double> opening, slip;     // length, of B relative to A, along n and t; 0 at points of bodies
  std::vector<std::int32_t> pair;        // number from 1; 0 at points of bodies
  std::vector<std::int32_t> point_body;  // number from 1, in the order of the model; of a pair that of A
  // One per cell
  std::vector<double> motion;         // largest displacement of the body, of a contact its largest slip or opening
  std::vector<std::int32_t> body;     // number from 1; 0 of contacts
  std::vector<std::int32_t> contact;  // number from 1, in the order of the model; 0 of bodies
};

MechanismCells mechanism_cells(const analysis::Discretisation& discretisation, const analysis::Mechanism& mechanism);

}  // namespace scabo::result
