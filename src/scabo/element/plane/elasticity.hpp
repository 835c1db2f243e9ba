// Linear elasticity in the plane (facet/strain_vectors.hpp).
//
// Orthotropic: compliance S along the material axes 1, 2, 3; in plane strain, where strain 3 = 0, stress 3 is
// eliminated, S_ij - S_i3 S_j3 / S_33. Axis 1 is rotated by an angle from x. Anisotropic: the law of the plane as
// given.
#pragma once

#include "scabo/element/facet/strain_vectors.hpp"
#include "scabo/model/model.hpp"

namespace scabo::element {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// stress = D strain; force / length^2. Of a body of revolution the part of its law without the hoop, as in plane
/// strain.
Mat3 elasticity_matrix(const model::Material& material, model::Plane plane);

/// Out-of-plane stress for the in-plane `stress` and a change of temperature: nu (s_xx + s_yy) - E alpha T in plane
/// strain of isotropic material, 0 in plane stress. Not a number for anisotropic material in plane strain, because the
/// law of the plane does not determine it.
/// `strain_zz`: of a body of revolution, u_x / x.
double stress_zz(const Vec3& stress, const model::Material& material, model::Plane plane, double temperature = 0.0,
                 double strain_zz = 0.0);

/// Twice the energy per volume that plane strain stores across the plane, E_3 alpha_3^2 T^2, per square of temperature:
/// the strains of the plane do not contain it. 0 in plane stress, and of an anisotropic law of the plane.
double heat_across(const model::Material& material, model::Plane plane);

/// Thermal strain [xx, yy, gamma_xy] per unit of temperature; in plane strain, the in-plane strain if the strain along
/// z is held at 0 (isotropic: (1 + nu) alpha). Zero without `expansion`.
Vec3 thermal_strain(const model::Material& material, model::Plane plane);

/// What a finite element is made of: stress [xx, yy, xy, zz] = D strain, and the free strain per unit of temperature.
/// Of plane elements zz is not used.
struct SectionLaw {
  Mat4 D = Mat4::Zero();
  Vec4 unit_strain = Vec4::Zero();

  SectionLaw() = default;
  SectionLaw(const Mat3& plane, const Vec3& of_temperature = Vec3::Zero());
};
SectionLaw section_law(const model::Material& material, model::Plane plane);

}  // namespace scabo::element
