// A rigid body in space as a part whose displacement vector is that of the nodes of its mesh, as of an elastic one: so
// loads, contact pairs and results do not tell them apart.
//
//     u = R q,  q = [displacement of the point `at`, L rotations about it],  held rows of q prescribed
//
// with L half the diagonal of the box around the nodes, so that all six of q are lengths. Without springs its
// flexibility is 0; with them it is R Y (Y'R'S R Y)^-1 Y'R' for the motions Y that they resist.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scabo/system/body_system.hpp"
#include "scabo/system/solid_springs.hpp"

namespace scabo::system {

/// One of the six motions of a rigid body, held at the value of a support.
Constraint held_motion(int motion, double value);
/// Which one it is: 0 to 2 along the axes, 3 to 5 the rotation about them.
int held_motion(const Constraint& constraint);

/// Constraints by held_motion(), each motion at most once; prescribed values are lengths and radians, and reactions
/// forces at `at` and moments about it.
std::unique_ptr<BodySystem> rigid_solid(const Matrix& nodes, const Eigen::Vector3d& at,
                                        std::vector<Constraint> constraints,
                                        const std::vector<SolidSpring>& springs = {});

}  // namespace scabo::system
