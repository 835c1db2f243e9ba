// Linear isotropic elasticity in the plane. Strain and stress vectors are [xx, yy, xy], shear strain in
// engineering form (gamma_xy = 2 eps_xy).
#pragma once

#include <Eigen/Core>

#include "scabo/model/model.hpp"

namespace scabo::element {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// stress = D strain; force / length^2.
Mat3 elasticity_matrix(const model::Material& material, model::Plane plane);

/// Out-of-plane stress that belongs to the in-plane `stress`: nu (s_xx + s_yy) in plane strain, 0 in plane stress.
double stress_zz(const Vec3& stress, const model::Material& material, model::Plane plane, double temperature = 0.0);

/// Free strain [xx, yy, xy] per unit of temperature; in plane strain what is left when the strain along z is held at 0.
Vec3 thermal_strain(const model::Material& material, model::Plane plane);

}  // namespace scabo::element
