// Displacements and rotations that contradict the theory of small displacements: normals of pairs, arms of forces and
// directions of loads are those of the bodies as drawn.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Names the body that turns most, if that is by more than 0.1 rad; else empty. Of an elastic body the rotation is that
/// of the rigid motion nearest to the displacements of its nodes.
std::string large_rotation(const Prepared& prepared, const State& state);

/// A sentence about the first body whose displacements exceed a tenth of its size: whether it moves as a whole or
/// deforms, and what holds it; empty if there is none.
std::string large_displacement(const Prepared& prepared, const State& state);

/// One warning for each contact with large slip whose normals are wrong by more than 0.02 rad because its bodies turn.
/// Normals bisect both sides as they are drawn: a sled with a round runner that rocks by 0.07 rad has forces inclined
/// by 0.04 rad too much, 15 % of its friction. Of a straight side that is rigid they are exact while it does not turn.
std::vector<Warning> rotations_at_large_slip(const Prepared& prepared, const State& state);

}  // namespace scabo::analysis
