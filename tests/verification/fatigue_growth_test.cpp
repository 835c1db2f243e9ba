// Cracks that grow under cycles of load, against closed forms of the life.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "growth.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

/// An edge crack of length 0.2 in a strip under cycles of tension, and what else the growth says.
analysis::StaticSolution cycled(const std::string& growth, const std::string& more = "") {
  return run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies:
  strip:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [1, 3]}}}}
    mesh: {{kind: quadtree, size: 0.25, order: 3}}
    cracks: [{{path: [[0, 1.5], [0.2, 1.5]], name: flaw}}]
supports: [{{on: strip.bottom, fix: [y]}}, {{on: strip.bottom_left, fix: [x]}}]
loads: {{pull: {{on: strip.top, traction: [0, 50e6]}}{}}}
steps: [{{growth: {{{}}}}}]
)",
                         more, growth));
}

// Life of an edge crack by Paris' law against Simpson's rule over every second state, from the ranges that the run
// reports.
TEST(FatigueGrowth, LifeIsTheIntegralOverTheRangesOfTheRun) {
  const double C = 1e-29, m = 3.0, step = 0.02;
  const auto solution =
      cycled("law: paris, C: 1e-29, m: 3, between: [{pull: 0.1}, {pull: 1}], step: 0.02, until: {length: 0.4}");
  last(solution);
  ASSERT_EQ(solution.increments.size(), 11u);
  double life = 0.0;
  for (std::size_t k = 0; k + 2 < 11; k += 2) {
    const auto slowness = [&](std::size_t i) {
      return 1.0 / (C * std::pow(growth_at(solution, i).tips.at(0).range.value(), m));
    };
    life += 2.0 * step / 6.0 * (slowness(k) + 4.0 * slowness(k + 1) + slowness(k + 2));
  }
  EXPECT_NEAR(growth_at(solution, 10).cycles.value() / life, 1.0, 1e-3);
  const analysis::TipResult& first = growth_at(solution, 0).tips[0];
  EXPECT_NEAR(first.range.value() / (0.9 * first.K_I), 1.0, 1e-9);
  EXPECT_EQ(growth_at(solution, 0).cycles.value(), 0.0);
}

// 105,199.70 cycles (VERIFICATION: Paris' law in the infinite plate, a from 10 to 20 mm, range 100 MPa).
TEST(FatigueGrowth, ACentralCrackByParis) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-2, -2], size: [4, 4]}}
    mesh: {kind: quadtree, size: 0.4, order: 3}
    cracks: [{path: [[-0.01, 0], [0.01, 0]], name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads:
  up: {on: plate.top, traction: [0, 100e6]}
  down: {on: plate.bottom, traction: [0, -100e6]}
steps: [{growth: {law: paris, C: 1e-29, m: 3, between: [{up: 0, down: 0}, {up: 1, down: 1}], step: 2e-3,
         until: {length: 0.04}}}]
)");
  last(solution);
  EXPECT_NEAR(growth_at(solution, solution.increments.size() - 1).cycles.value() / 105199.70, 1.0, 1e-3);
}

/// The same with faces in contact.
std::string in_contact(const std::string& more = "") {
  return "}\ncontacts: {faces: {between: [strip.flaw.left, strip.flaw.right], friction: 0.3}" + more;
}

// A crack that the lowest load closes: the same life as from load 0, to what the faces in contact change of the
// factors.
TEST(FatigueGrowth, FacesThatTouchTakeTheCompressionOfTheCycle) {
  const std::string law = "law: paris, C: 1e-29, m: 3, step: 0.05, until: {length: 0.3}, between: ";
  const auto open = cycled(law + "[{pull: 0}, {pull: 1}]");
  const auto closing = cycled(law + "[{pull: -1}, {pull: 1}]", in_contact());
  last(open), last(closing);
  ASSERT_EQ(closing.increments.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(growth_at(closing, k).tips.at(0).range.value() / growth_at(open, k).tips.at(0).range.value(), 1.0,
                1e-4);
  EXPECT_NEAR(growth_at(closing, 2).cycles.value() / growth_at(open, 2).cycles.value(), 1.0, 3e-4);
}

// A contact that stays open changes nothing: the range of a cycle from a tenth of the load.
TEST(FatigueGrowth, FacesThatStayApartDoNotMatter) {
  const std::string law =
      "law: paris, C: 1e-29, m: 3, step: 0.05, until: {steps: 1}, between: [{pull: 0.1}, {pull: 1}]";
  const auto with = cycled(law, in_contact()), without = cycled(law);
  last(with), last(without);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(growth_at(with, k).tips.at(0).range.value() / growth_at(without, k).tips.at(0).range.value(), 1.0,
                1e-4);
}

// A closed crack under a pressure p that stays and shear from 0 to tau: it slides by tau - mu p, and back only when the
// shear has fallen by 2 mu p, so that mu p is left at no load, and the range of the second cycle is tau - 2 mu p.
TEST(FatigueGrowth, FrictionHasFoundItsCycle) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-100, -100], size: [200, 200]}}
    mesh: {kind: quadtree, size: 20, order: 2}
    cracks: [{path: [[-1, 0], [1, 0]], name: flaw}]
contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 0.3}}
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads:
  top: {on: plate.top, traction: [0, -1e6]}
  bottom: {on: plate.bottom, traction: [0, 1e6]}
  up: {on: plate.top, traction: [1e6, 0]}
  down: {on: plate.bottom, traction: [-1e6, 0]}
  right: {on: plate.right, traction: [0, 1e6]}
  left: {on: plate.left, traction: [0, -1e6]}
steps:
  - {loads: {top: 1, bottom: 1}}
  - loads: {up: 1, down: 1, right: 1, left: 1}
    growth: {criterion: straight, law: paris, C: 1e-29, m: 3, step: 0.1, until: {steps: 1},
             between: [{up: 0, down: 0, right: 0, left: 0}, {up: 1, down: 1, right: 1, left: 1}]}
)");
  last(solution);
  for (std::size_t k = 0; k < 2; ++k) {
    const double a = 1.0 + 0.05 * static_cast<double>(k);
    const analysis::TipResult& tip = growth_at(solution, k + 1).tips.at(1);
    EXPECT_NEAR(std::abs(tip.K_II) / (0.7e6 * std::sqrt(pi * a)), 1.0, 3e-3);
    EXPECT_NEAR(tip.range.value() / (0.4e6 * std::sqrt(pi * a)), 1.0, 5e-3);
  }
}

// Two cracks far from each other: each becomes longer by its own rate, of which the step is the sum.
TEST(FatigueGrowth, EveryTipHasItsOwnRate) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  strip:
    material: steel
    shape: {rectangle: {corner: [0, 0], size: [1, 4]}}
    mesh: {kind: quadtree, size: 0.25, order: 3}
    cracks: [{path: [[0, 1], [0.2, 1]], name: long}, {path: [[0, 3], [0.15, 3]], name: short}]
supports: [{on: strip.bottom, fix: [y]}, {on: strip.bottom_left, fix: [x]}]
loads: {pull: {on: strip.top, traction: [0, 50e6]}}
steps: [{growth: {law: paris, C: 1e-29, m: 3, between: [{pull: 0}, {pull: 1}], step: 0.02, until: {steps: 2}}}]
)");
  last(solution);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<analysis::TipResult>&at = growth_at(solution, k).tips, &after = growth_at(solution, k + 1).tips;
    const auto rate = [&](std::size_t t) { return std::pow(0.5 * (at[t].range.value() + after[t].range.value()), 3); };
    const double grown[] = {after[0].length - at[0].length, after[1].length - at[1].length};
    EXPECT_NEAR(grown[0] + grown[1], 0.02, 1e-9);
    EXPECT_GT(grown[0], 1.3 * grown[1]);
    EXPECT_NEAR(grown[0] / grown[1] / (rate(0) / rate(1)), 1.0, 5e-3);
  }
}

TEST(FatigueGrowth, ABreakEndsIt) {
  const auto solution = cycled(
      "law: walker, C: 1e-29, m: 3, gamma: 0.5, between: [{pull: 0.5}, {pull: 1}], step: 0.05, toughness: {K_Ic: "
      "100e6}");
  last(solution);
  EXPECT_NE(solution.grown->ended.find("the body breaks at 'strip.flaw.end' after"), std::string::npos)
      << solution.grown->ended;
}

TEST(FatigueGrowth, CyclesThatNoLawKnowsEndTheRunWithASentence) {
  const std::string law = "law: paris, C: 1e-29, m: 3, step: 0.02, until: {steps: 1}, between: ";
  const auto reason = [&](const std::string& between, const std::string& more = "") {
    const auto solution = cycled(law + between, more);
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
    return solution.reason;
  };
  EXPECT_NE(reason("[{pull: 1}, {pull: 0.1}]").find("exchange the two"), std::string::npos);
  EXPECT_NE(reason("[{pull: -0.5}, {pull: 1}]").find("overlap by"), std::string::npos);
  EXPECT_NE(reason("[{pull: 0.5, drag: 0}, {pull: 1, drag: 1}]", ", drag: {on: strip.top, traction: [20e6, 0]}")
                .find("turns within a cycle"),
            std::string::npos);
}

}  // namespace
}  // namespace scabo::verification
