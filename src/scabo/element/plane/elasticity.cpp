#include "scabo/element/plane/elasticity.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "scabo/base/error.hpp"

namespace scabo::element {

namespace {

Mat3 isotropic(double E, double nu, model::Plane plane) {
  Mat3 D = Mat3::Zero();
  if (plane == model::Plane::stress) {
    const double c = E / (1.0 - nu * nu);
    D << c, c * nu, 0.0, c * nu, c, 0.0, 0.0, 0.0, E / (2.0 * (1.0 + nu));
  } else {
    const double c = E / ((1.0 + nu) * (1.0 - 2.0 * nu));
    D << c * (1.0 - nu), c * nu, 0.0, c * nu, c * (1.0 - nu), 0.0, 0.0, 0.0, E / (2.0 * (1.0 + nu));
  }
  return D;
}

/// Terms of the third axis: strain 3 = S13 stress 1 + S23 stress 2 + stress 3 / E3.
struct ThirdAxis {
  double S13 = 0.0, S23 = 0.0, E3 = 0.0, angle = 0.0;
};

std::optional<ThirdAxis> third_axis(const model::Material& material) {
  if (!material.law)
    return ThirdAxis{-material.poisson / material.young, -material.poisson / material.young, material.young, 0.0};
  if (const auto* o = std::get_if<model::Orthotropic>(&*material.law))
    return ThirdAxis{-o->nu13 / o->E1, -o->nu23 / o->E2, o->E3, o->angle};
  return {};
}

/// [11, 22, gamma_12] in axes turned by `angle` from those of [xx, yy, gamma_xy].
Mat3 strain_in_turned_axes(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 T;
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  return T;
}

/// Whether strain 3 is not free.
bool holds_third_axis(model::Plane plane) { return plane != model::Plane::stress; }

Mat3 orthotropic(const model::Orthotropic& o, model::Plane plane) {
  Mat3 S = Mat3::Zero();
  S << 1.0 / o.E1, -o.nu12 / o.E1, 0.0, -o.nu12 / o.E1, 1.0 / o.E2, 0.0, 0.0, 0.0, 1.0 / o.G12;
  if (holds_third_axis(plane)) {  // strain 3 = 0 eliminates stress 3
    const Vec3 S3(-o.nu13 / o.E1, -o.nu23 / o.E2, 0.0);
    S -= o.E3 * S3 * S3.transpose();
  }
  const Mat3 T = strain_in_turned_axes(o.angle), D = T.transpose() * S.inverse() * T;
  return 0.5 * (D + D.transpose());
}

}  // namespace

Mat3 elasticity_matrix(const model::Material& material, model::Plane plane) {
  if (!material.law) return isotropic(material.young, material.poisson, plane);
  if (const auto* o = std::get_if<model::Orthotropic>(&*material.law)) return orthotropic(*o, plane);
  const auto& a = std::get<model::Anisotropic>(*material.law);
  Mat3 D;
  D << a.D11, a.D12, a.D16, a.D12, a.D22, a.D26, a.D16, a.D26, a.D66;
  return D;
}

double heat_across(const model::Material& material, model::Plane plane) {
  if (!material.expansion || plane == model::Plane::revolution) return 0.0;
  const double stress = stress_zz(Vec3::Zero(), material, plane, 1.0);
  return std::isfinite(stress) ? -stress * (*material.expansion)[2] : 0.0;
}

Vec3 thermal_strain(const model::Material& material, model::Plane plane) {
  if (!material.expansion) return Vec3::Zero();
  const auto& [a1, a2, a3] = *material.expansion;
  Vec3 strain(a1, a2, 0.0);
  const auto third = third_axis(material);
  if (!third) return {a1, a2, a3};  // of an anisotropic law: exx, eyy, gxy
  if (plane == model::Plane::strain) strain -= Vec3(third->S13, third->S23, 0.0) * third->E3 * a3;
  return strain_in_turned_axes(-third->angle) * strain;
}

SectionLaw::SectionLaw(const Mat3& plane, const Vec3& of_temperature) {
  D.topLeftCorner<3, 3>() = plane;
  unit_strain.head<3>() = of_temperature;
}

SectionLaw section_law(const model::Material& material, model::Plane plane) {
  SectionLaw law(elasticity_matrix(material, plane), thermal_strain(material, plane));
  if (plane != model::Plane::revolution) return law;
  // Strain 3 adds -E3 [S13, S23] to the stresses of a body in which it is 0, in the law without strain 3.
  const auto third = third_axis(material);
  ensure(third.has_value(), "a law of the plane alone has no hoop stress");
  const Vec3 S3 = strain_in_turned_axes(-third->angle) * Vec3(third->S13, third->S23, 0.0);
  const Vec3 coupling = -third->E3 * (law.D.topLeftCorner<3, 3>() * S3);
  law.D.topRightCorner<3, 1>() = coupling;
  law.D.bottomLeftCorner<1, 3>() = coupling.transpose();
  law.D(3, 3) = third->E3 - third->E3 * S3.dot(coupling);
  if (material.expansion) law.unit_strain[3] = (*material.expansion)[2];
  return law;
}

double stress_zz(const Vec3& stress, const model::Material& material, model::Plane plane, double temperature,
                 double strain_zz) {
  if (plane == model::Plane::stress) return 0.0;
  const auto third = third_axis(material);
  if (!third) return std::numeric_limits<double>::quiet_NaN();
  const double c = std::cos(third->angle), s = std::sin(third->angle);
  const double stress_1 = c * c * stress[0] + s * s * stress[1] + 2.0 * c * s * stress[2];
  const double stress_2 = stress[0] + stress[1] - stress_1;
  const double a3 = material.expansion ? (*material.expansion)[2] : 0.0;
  return third->E3 * (strain_zz - third->S13 * stress_1 - third->S23 * stress_2 - a3 * temperature);
}

}  // namespace scabo::element
