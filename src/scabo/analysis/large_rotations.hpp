// Rotations that contradict the theory of small displacements: normals of pairs, arms of forces and directions of loads
// are those of the bodies as drawn.
#pragma once

#include <string>

#include "scabo/analysis/increment.hpp"

namespace scabo::analysis {

/// Names the body that turns most, if that is by more than 0.1 rad; else empty. Of an elastic body the rotation is that
/// of the rigid motion nearest to the displacements of its nodes.
std::string large_rotation(const Prepared& prepared, const State& state);

}  // namespace scabo::analysis
