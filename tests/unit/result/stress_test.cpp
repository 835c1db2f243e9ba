#include "scabo/result/stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scabo::result {
namespace {

constexpr double pi = std::numbers::pi;

TEST(PrincipalStress, UniaxialTension) {
  const StressMeasures measures = stress_measures({5.0, 0.0, 0.0}, 0.0);
  EXPECT_EQ(measures.principal, (std::array{5.0, 0.0, 0.0}));
  EXPECT_EQ(measures.angle, 0.0);
  EXPECT_DOUBLE_EQ(measures.von_mises, 5.0);
}

TEST(PrincipalStress, PureShearLiesAt45Degrees) {
  const StressMeasures measures = stress_measures({0.0, 0.0, -3.0}, 0.0);
  EXPECT_EQ(measures.principal, (std::array{3.0, 0.0, -3.0}));
  EXPECT_DOUBLE_EQ(measures.angle, -pi / 4.0);
  EXPECT_DOUBLE_EQ(measures.von_mises, 3.0 * std::sqrt(3.0));
}

TEST(PrincipalStress, OutOfPlaneStressTakesItsPlaceInTheOrder) {
  EXPECT_EQ(stress_measures({-4.0, -2.0, 0.0}, 0.0).principal, (std::array{0.0, -2.0, -4.0}));
  EXPECT_EQ(stress_measures({-4.0, -2.0, 0.0}, -3.0).principal, (std::array{-2.0, -3.0, -4.0}));
  EXPECT_EQ(stress_measures({-4.0, -2.0, 0.0}, -5.0).principal, (std::array{-2.0, -4.0, -5.0}));
}

TEST(PrincipalStress, NoStressHasNoDirection) {
  const StressMeasures measures = stress_measures({0.0, -0.0, -0.0}, 0.0);
  EXPECT_EQ(measures.angle, 0.0);
  EXPECT_EQ(measures.von_mises, 0.0);
}

TEST(PrincipalStress, EqualPressureFromAllSidesIsNoDistortion) {
  EXPECT_EQ(stress_measures({-7.0, -7.0, 0.0}, -7.0).von_mises, 0.0);
}

TEST(PrincipalStress, TurnsWithTheTensor) {
  for (const double angle : {-1.5, -0.8, -0.1, 0.3, 0.9, 1.5}) {
    Mat2 Q;
    Q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Mat2 S = Q * Eigen::DiagonalMatrix<double, 2>(8.0, -2.0) * Q.transpose();
    const StressMeasures measures = stress_measures({S(0, 0), S(1, 1), S(0, 1)}, 1.0);
    EXPECT_NEAR(measures.principal[0], 8.0, 1e-14);
    EXPECT_NEAR(measures.principal[1], 1.0, 1e-14);
    EXPECT_NEAR(measures.principal[2], -2.0, 1e-14);
    EXPECT_NEAR(measures.angle, angle, 1e-15);
    EXPECT_NEAR(measures.von_mises, std::sqrt(0.5 * (49.0 + 9.0 + 100.0)), 1e-14);
  }
}

}  // namespace
}  // namespace scabo::result
