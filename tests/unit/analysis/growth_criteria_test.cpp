// Kink angles and equivalent factors of growth criteria against closed forms and converged numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/fatigue.hpp"

namespace scabo::analysis {
namespace {

using model::GrowthCriterion;

constexpr GrowthCriterion all[] = {GrowthCriterion::hoop_stress, GrowthCriterion::energy_release,
                                   GrowthCriterion::strain_energy_density, GrowthCriterion::zero_K_II};
constexpr double degree = std::numbers::pi / 180.0;
constexpr double kappa = 3.0 - 4.0 * 0.3;  // plane strain, nu = .3

double degrees(GrowthCriterion criterion, const Vec2& K) { return kink_of(criterion, {K}, kappa).angle / degree; }

// Under K_II/K_I = .1, .5, 1 and infinite: angles towards negative K_II.
TEST(GrowthCriteria, KinkAnglesFromPureOpeningToPureShear) {
  const struct {
    Vec2 K;
    double hoop_stress, strain_energy_density, zero_K_II, energy_release, release;  // degrees; G / G_0
  } rows[] = {{{1.0, 0.1}, 11.2029, 11.0695, 11.2515, 11.2514, 1.019594},
              {{1.0, 0.5}, 40.2078, 37.6272, 42.1259, 42.0294, 1.334254},
              {{1.0, 1.0}, 53.1301, 51.9067, 56.9580, 56.5654, 1.668040},
              {{0.0, 1.0}, 70.5288, 82.3377, 77.3301, 75.7568, 1.517224}};
  for (const auto& row : rows) {
    EXPECT_NEAR(degrees(GrowthCriterion::hoop_stress, row.K), -row.hoop_stress, 1e-4);
    EXPECT_NEAR(degrees(GrowthCriterion::strain_energy_density, row.K), -row.strain_energy_density, 1e-4);
    EXPECT_NEAR(degrees(GrowthCriterion::zero_K_II, row.K), -row.zero_K_II, 1e-3);
    EXPECT_NEAR(degrees(GrowthCriterion::energy_release, row.K), -row.energy_release, 1e-3);
    const double equivalent = kink_of(GrowthCriterion::energy_release, {row.K}, kappa).equivalent;
    EXPECT_NEAR(equivalent * equivalent / row.K.squaredNorm(), row.release, 2e-6);
  }
}

TEST(GrowthCriteria, StraightByTheEnergyReleasedInAnyMode) {
  const Kink kink = kink_of(GrowthCriterion::straight, {{3.0, -4.0}}, kappa);
  EXPECT_EQ(kink.angle, 0.0);
  EXPECT_NEAR(kink.equivalent, 5.0, 1e-14);
}

TEST(GrowthCriteria, AClosedTipCountsWithoutOpening) {
  EXPECT_NEAR(kink_at(GrowthCriterion::hoop_stress, {{-1e-6, -2.0}}, kappa), 2.0 * std::atan(std::sqrt(0.5)), 1e-15);
  EXPECT_EQ(kink_at(GrowthCriterion::hoop_stress, {{-1.0, 0.0}}, kappa), 0.0);
}

// Pure shear: hoop stress tan(a/2) = 2^-1/2, so that K* = 2/3^1/2 K_II; strain energy density cos a = (1 - 2 nu)/3.
TEST(GrowthCriteria, PureShear) {
  const Vec2 K(0.0, -3.0);
  const Kink hoop = kink_of(GrowthCriterion::hoop_stress, {K}, kappa);
  EXPECT_NEAR(hoop.angle, 2.0 * std::atan(std::sqrt(0.5)), 1e-15);
  EXPECT_NEAR(hoop.equivalent, 3.0 * 2.0 / std::sqrt(3.0), 1e-14);
  for (const double nu : {0.0, 0.2, 0.45})
    EXPECT_NEAR(kink_of(GrowthCriterion::strain_energy_density, {K}, 3.0 - 4.0 * nu).angle,
                std::acos((1.0 - 2.0 * nu) / 3.0), 1e-12);
}

TEST(GrowthCriteria, PureOpeningGoesOnAndScalesMirrorsAndUnitsDoNotMatter) {
  for (const GrowthCriterion criterion : all) {
    const Kink straight = kink_of(criterion, {{2.0, 0.0}}, kappa);
    EXPECT_EQ(straight.angle, 0.0);
    EXPECT_NEAR(straight.equivalent, 2.0, 1e-14);
    for (const double ratio : {1e-9, 1e-3, 0.3, 2.0, 1e9}) {
      const Kink one = kink_of(criterion, {{1.0, ratio}}, kappa), mirrored = kink_of(criterion, {{1.0, -ratio}}, kappa),
                 other = kink_of(criterion, {{1e6, 1e6 * ratio}}, kappa);
      EXPECT_EQ(one.angle, -mirrored.angle);
      EXPECT_LT(one.angle, 0.0);
      EXPECT_NEAR(other.angle, one.angle, 1e-7);
      EXPECT_NEAR(other.equivalent, 1e6 * one.equivalent, 1e-6 * one.equivalent);
    }
  }
}

// With the T-stress at a distance: the angle and K* of the largest hoop stress among many, whose derivative is 0 there.
TEST(GrowthCriteria, HoopStressWithTheTStress) {
  const auto stress = [](const Vec2& K, double T, double a) {
    const double c = std::cos(0.5 * a);
    return c * (K[0] * c * c - 1.5 * K[1] * std::sin(a)) + T * std::sin(a) * std::sin(a);
  };
  for (const Vec2& K : {Vec2(1.0, 0.2), Vec2(1.0, -0.7), Vec2(0.3, 1.0), Vec2(0.0, 1.0)})
    for (const double T : {-1.5, -0.3, 1e-9, 0.3, 1.5}) {
      const Kink kink = kink_of(GrowthCriterion::hoop_stress, {K, T}, kappa);
      double largest = 0.0;
      for (int k = -1790; k <= 1790; ++k) largest = std::max(largest, stress(K, T, 0.1 * k * degree));
      EXPECT_NEAR(kink.equivalent, stress(K, T, kink.angle), 1e-12);
      EXPECT_GE(kink.equivalent, largest - 1e-12);
      EXPECT_LT(kink.equivalent, largest + 1e-5);
      EXPECT_LE(kink.angle * K[1], 0.0);
    }
  const double without = kink_of(GrowthCriterion::hoop_stress, {{1.0, -0.5}}, kappa).angle;
  EXPECT_NEAR(kink_of(GrowthCriterion::hoop_stress, {{1.0, -0.5}, 1e-9}, kappa).angle, without, 1e-8);
  EXPECT_GT(kink_of(GrowthCriterion::hoop_stress, {{1.0, -0.5}, 0.2}, kappa).angle, without + 0.05);
  EXPECT_LT(kink_of(GrowthCriterion::hoop_stress, {{1.0, -0.5}, -0.2}, kappa).angle, without - 0.05);
}

// A crack in pure mode I goes straight on until T (2 pi r)^1/2 = 3/8 K_I, beyond which it turns.
TEST(GrowthCriteria, PureOpeningTurnsUnderALargeTStress) {
  const Kink below = kink_of(GrowthCriterion::hoop_stress, {{1.0, 0.0}, 0.374}, kappa),
             above = kink_of(GrowthCriterion::hoop_stress, {{1.0, 0.0}, 0.376}, kappa);
  EXPECT_NEAR(below.angle, 0.0, 1e-12);
  EXPECT_NEAR(below.equivalent, 1.0, 1e-14);
  EXPECT_GT(above.angle, 0.05);
  EXPECT_GT(above.equivalent, 1.0);
}

// The angle of maximum energy release leaves K_II < 0 at small kinks (Amestoy, Leblond 1992).
TEST(GrowthCriteria, FactorsAtKinks) {
  const struct {
    double angle, F11, F21, F12, F22;
  } rows[] = {{30.0, .901738, .240249, .729842, .797161},
              {60.0, .655670, .369250, 1.167992, .307871},
              {70.529, .554370, .378112, 1.223318, .117709}};
  for (const auto& row : rows) {
    const Vec2 I = factors_at_kink({1.0, 0.0}, -row.angle * degree),
               II = factors_at_kink({0.0, 1.0}, -row.angle * degree);
    EXPECT_NEAR(I[0], row.F11, 5e-6);
    EXPECT_NEAR(I[1], -row.F21, 5e-6);
    EXPECT_NEAR(II[0], row.F12, 5e-6);
    EXPECT_NEAR(II[1], row.F22, 5e-6);
  }
}

// R = 0.5, Delta K = 10.
TEST(GrowthPerCycle, ByTheThreeLaws) {
  model::LoadCycles cycles;
  cycles.C = 2.0;
  cycles.m = 3.0;
  EXPECT_NEAR(growth_per_cycle(cycles, 10.0, 20.0), 2000.0, 1e-9);
  cycles.law = model::FatigueLaw::walker;
  cycles.gamma = 0.5;
  EXPECT_NEAR(growth_per_cycle(cycles, 10.0, 20.0), 2000.0 * std::pow(0.5, -1.5), 1e-9);
  cycles.gamma = 1.0;
  EXPECT_NEAR(growth_per_cycle(cycles, 10.0, 20.0), 2000.0, 1e-9);
  cycles.law = model::FatigueLaw::forman;
  cycles.K_c = 50.0;
  EXPECT_NEAR(growth_per_cycle(cycles, 10.0, 20.0), 2000.0 / (0.5 * 50.0 - 10.0), 1e-9);
  EXPECT_TRUE(std::isinf(growth_per_cycle(cycles, 25.0, 50.0)));
}

}  // namespace
}  // namespace scabo::analysis
