// Closed cracks that grow, in contact and in friction; without contact their faces overlap, which is told.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "growth.hpp"

namespace scabo::verification {
namespace {

/// An inclined crack at the middle of a wide plate under compression along y, friction 0.3: K_II = 0.35 sqrt(pi) at
/// unit stress, by the stress on its line.
analysis::StaticSolution closed_crack(const std::string& growth) {
  return run(fmt::format(R"(scabo: 1
analysis: {{plane: stress}}
materials: {{stone: {{young: 200, poisson: 0.3}}}}
bodies:
  plate:
    material: stone
    shape: {{rectangle: {{corner: [-50, -50], size: [100, 100]}}}}
    mesh: {{kind: quadtree, size: 10, order: 2, refine: [{{near: [0.7, 0.7], size: 0.025}}, {{near: [-0.7, -0.7], size: 0.025}}]}}
    cracks: [{{path: [[-0.70710678118654752, -0.70710678118654752], [0.70710678118654752, 0.70710678118654752]], name: flaw}}]
contacts: {{faces: {{between: [plate.flaw.left, plate.flaw.right], friction: 0.3}}}}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: [y]}}]
loads:
  up: {{on: plate.top, traction: [0, -1]}}
  down: {{on: plate.bottom, traction: [0, 1]}}
steps: [{{growth: {{{}}}}}]
)",
                         growth));
}
const double K_II_of_closed_crack = 0.35 * std::sqrt(std::numbers::pi);

// Wing cracks: the tips of a closed crack that slides are in pure mode II, and kink by 70.5 degrees of the hoop stress,
// at K_II = (3/4)^1/2 K_Ic. The wings need more load the longer they are, and turn towards it.
TEST(Growth, AClosedCrackGrowsWings) {
  const auto solution = closed_crack("toughness: {K_Ic: 1}, step: 0.1, until: {steps: 2}");
  ASSERT_EQ(last(solution).increment, 3);
  const analysis::GrowthResult& first = growth_at(solution, 0);
  ASSERT_EQ(first.tips.size(), 2u);
  EXPECT_NEAR(first.load_factor * K_II_of_closed_crack / std::sqrt(0.75), 1.0, 2e-3);
  for (const analysis::TipResult& tip : first.tips) {
    EXPECT_TRUE(tip.grows);
    EXPECT_NEAR(tip.kink * 180.0 / pi, 70.5288, 0.1);
    EXPECT_NEAR(tip.K_I, 0.0, 1e-3);
  }
  EXPECT_GT(growth_at(solution, 1).load_factor, 1.1 * first.load_factor);
  EXPECT_GT(growth_at(solution, 2).load_factor, 1.1 * growth_at(solution, 1).load_factor);
  const std::vector<Vec2>& path = path_of(solution);
  ASSERT_EQ(path.size(), 6u);
  const auto from_load = [&](std::size_t k) {  // angle of a segment from the y axis
    const Vec2 along = path[k + 1] - path[k];
    return std::atan2(std::abs(along.x()), along.y());
  };
  EXPECT_LT(from_load(4), 0.9 * from_load(3));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((path[k] + path[5 - k]).norm(), 0.0, 1e-3);
  for (const std::size_t k : {1u, 2u}) {
    const analysis::GrowthResult& at = growth_at(solution, k);
    for (const analysis::TipResult& tip : at.tips) EXPECT_LT(std::abs(tip.K_II), 0.05 * tip.K_I);
    ASSERT_TRUE(at.energy.has_value());
    expect_balance(*at.energy);
    EXPECT_NEAR(at.energy->released / at.energy->integral, 1.0, 0.008);
    const double friction = increment_at(solution, k).energy.friction - increment_at(solution, k - 1).energy.friction;
    EXPECT_GT(friction, 0.0);
    EXPECT_NEAR(at.energy->contact / friction, 1.0, 0.02);
  }
}

// In shear, where the criterion says so: straight on at G = G_c.
TEST(Growth, AClosedCrackGrowsInShear) {
  const auto solution = closed_crack("criterion: straight, toughness: {G_c: 0.005}, step: 0.4, until: {steps: 1}");
  ASSERT_EQ(last(solution).increment, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const double a = 1.0 + 0.2 * static_cast<double>(k);
    EXPECT_NEAR(growth_at(solution, k).load_factor * K_II_of_closed_crack * std::sqrt(a), 1.0, 2e-3);
  }
  EXPECT_NEAR((path_of(solution).back() - Vec2::Constant(1.2 * std::sqrt(0.5))).norm(), 0.0, 1e-9);
}

// A crack whose faces stick has no factors, whatever the load.
TEST(Growth, AClosedCrackThatSticksDoesNotGrow) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [1, 2]}}
    mesh: {kind: quadtree, size: 0.25}
    cracks: [{path: [[0, 0.8], [0.25, 1]], name: flaw}]
contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 2}}
supports: [{on: plate.bottom, fix: [x, y]}]
loads: {push: {on: plate.top, traction: [0, -1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.125}}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("no factor of the scaled loads makes a tip critical"), std::string::npos)
      << solution.reason;
}

// A crack that its load closes is no result.
TEST(Growth, AClosedCrackWithoutContactEndsTheRunWithASentence) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [1, 2]}}
    mesh: {kind: quadtree, size: 0.125}
    cracks: [{path: [[0, 0.8], [0.25, 1]], name: flaw}]
supports: [{on: plate.bottom, fix: [x, y]}]
loads: {push: {on: plate.top, traction: [0, -1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.125}}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("close the crack at its tip 'plate.flaw.end'"), std::string::npos) << solution.reason;
}

// A crack through a bent plate, open at its growing end and overlapping at the other.
TEST(Growth, FacesThatOverlapElsewhereEndTheRunWithASentence) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [4, 1]}}
    mesh: {kind: quadtree, size: 0.25}
    cracks: [{path: [[2, 0.2], [2, 0.85]], name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads: {left: {on: plate.left, moment: 1e3}, right: {on: plate.right, moment: -1e3}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.05, cracks: [plate.flaw.end]}}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("the faces of crack 'plate.flaw' overlap by"), std::string::npos) << solution.reason;
}

}  // namespace
}  // namespace scabo::verification
