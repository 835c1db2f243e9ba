// Barnett-Lothe tensors and interface cracks: closed forms of isotropic material, and the integral formalism as a slow
// oracle.
#include "scabo/element/plane/anisotropic_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <random>

#include "theory/open_rings.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

/// Mean of N(t) over half a turn (Barnett and Lothe 1973).
Mat4 by_integral(const Mat3& D) {
  constexpr int points = 4000;
  Mat4 sum = Mat4::Zero();
  for (int i = 0; i < points; ++i) sum += fundamental_elasticity(D, pi * i / points) / points;
  return sum;
}

void expect_tensors(const Mat3& D, double tolerance) {
  const BarnettLothe tensors = barnett_lothe(D);
  const Mat4 mean = by_integral(D);
  EXPECT_LT((tensors.S - mean.topLeftCorner<2, 2>()).norm(), tolerance * (1.0 + tensors.S.norm()));
  EXPECT_LT((tensors.H - mean.topRightCorner<2, 2>()).norm(), tolerance * tensors.H.norm());
  EXPECT_LT((tensors.L + mean.bottomLeftCorner<2, 2>()).norm(), tolerance * tensors.L.norm());
  // H L - S S = 1
  EXPECT_LT((tensors.H * tensors.L - tensors.S * tensors.S - Mat2::Identity()).norm(),
            1e-12 * tensors.H.norm() * tensors.L.norm());
}

TEST(BarnettLothe, IsotropicInClosedForm) {
  const double E = 210e9, nu = 0.3;
  EXPECT_LT(
      (barnett_lothe(elasticity(E, nu, model::Plane::strain)).L / E - Mat2::Identity() / (2 * (1 - nu * nu))).norm(),
      1e-12);
  EXPECT_LT((barnett_lothe(elasticity(E, nu, model::Plane::stress)).L / E - Mat2::Identity() / 2).norm(), 1e-12);
  const Mat2 S = barnett_lothe(elasticity(E, nu, model::Plane::strain)).S;
  EXPECT_NEAR(std::abs(S(0, 1)), (1 - 2 * nu) / (2 * (1 - nu)), 1e-12);
}

TEST(BarnettLothe, AgreesWithTheIntegral) {
  expect_tensors(elasticity(3.0, 0.2, model::Plane::strain), 1e-11);
  expect_tensors(elasticity(3.0, 0.49999, model::Plane::strain), 1e-9);
  std::mt19937 random(4);
  std::normal_distribution<double> entry;
  for (int i = 0; i < 20; ++i) {
    const Mat3 X = Mat3::NullaryExpr([&] { return entry(random); });
    expect_tensors(std::pow(10.0, i - 8) * (X * X.transpose() + 0.1 * Mat3::Identity()), 1e-9);
  }
}

TEST(RotatedElasticity, ThereAndBackAndIsotropicStays) {
  const Mat3 D = elasticity(3.0, 0.2);
  EXPECT_LT((rotated_elasticity(D, 0.7) - D).norm(), 1e-14 * D.norm());
  Mat3 law = Mat3::Identity();
  law(0, 1) = law(1, 0) = 0.2;
  law(0, 0) = 7.0;
  EXPECT_LT((rotated_elasticity(rotated_elasticity(law, 0.7), -0.7) - law).norm(), 1e-14 * law.norm());
  const Mat3 turned = rotated_elasticity(law, pi / 2);  // axes change places
  EXPECT_NEAR(turned(1, 1), 7.0, 1e-13);
  EXPECT_NEAR(turned(0, 0), 1.0, 1e-13);
}

TEST(CrackedBimaterial, IsotropicEpsilon) {
  for (const double ratio : {2.0, 10.0, 1000.0, 0.5}) {
    const auto pair =
        cracked_bimaterial(elasticity(ratio, 0.3, model::Plane::strain), elasticity(1.0, 0.3, model::Plane::strain));
    EXPECT_NEAR(pair.epsilon, interface_epsilon({ratio, 0.3, model::Plane::strain}, {1.0, 0.3, model::Plane::strain}),
                1e-14);
    const Vec2 k(0.3, 1.0);
    EXPECT_LT((pair.intensity(pair.opening(k, 0.2, 3.0), 0.2, 3.0) - k).norm(), 1e-13);
    EXPECT_NEAR(pair.energy_release_rate(pair.oscillation(0.01) * k), pair.energy_release_rate(k),
                1e-13 * pair.energy_release_rate(k));
  }
}

TEST(CrackedBimaterial, AlikeHalvesDoNotOscillate) {
  const Mat3 D = elasticity(5.0, 0.3);
  const auto pair = cracked_bimaterial(D, D);
  EXPECT_EQ(pair.epsilon, 0.0);
  const Vec2 k(0.3, 1.0);  // du = 8/E' sqrt(r / 2 pi) K
  EXPECT_LT((pair.opening(k, 0.5, 1.0) - 8.0 / 5.0 * std::sqrt(0.5 / (2 * pi)) * k).norm(), 1e-13);
}

}  // namespace
}  // namespace scabo::element
