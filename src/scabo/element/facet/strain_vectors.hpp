// Strains and stresses at the points of facets: vectors [xx, yy, xy], shear strain in engineering form (gamma_xy =
// 2 eps_xy).
#pragma once

#include <Eigen/Core>

namespace scabo::element {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace scabo::element
