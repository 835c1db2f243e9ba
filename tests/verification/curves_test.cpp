// Factors that follow curves, cycles, and steps that change friction.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "verification/run.hpp"

namespace scabo::verification {
namespace {

/// A block of 2 x 1 on a floor, pressed by 1000 in all, its top driven sideways by `drive` and free upwards.
std::string driven_block(double young, const std::string& rest, double friction = 0.3) {
  return fmt::format(R"(scabo: 1
materials: {{m: {{young: {}, poisson: 0}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [8, 1]}}}}}}
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.25}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.top, displacement: [0.01, null], name: drive}}]
loads: {{press: {{on: block.top, pressure: 500}}}}
contacts: {{base: {{between: [floor.top, block.bottom], friction: {}}}}}
{})",
                     young, friction, rest);
}

TEST(Curve, GivesTheFactorAtEveryIncrement) {
  const auto solution = run(driven_block(1e9, R"(curves:
  saw: {table: [[10, 0], [11, 1], [13, -1], [14, 0.5]]}
  up: {ramp: {from: 1, to: 3, begin: 0.2, end: 0.7}}
  wave: {sine: {amplitude: 0.5, periods: 1.5, mean: 0.5}}
steps:
  - {name: press, loads: {press: 1}}
  - {name: saw, increments: 3, loads: {drive: saw, press: up}}
  - {name: wave, increments: 7, loads: {drive: wave}}
)"));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  const auto saw = [](double s) { return s < 0.25 ? 4 * s : s < 0.75 ? 1 - 4 * (s - 0.25) : -1 + 6 * (s - 0.75); };
  const auto up = [](double s) { return s < 0.2 ? 1.0 : s > 0.7 ? 3.0 : 1 + 4 * (s - 0.2); };
  int corners = 0, peaks = 0;
  for (const analysis::IncrementResult& increment : solution.increments) {
    const double s = increment.reached;
    if (increment.step == 2) {
      EXPECT_NEAR(increment.factors.at("drive"), saw(s), 1e-12) << s;
      EXPECT_NEAR(increment.factors.at("press"), up(s), 1e-12) << s;
      for (const double corner : {0.2, 0.25, 1.0 / 3.0, 2.0 / 3.0, 0.7, 0.75, 1.0})
        corners += std::abs(s - corner) < 1e-12;
    } else if (increment.step == 3) {
      EXPECT_NEAR(increment.factors.at("drive"), 0.5 + 0.5 * std::sin(3.0 * std::numbers::pi * s), 1e-12) << s;
      EXPECT_EQ(increment.factors.at("press"), 3.0);
      peaks += std::abs(std::abs(increment.factors.at("drive") - 0.5) - 0.5) < 1e-12;
    }
    EXPECT_NEAR(contact_of(increment).normal_force, 1000.0 * increment.factors.at("press"), 1e-6);
  }
  EXPECT_EQ(corners, 7);
  EXPECT_EQ(peaks, 3);
}

TEST(Curve, IsFollowedByAutomaticIncrements) {
  const auto solution = run(driven_block(1e9, R"(curves: {saw: {table: [[0, 0], [1, 1], [3, -1], [4, 0]]}}
steps: [{loads: {press: 1}}, {increments: {largest: 0.17}, loads: {drive: saw}}]
)"));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  double least = 0.0, greatest = 0.0;
  for (const analysis::IncrementResult& increment : solution.increments) {
    if (increment.step != 2) continue;
    const double s = increment.reached;
    const double factor = s < 0.25 ? 4 * s : s < 0.75 ? 1 - 4 * (s - 0.25) : -1 + 4 * (s - 0.75);
    EXPECT_NEAR(increment.factors.at("drive"), factor, 1e-12);
    least = std::min(least, increment.factors.at("drive"));
    greatest = std::max(greatest, increment.factors.at("drive"));
  }
  EXPECT_NEAR(least, -1.0, 1e-12);
  EXPECT_NEAR(greatest, 1.0, 1e-12);
}

TEST(Cycles, OfAStiffBlockDissipateTheLoopOfForceAndMotion) {
  // Rigid: it slides by 4 amplitudes in a cycle under mu N, however many increments it has: the force turns before the
  // slip of an increment begins, and does not take from the work that it has two signs.
  for (const int n : {4, 60, 240}) {
    const auto solution = run(driven_block(1e13, fmt::format(R"(curves: {{wave: {{sine: {{amplitude: 1, periods: 1}}}}}}
steps: [{{name: press, loads: {{press: 1}}}}, {{name: cycle, increments: {}, cycles: 3, loads: {{drive: wave}}}}]
)",
                                                             n)));
    ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
    ASSERT_EQ(solution.model.steps.size(), 4u);
    EXPECT_EQ(solution.model.steps[3].name, "cycle_3");
    const double loop = 4 * 0.01 * 0.3 * 1000.0;
    double before = 0.0, work_before = 0.0;
    for (const analysis::IncrementResult& increment : solution.increments) {
      if (increment.reached < 1.0) continue;
      if (increment.step > 2) {
        EXPECT_NEAR(increment.energy.friction - before, loop, 1e-6);
        EXPECT_NEAR(increment.energy.external - work_before, loop, 1e-6);
      }
      before = increment.energy.friction;
      work_before = increment.energy.external;
    }
  }
}

TEST(Cycles, OfAnElasticBlockCloseTheirLoop) {
  // After the first cycle the loop is closed: what the drive puts in, friction takes; less than that of a rigid block,
  // by the elastic displacement of its top before it slides, twice in a cycle.
  const auto solution = run(driven_block(1e6, R"(curves: {wave: {sine: {amplitude: 1, periods: 1}}}
steps: [{name: press, loads: {press: 1}}, {name: cycle, increments: 100, cycles: 3, loads: {drive: wave}}]
)"));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  std::vector<double> friction, loops;
  double area = 0.0, force = 0.0, motion = 0.0;
  for (const analysis::IncrementResult& increment : solution.increments) {
    const double here = 0.01 * increment.factors.at("drive"), now = increment.reactions[1].x();
    area += 0.5 * (force + now) * (here - motion);
    force = now, motion = here;
    if (increment.reached < 1.0 || increment.step == 1) continue;
    friction.push_back(increment.energy.friction);
    loops.push_back(area);
  }
  ASSERT_EQ(friction.size(), 3u);
  const double second = friction[1] - friction[0], third = friction[2] - friction[1], rigid = 4 * 0.01 * 0.3 * 1000.0;
  EXPECT_NEAR(third / second, 1.0, 1e-6);
  EXPECT_NEAR((loops[2] - loops[1]) / third, 1.0, 2e-3);  // the loop by straight pieces
  EXPECT_LT(third, 0.99 * rigid);
  EXPECT_GT(third, 0.8 * rigid);
}

TEST(FrictionOfAStep, LetsABlockGoAtTheAngleOfFriction) {
  // Pushed by a quarter of the pressure: it goes when the coefficient reaches 0.25.
  const std::string text = driven_block(1e9, R"(steps:
  - {name: load, loads: {press: 1, push: 1}}
  - {name: soften, increments: 300, friction: {base: 0.2}}
)",
                                        0.5);
  std::string pushed = text;
  pushed.replace(pushed.find(", {on: block.top, displacement: [0.01, null], name: drive}"),
                 std::string(", {on: block.top, displacement: [0.01, null], name: drive}").size(), "");
  pushed.replace(pushed.find("pressure: 500}"), std::string("pressure: 500}").size(),
                 "pressure: 500}, push: {on: block.top, traction: [125, 0]}");
  const auto solution = run(pushed);
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism) << solution.reason;
  double reached = 0.0;
  for (const analysis::IncrementResult& increment : solution.increments)
    if (increment.step == 2 && increment.converged) reached = increment.reached;
  const double mu = 0.5 + reached * (0.2 - 0.5);
  EXPECT_GE(mu, 0.25 - 1e-9);
  EXPECT_LE(mu, 0.25 + 0.3 / 300 + 1e-9);
  // Friction that grows again holds more.
  std::string back = pushed;
  back.replace(back.find("  - {name: soften"), std::string::npos,
               "  - {name: soften, friction: {base: 0.3}}\n  - {name: harden, friction: {base: 0.9}}\n"
               "  - {name: more, loads: {push: 3}}\n");
  EXPECT_EQ(run(back).outcome, analysis::Outcome::solved);
}

