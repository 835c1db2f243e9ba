// Integrals along edges of elements in space, parabolas through both ends and the node in the middle: 3 x 3, in this
// order.
//
// Exact where the node in the middle halves a straight edge; on curved ones the sums over the nodes agree with each
// other.
#pragma once

#include <functional>

#include "scabo/base/types.hpp"

namespace scabo::element {

/// int N ds, three numbers: times a force per length, the nodal forces of it.
Eigen::Vector3d length_weights(const Eigen::Matrix3d& nodes);

/// int N q ds, 3 x 3: the nodal forces of a force per length that varies. Exact up to degree 7 of q.
Eigen::Matrix3d line_load_integrals(const Eigen::Matrix3d& nodes,
                                    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& load);

/// int N N' ds.
Eigen::Matrix3d length_mass(const Eigen::Matrix3d& nodes);

}  // namespace scabo::element
