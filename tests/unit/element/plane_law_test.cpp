// The laws of the plane, free strain and stress out of the plane, against the law in space, inverted as a whole.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "scabo/element/plane/elasticity.hpp"

namespace scabo::element {
namespace {

using Vec4 = Eigen::Vector4d;  // xx, yy, zz, xy; the shears along z play no part in the plane
using Mat4 = Eigen::Matrix4d;

/// strain = S stress + expansion T in space, axes 1 and 2 turned by `angle` from x and y.
struct Law {
  Mat4 S;
  Vec4 expansion;
};

Law law(const std::array<double, 3>& E, double nu12, double nu13, double nu23, double G12,
        const std::array<double, 3>& alpha, double angle) {
  Mat4 S = Mat4::Zero();
  S(0, 0) = 1 / E[0], S(1, 1) = 1 / E[1], S(2, 2) = 1 / E[2], S(3, 3) = 1 / G12;
  S(0, 1) = S(1, 0) = -nu12 / E[0];
  S(0, 2) = S(2, 0) = -nu13 / E[0];
  S(1, 2) = S(2, 1) = -nu23 / E[1];
  const double c = std::cos(angle), s = std::sin(angle);
  Mat4 T =
      Mat4::Identity();  // stress along the axes from that in x and y; strain in x and y = T' strain along the axes
  T << c * c, s * s, 0, 2 * c * s, s * s, c * c, 0, -2 * c * s, 0, 0, 1, 0, -c * s, c * s, 0, c * c - s * s;
  return {T.transpose() * S * T, T.transpose() * Vec4(alpha[0], alpha[1], alpha[2], 0)};
}

void expect_alike(const model::Material& material, const Law& in_space) {
  const Vec3 strain(1.1e-3, -0.7e-3, 0.4e-3);
  const double T = 17.0;
  for (const model::Plane plane : {model::Plane::stress, model::Plane::strain}) {
    Vec4 stress;
    if (plane == model::Plane::strain) {
      stress = in_space.S.inverse() * (Vec4(strain[0], strain[1], 0, strain[2]) - in_space.expansion * T);
    } else {  // zz free: take it out of the compliance
      const std::array<int, 3> in{0, 1, 3};
      const Vec3 expansion = in_space.expansion(in),
                 found = Mat3(in_space.S(in, in)).inverse() * (strain - expansion * T);
      stress = Vec4(found[0], found[1], 0, found[2]);
    }
    const Vec3 found = elasticity_matrix(material, plane) * (strain - thermal_strain(material, plane) * T);
    const double scale = stress.norm();
    EXPECT_NEAR(found[0], stress[0], 1e-13 * scale);
    EXPECT_NEAR(found[1], stress[1], 1e-13 * scale);
    EXPECT_NEAR(found[2], stress[3], 1e-13 * scale);
    EXPECT_NEAR(stress_zz(found, material, plane, T), stress[2], 1e-12 * scale);
  }
}

TEST(PlaneLaw, OfIsotropicMaterialIsThatOfSpace) {
  model::Material material;
  material.young = 210e9;
  material.poisson = 0.3;
  material.expansion = {1.2e-5, 1.2e-5, 1.2e-5};
  const double E = 210e9, nu = 0.3, G = E / (2 * (1 + nu));
  expect_alike(material, law({E, E, E}, nu, nu, nu, G, {1.2e-5, 1.2e-5, 1.2e-5}, 0.0));
}

TEST(PlaneLaw, OfOrthotropicMaterialIsThatOfSpace) {
  for (const double degrees : {0.0, 30.0, 90.0, -110.0}) {
    model::Material material;
    model::Orthotropic constants;
    constants.E1 = 140e9, constants.E2 = 10e9, constants.E3 = 12e9;
    constants.nu12 = 0.3, constants.nu13 = 0.28, constants.nu23 = 0.4;
    constants.G12 = 5e9;
    constants.angle = degrees * std::numbers::pi / 180;
    material.law = constants;
    material.expansion = {0.5e-6, 30e-6, 25e-6};
    expect_alike(material, law({140e9, 10e9, 12e9}, 0.3, 0.28, 0.4, 5e9, {0.5e-6, 30e-6, 25e-6},
                               degrees * std::numbers::pi / 180));
  }
}

}  // namespace
}  // namespace scabo::element
