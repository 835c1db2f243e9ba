// A rectangle divided into finite elements: quadrilaterals of 8 nodes (order 2) or 4 (order 1).
//
// clang-format off
//     3---6---2      Nodes are numbered row by row from the first corner of the outline, along its first edge:
//     |       |      2 nx + 1 nodes in a row of corners, nx + 1 in a row of middles; with order 1 only rows of nx + 1
//     |       |      corners.
//     7       5
//     |       |
//     0---4---1
// clang-format on
#pragma once

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Number of nodes that divide_grid would create.
double count_grid_nodes(const model::Body& body);

/// Divides the rectangle `body`, which may be rotated, into nx x ny elements not longer than `size`.
BodyMesh divide_grid(const model::Body& body);

}  // namespace scabo::mesh
