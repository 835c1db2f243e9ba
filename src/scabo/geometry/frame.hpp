// Axes along a direction in space.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::geometry {

/// Orthonormal and right-handed; the last column is the direction of `axis`, which is not zero.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& axis);

}  // namespace scabo::geometry
