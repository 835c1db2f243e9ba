// Centres and shapes of polygons: third and last step of polygon_mesh (polygons.hpp).
#pragma once

#include "scabo/mesh/plane/dual_cells.hpp"

namespace scabo::mesh {

/// The mesh of `cells`, where short sides are collapsed, free nodes moved and cells divided so that every cell is seen
/// well from its centre; nodes are numbered in the order in which cells meet them. Throws Refusal if a cell remains
/// that is not seen from any point.
PolygonMesh improved(DualCells cells);

}  // namespace scabo::mesh