TEST(FrictionOfAStep, LimitsTheShearOfSlidingPairs) {
  const auto solution = run(driven_block(1e6, R"(steps:
  - {name: press, loads: {press: 1}}
  - {name: drive, increments: 5, loads: {drive: 1}}
  - {name: soften, increments: 4, friction: {base: 0.1}}
)"));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  EXPECT_NEAR(contact_of(increment_at(solution, 5)).tangential_force, -300.0, 1e-6);  // it slides
  for (std::size_t k = 1; k <= 4; ++k) {
    const analysis::IncrementResult& increment = increment_at(solution, 5 + k);
    const double mu = 0.3 - 0.05 * static_cast<double>(k);
    EXPECT_NEAR(contact_of(increment).tangential_force, -1000.0 * mu, 1e-6);
    EXPECT_EQ(increment.factors.at("drive"), 1.0);
  }
}

/// Factors and forces of the increments after the first step.
std::vector<std::array<double, 4>> path_of(const analysis::StaticSolution& solution) {
  EXPECT_LE(last(solution).certificate.worst(), 1e-10);
  std::vector<std::array<double, 4>> path;
  for (const analysis::IncrementResult& increment : solution.increments)
    if (increment.step > 1)
      path.push_back({increment.factors.at("drive"), increment.factors.at("press"), contact_of(increment).normal_force,
                      contact_of(increment).tangential_force});
  return path;
}

void expect_same(const analysis::StaticSolution& one, const analysis::StaticSolution& other) {
  const auto a = path_of(one), b = path_of(other);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) EXPECT_NEAR(a[k][i], b[k][i], i < 2 ? 1e-12 : 1e-7) << k;
}

