// What acts on an elastic body through one of its edges, or a face that has nodes: loads, contact forces, reactions and
// springs on the edge, and what a tied body transmits there.
//
//     F = sum over the nodes of the edge of (K u - f)                                                          (1)
//     M = sum of (x - about) x (K u - f)
//
// K: stiffness of the cells of this body alone. f: forces at these nodes that do not act through the edge: the
// equivalent forces of loads inside the body, of initial stress and of temperature; and, at the two ends, loads,
// contact forces, pore pressure, reactions and springs of other edges and faces. Forces at corners and points of the
// edge act through it. At a node that only another edge shares with a tied body, K u - f is replaced by the sum of what
// acts through this edge: what the tie transmits belongs to the other. By virtual work with a rigid motion, (1) is in
// balance with all other forces on the body to rounding, whatever the mesh.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// One for each model::EdgeResultant of the history; zero where the body is absent.
std::vector<EdgeForces> edge_forces(const Prepared& prepared, const State& state);

}  // namespace scabo::analysis
