// Water that enters a joint as it opens, against Navier's distribution under a stiff block on a bed of springs: the
// crack becomes longer by the pressure in it.
#include <fmt/format.h>

#include <cmath>

#include "verification/history_columns.hpp"

namespace scabo::verification::entering {
namespace {

constexpr double width = 4.0, height = 3.0, weight = 1000e3, thrust = 300e3;  // for each metre

/// Length c of the crack from the heel, in which the pressure p acts; the rest has a pressure that is linear and 0 at
/// its tip. About the toe W b / 2 - H h - p c (b - c / 2) = (W - p c) (b - c) / 3, of which c is the smallest root.
double length_of_crack(double p) {
  const auto left_over = [&](double c) {
    return (weight - p * c) * (width - c) / 3.0 - 0.5 * weight * width + thrust * height + p * c * (width - 0.5 * c);
  };
  double c = 0.0;
  constexpr double step = 1e-4;
  while (c < width && left_over(c) > 0.0) c += step;
  return c;
}

struct BlockOptions {
  double pressure = 60e3;
  const char* between = "floor.top, block.bottom";
  const char* more = "enters: true";
  const char* steps = "[{name: push}]";
  double mirror = 1.0;
  const char* modulus = "1e8";
};

analysis::StaticSolution block(const BlockOptions& with) {
  return run(fmt::format(R"(
scabo: 1
materials: {{stone: {{young: 1e13, poisson: 0}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-10, -1], size: [20, 1]}}}}}}
  block: {{material: stone, shape: {{rectangle: {{corner: [-2, 0], size: [{}, {}]}}}}, mesh: {{kind: fem, size: 0.1}}}}
supports: [{{on: floor, fix: [x, y], name: ground}}]
loads:
  weight: {{on: block.top, force: [0, -{}]}}
  thrust: {{on: block.top, force: [{}, 0]}}
  water: {{in: base, pressure: {}, {}}}
contacts: {{base: {{between: [{}], friction: 0.9, modulus: {}}}}}
steps: {}
output: {{history: {{under: {{edge: block.bottom}}}}}}
)",
                         width, height, weight, with.mirror * thrust, with.pressure, with.more, with.between,
                         with.modulus, with.steps));
}

/// Resultant of the effective pressure, from the heel.
double centre_of(const analysis::ContactResult& base, double mirror) {
  double moment = 0.0;
  for (const analysis::PairResult& pair : base.pairs)
    moment += (0.5 * width + mirror * pair.position.x()) * pair.normal_force;
  return moment / base.normal_force;
}

class EnteringWater : public testing::TestWithParam<double> {};

TEST_P(EnteringWater, MakesTheCrackLonger) {
  const double p = GetParam(), c = length_of_crack(p), dry = length_of_crack(0.0);
  EXPECT_NEAR(dry, 0.7, 1e-3);
  for (const auto& [between, mirror] :
       {std::pair("floor.top, block.bottom", 1.0), std::pair("block.bottom, floor.top", 1.0),
        std::pair("floor.top, block.bottom", -1.0)}) {
    const auto solution = block({.pressure = p, .between = between, .mirror = mirror});
    for (const Warning& warning : solution.warnings)
      EXPECT_NE(warning.kind, WarningKind::load_without_effect) << warning.text;
    const analysis::ContactResult& base = contact_of(last(solution));
    EXPECT_NEAR(*base.pore_force / p, c, 0.05) << p;
    EXPECT_NEAR(base.normal_force + *base.pore_force, weight, 1e-9 * weight);
    EXPECT_NEAR(last(solution).reactions[0].y(), weight, 1e-9 * weight);
    // From K u of a stiff block that turns by up to 0.06, which is 2e6 times as large.
    EXPECT_NEAR(std::abs(history_of(solution).at("under.force_y")), weight, 1e-7 * weight);
    EXPECT_NEAR(centre_of(base, mirror), width - (width - c) / 3.0, 0.03);
    for (const analysis::PairResult& pair : base.pairs) EXPECT_GE(pair.normal_force, -1e-9 * weight);
  }
}

INSTANTIATE_TEST_SUITE_P(Pressures, EnteringWater, testing::Values(20e3, 60e3, 100e3, 130e3));

// A closed joint takes none of it, one that opens without it all of it on the open part, and the whole base lifts where
// the water under all of it overturns the block: p b^2 / 2 > W b / 2 - H h.
TEST(EnteringWater, OverturnsTheBlockWhereNothingHoldsIt) {
  const double overturning = 2.0 * (0.5 * weight * width - thrust * height) / (width * width);
  EXPECT_EQ(block({.pressure = 0.95 * overturning}).outcome, analysis::Outcome::solved);
  EXPECT_NE(block({.pressure = 1.02 * overturning}).outcome, analysis::Outcome::solved);
  const auto everywhere = block({.pressure = 60e3, .more = "enters: false"});
  EXPECT_NEAR(*contact_of(last(everywhere)).pore_force, 60e3 * width, 1e-6);
  const auto closed = block({.pressure = 60e3, .steps = "[{loads: {weight: 1, thrust: 0.2, water: 1}}]"});
  EXPECT_EQ(*contact_of(last(closed)).pore_force, 0.0);
}

// In parts or at once; and it leaves where the joint closes again.
TEST(EnteringWater, FollowsTheJoint) {
  const auto at_once = block({}), later = block({.steps = "[{loads: {weight: 1, thrust: 1}}, {loads: {water: 1}}]"}),
             in_parts = block({.steps = "[{loads: {weight: 1}}, {increments: 10, loads: {thrust: 1, water: 1}}]"});
  const double expected = *contact_of(last(at_once)).pore_force;
  EXPECT_NEAR(*contact_of(last(later)).pore_force, expected, 1e-9 * weight);
  EXPECT_NEAR(*contact_of(last(in_parts)).pore_force, expected, 1e-9 * weight);
  const auto back = block({.steps = "[{name: push}, {name: back, increments: 3, loads: {thrust: 0}}]"});
  EXPECT_EQ(*contact_of(last(back)).pore_force, 0.0);
  EXPECT_NEAR(contact_of(last(back)).normal_force, weight, 1e-9 * weight);
}

// The largest thrust, with water under all of the base: H h = W b / 2 - p b^2 / 2. The bed is so stiff that the weight
// keeps its arm.
TEST(EnteringWater, TheLimitOfTheThrustHasWaterUnderAllOfTheBase) {
  constexpr double p = 60e3, expected = 0.5 * (weight - p * width) * width / height / thrust;
  const auto solution = block({.pressure = p,
                               .steps = "[{loads: {weight: 1, water: 1}}, {limit: {of: thrust, relative: 1e-3}}]",
                               .modulus = "1e10"});
  ASSERT_TRUE(solution.limit);
  EXPECT_LE(solution.limit->solved, expected);
  EXPECT_GE(solution.limit->beyond, expected);
  EXPECT_LT(solution.limit->beyond, (1.0 + 2e-3) * solution.limit->solved);
}

}  // namespace
}  // namespace scabo::verification::entering
