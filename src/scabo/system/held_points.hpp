// Supports that begin or end in a step (model::Support): points that the ground holds along a direction.
//
// The matrix of a part is the same in all steps, so that such a support is no constraint of it, but pairs of the
// contact system, as bars are, without softness: side A is the ground, side B the point, and only the normal e, the
// direction that is held, has a force p_n, pull and push alike, that on the part. With the displacement d that the
// support prescribes there, counted from where the point was when the support came,
//
//     u_n = e . (u - u_0) - d = 0
//
// A support on a rigid body as a whole holds its rotation too. That is a pair of the body with itself, of which side B
// is a lever L from side A, so that its force is a couple: u_n = L (rotation - rotation_0) - d.
//
// Stages (analysis/quasistatic/stages.hpp) let pairs come and go.
#pragma once

#include "scabo/system/bars.hpp"

namespace scabo::system {

/// Points of all supports that begin or end. Throws InputError for supports that contradict each other.
std::vector<BarSystem> held_points_of(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs);

}  // namespace scabo::system