// The same history in one step, and in several.
TEST(CurveOverSteps, IsTheSameAsInOneStep) {
  const std::string table = "table: [[2, 0], [4, 1], [8, -1], [10, 0.5]]",
                    hold = "ramp: {from: 1, to: 2, begin: 0.25, end: 0.5}", steps = "steps: [{loads: {press: 1}}, ";
  expect_same(run(driven_block(1e6, "curves: {saw: {" + table + "}, rise: {" + hold + "}}\n" + steps +
                                        "{increments: 8, loads: {drive: saw, press: rise}}]\n")),
              run(driven_block(1e6, "curves: {saw: {" + table + ", over: {a: 1, b: 6, c: 1}}, rise: {" + hold +
                                        ", over: {a: 2, b: 12, c: 2}}}\n" + steps +
                                        "{name: a, loads: {drive: saw, press: rise}}, {name: b, increments: 6, loads: "
                                        "{drive: saw, press: rise}}, {name: c, loads: {drive: saw, press: rise}}]\n")));
  const std::string sine = "sine: {amplitude: 0.7, periods: 1.75, mean: 0}";
  expect_same(
      run(driven_block(1e6, "curves: {wave: {" + sine + "}}\n" + steps + "{increments: 12, loads: {drive: wave}}]\n")),
      run(driven_block(1e6, "curves: {wave: {" + sine + ", over: [a, b, c]}}\n" + steps +
                                "{name: a, increments: 4, loads: {drive: wave}}, {name: b, increments: 4, loads: "
                                "{drive: wave}}, {name: c, increments: 4, loads: {drive: wave}}]\n")));
}

// A rigid-like block that is driven to and fro: at the bound mu N all the while, with a friction that one of the steps
// changes. The factor at every increment is that of the table at its time.
TEST(CurveOverSteps, GivesTheFactorAtTheTimeOfItsSteps) {
  const auto solution =
      run(driven_block(1e9, R"(curves: {tide: {table: [[0, 0], [1, 1], [4, -2], [5, 0]], over: {rise: 1, ebb: 4}}}
steps:
  - {name: settle, loads: {press: 1}}
  - {name: rise, increments: 4, loads: {drive: tide}}
  - {name: ebb, increments: 8, loads: {drive: tide}, friction: {base: 0.1}}
)"));
  EXPECT_LE(last(solution).certificate.worst(), 1e-10);
  const auto tide = [](double t) { return t < 1.0 ? t : t < 4.0 ? 1.0 - (t - 1.0) : -2.0 + 2.0 * (t - 4.0); };
  int checked = 0;
  for (const analysis::IncrementResult& increment : solution.increments) {
    if (increment.step == 1) continue;
    const double s = increment.reached, t = increment.step == 2 ? s : 1.0 + 4.0 * s;
    const double mu = increment.step == 2 ? 0.3 : 0.3 - 0.2 * s;
    EXPECT_NEAR(increment.factors.at("drive"), tide(t), 1e-12);
    EXPECT_NEAR(contact_of(increment).tangential_force, (t <= 1.0 || t > 4.0 ? -1.0 : 1.0) * mu * 1000.0, 1e-6) << t;
    ++checked;
  }
  EXPECT_EQ(checked, 12);
}

}  // namespace
}  // namespace scabo::verification
