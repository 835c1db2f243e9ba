// Closed forms of friction on whole models: a pushed block, a wedge, two blocks, a load that goes to and fro. Without
// Poisson's ratio and with shear on its sides, a block under pressure is in one uniform state, so that its joint slips
// all at once.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

void expect_mechanism(const analysis::StaticSolution& solution, const std::string& motion) {
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(solution.reason.find("mechanism: " + motion), std::string::npos) << solution.reason;
}

/// A block under its weight of 2 x 1 x 20 kN, pushed aside by P at mid height.
std::string pushed_block(double P, double friction) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 10e9, poisson: 0.3, density: 2000}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.25}}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  weight: {{gravity: [0, -10]}}
  push: {{on: block.left, force: [{}, 0]}}
contacts:
  joint: {{between: [floor.top, block.bottom], friction: {}}}
steps: [{{name: weight, loads: {{weight: 1}}}}, {{name: push, increments: 2}}]
)",
                     P, friction);
}

TEST(PushedBlock, SlidesAtFrictionTimesWeight) {
  for (double mu : {0.1, 0.4, 0.7}) {
    const auto holds = run(pushed_block(mu * 40e3 * (1.0 - 1e-6), mu));
    EXPECT_NEAR(last(holds).contacts.front().tangential_force, -mu * 40e3 * (1.0 - 1e-6), 1e-6);
    const auto slides = run(pushed_block(mu * 40e3 * (1.0 + 1e-6), mu));
    expect_mechanism(slides, "body 'block': translation along (1, 0)");
    ASSERT_EQ(slides.increments.size(), 3u);  // what was reached before stays
    EXPECT_TRUE(slides.increments.at(1).converged);
    EXPECT_EQ(slides.increments.at(2).halvings, 0);  // no smaller load is tried
  }
}

TEST(PushedBlock, TipsBeforeItSlidesWhereFrictionIsLarge) {  // P h / 2 > W b / 2: P > 2 W
  EXPECT_EQ(run(pushed_block(79.9e3, 3.0)).outcome, analysis::Outcome::solved);
  expect_mechanism(run(pushed_block(80.1e3, 3.0)), "body 'block': rotation about (2, 0)");
}

/// A stiff wedge of half angle alpha, pressed into its notch between two fixed walls by F; at first `gap` from them.
std::string wedge(double alpha, double friction, double F, double gap = 0.0) {
  const double h = 1.0 / std::tan(alpha);  // half width 1
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  wedge:
    material: m
    shape: {{polygon: {{vertices: [[0, 0], [1, {0}], [-1, {0}]], names: {{right: edge_1, top: edge_2, left: edge_3}}}}}}
    mesh: {{size: 0.25}}
  east: {{rigid: true, shape: {{polygon: {{vertices: [[0, 0], [2, 0], [1, {0}]], names: {{face: edge_3}}}}}}}}
  west: {{rigid: true, shape: {{polygon: {{vertices: [[0, 0], [-1, {0}], [-2, 0]], names: {{face: edge_1}}}}}}}}
supports:
  - {{on: east, fix: [x, y]}}
  - {{on: west, fix: [x, y]}}
loads:
  press: {{on: wedge.top, force: [0, {1}]}}
contacts:
  east: {{between: [east.face, wedge.right], friction: {2}, gap: {3}}}
  west: {{between: [west.face, wedge.left], friction: {2}, gap: {3}}}
)",
                     h, -F, friction, gap);
}

// Equilibrium alone: on either side N sin + T cos = F / 2.
TEST(Wedge, PressedInItsForcesBalanceTheLoad) {
  const double F = 1e4;
  for (double alpha : {0.3, 0.6})
    for (double mu : {0.0, 0.2}) {
      const auto solution = run(wedge(alpha, mu, F));
      double vertical = 0.0;
      for (const analysis::ContactResult& side : last(solution).contacts) {
        const double s = std::sin(alpha), c = std::cos(alpha), N = side.normal_force,
                     T = std::abs(side.tangential_force);
        vertical += N * s + T * c;
        EXPECT_LE(T, mu * N * (1.0 + 1e-9));
        if (mu == 0.0) EXPECT_NEAR(N, F / (2.0 * s), 1e-8 * F);
      }
      EXPECT_NEAR(vertical, F, 1e-8 * F);
    }
}

// From a gap that is large beside its deformation (F / E = 1e-5) it slides in: every point moves along its wall by
// about gap / tan(alpha) in the increment, so that T = mu N everywhere and N = F / (2 (sin + mu cos)).
TEST(Wedge, SlidingInItHasItsClosedForm) {
  const double F = 1e4, gap = 1e-2;
  for (double alpha : {0.3, 0.6})
    for (double mu : {0.0, 0.2, 0.5}) {
      const auto solution = run(wedge(alpha, mu, F, gap));
      const double N = F / (2.0 * (std::sin(alpha) + mu * std::cos(alpha)));
      const analysis::IncrementResult& end = last(solution);
      ASSERT_EQ(end.contacts.size(), 2u);
      for (const analysis::ContactResult& side : end.contacts) {
        EXPECT_EQ(side.stick, 0) << alpha << ", mu " << mu << ": " << side.name;
        EXPECT_GT(side.slip, 5) << alpha << ", mu " << mu << ": " << side.name;
        EXPECT_NEAR(side.normal_force, N, 1e-8 * F) << alpha << ", mu " << mu << ": " << side.name;
        EXPECT_NEAR(std::abs(side.tangential_force), mu * N, 1e-8 * F) << alpha << ", mu " << mu << ": " << side.name;
      }
    }
}

// Pulled out, a wedge that friction does not hold (nothing presses it) is a mechanism upwards.
TEST(Wedge, PulledOutIsAMechanism) {
  expect_mechanism(run(wedge(0.5, 0.2, -1e4)), "body 'wedge': translation along (0, 1)");
}

/// Two blocks of weights 20 kN (lower), 10 kN, pushed aside by P at the upper one.
std::string two_blocks(double lower, double upper, double P) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 10e9, poisson: 0.2, density: 1000}}}}
bodies:
  first: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [4, 0.5]}}}}, mesh: {{size: 0.25}}}}
  second: {{material: m, shape: {{rectangle: {{corner: [0, 0.5], size: [4, 0.25]}}}}, mesh: {{size: 0.25}}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [6, 1]}}}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  weight: {{gravity: [0, -10]}}
  push: {{on: second.left, force: [{}, 0]}}
contacts:
  lower: {{between: [floor.top, first.bottom], friction: {}}}
  upper: {{between: [first.top, second.bottom], friction: {}}}
)",
                     P, lower, upper);
}

TEST(TwoBlocks, TheWeakerJointDecides) {
  // Limits: 0.2 x 30 = 6 kN below, 0.5 x 10 = 5 kN above.
  const auto rests = run(two_blocks(0.2, 0.5, 5e3 * (1.0 - 1e-6)));
  EXPECT_NEAR(last(rests).contacts[0].tangential_force, -5e3 * (1.0 - 1e-6), 1e-6);
  EXPECT_NEAR(last(rests).contacts[1].tangential_force, -5e3 * (1.0 - 1e-6), 1e-6);
  const auto upper = run(two_blocks(0.2, 0.5, 5e3 * (1.0 + 1e-6)));
  EXPECT_EQ(upper.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(upper.reason.find("body 'second': translation along (1, 0)"), std::string::npos) << upper.reason;
  EXPECT_EQ(upper.reason.find("body 'first'"), std::string::npos) << upper.reason;
  // 0.1 x 30 = 3 kN below: both go.
  expect_mechanism(run(two_blocks(0.1, 0.5, 3e3 * (1.0 + 1e-6))),
                   "body 'first': translation along (1, 0); body 'second': translation along (1, 0)");
  EXPECT_EQ(run(two_blocks(0.1, 0.5, 3e3 * (1.0 - 1e-6))).outcome, analysis::Outcome::solved);
}

/// A block of 2 x 1 m, thickness 1, E = 1 GPa, nu = 0 on a rigid floor. Its top is held at pressure p by the prescribed
/// displacement `down` and moved to and fro by `drive`, `amplitude`.
std::string driven_block(double p, double mu, double amplitude, const std::string& loads, const std::string& steps) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-2, -1], size: [6, 1]}}}}}}
supports:
  - {{on: floor, fix: [x, y]}}
  - {{on: block.top, displacement: [null, {}], name: down}}
  - {{on: block.top, displacement: [{}, null], name: drive}}
{}
contacts:
  joint: {{between: [floor.top, block.bottom], friction: {}}}
steps: {}
)",
                     -p / 1e9, amplitude, loads, mu, steps);
}

/// It slides as one: uniform shear, so that it yields at gamma G = mu p.
std::string cyclic(double p, double mu, double amplitude, int parts) {
  std::string steps = "[{name: press, loads: {down: 1}}";
  double factor = 0.0;
  for (double to : {1.0, -1.0, 1.0, -1.0, 1.0}) {
    steps += fmt::format(", {{name: to_{:.0f}_{}, increments: {}, loads: {{down: 1, drive: {}}}}}", to, steps.size(),
                         parts * (factor == 0.0 ? 1 : 2), to);
    factor = to;
  }
  return driven_block(p, mu, amplitude, "", steps + "]");
}

/// The same with the shear of the block on its sides as well: one uniform state, which slides as a whole at tau = mu p,
/// and not before the drive has gone u_y = tau h / G. Every step ends where the law has a corner.
std::string uniform_cycle(double p, double mu, double amplitude, int parts) {
  const double tau = mu * p, yield = tau / 0.5e9 / amplitude;
  std::string steps = fmt::format("[{{name: press, increments: {}, loads: {{down: 1}}}}", parts);
  const auto go = [&](double drive, double shear) {
    steps += fmt::format(", {{increments: {}, loads: {{down: 1, drive: {:.17g}, left: {}, right: {}}}}}", parts, drive,
                         shear, shear);
  };
  go(yield, 1.0), go(1.0, 1.0);
  for (int cycle = 0; cycle < 2; ++cycle)
    go(1.0 - 2.0 * yield, -1.0), go(-1.0, -1.0), go(2.0 * yield - 1.0, 1.0), go(1.0, 1.0);
  return driven_block(p, mu, amplitude,
                      fmt::format("loads: {{left: {{on: block.left, traction: [0, {}]}}, right: {{on: block.right, "
                                  "traction: [0, {}]}}}}",
                                  -tau, tau),
                      steps + "]");
}

// It slides on while the pressure rises to three times: friction takes the mean of its bounds, 2 mu p, over the slip,
// which is what the drive goes less what the block shears meanwhile.
TEST(CyclicLoad, FrictionUnderRisingPressureTakesTheMeanOfItsBounds) {
  const double p = 1e6, mu = 0.3, A = 2e-3, tau = mu * p, shear = tau / 0.5e9, area = 2.0;
  const std::string steps = fmt::format(
      "[{{loads: {{down: 1}}}}, {{loads: {{drive: {:.17g}, left: 1, right: 1}}}}, {{loads: {{drive: 1}}}}, "
      "{{loads: {{down: 3, drive: 2, left: 3, right: 3}}}}]",
      shear / A);
  const auto solution =
      run(driven_block(p, mu, A,
                       fmt::format("loads: {{left: {{on: block.left, traction: [0, {}]}}, right: {{on: block.right, "
                                   "traction: [0, {}]}}}}",
                                   -tau, tau),
                       steps));
  last(solution);
  ASSERT_EQ(solution.increments.size(), 4u);
  const double before = increment_at(solution, 2).energy.friction, after = increment_at(solution, 3).energy.friction;
  EXPECT_NEAR(before, tau * area * (A - shear), 1e-9 * after);
  EXPECT_NEAR(after - before, 2.0 * tau * area * (A - 2.0 * shear), 1e-9 * after);
}

// Work of the loads, stored energy and dissipation at every corner of the loop and between, to 1e-10 of the work; the
// loop takes 4 tau (A - u_y) over the joint of 2 m2.
TEST(CyclicLoad, HysteresisLoopAndEnergyBalance) {
  const double p = 1e6, mu = 0.3, A = 2e-3, tau = mu * p, yield = tau / 0.5e9, volume = 2.0, area = 2.0;
  for (int parts : {1, 3}) {
    const auto solution = run(uniform_cycle(p, mu, A, parts));
    last(solution);
    ASSERT_EQ(solution.increments.size(), static_cast<std::size_t>(11 * parts));
    const double work = solution.increments.back().energy.external;
    for (const analysis::IncrementResult& increment : solution.increments)
      EXPECT_NEAR(increment.energy.external, increment.energy.elastic + increment.energy.friction, 1e-10 * work);
    double dissipated = 0.0;
    for (int step = 1; step <= 11; ++step) {
      const analysis::IncrementResult& end = solution.increments.at(static_cast<std::size_t>(step * parts - 1));
      const analysis::ContactResult& joint = end.contacts.front();
      const double shear = step == 1 ? 0.0 : step <= 3 || (step - 4) % 4 >= 2 ? tau : -tau;
      if (step == 3) dissipated += tau * area * (A - yield);
      if (step > 3 && step % 2 == 1) dissipated += tau * area * 2.0 * (A - yield);
      EXPECT_NEAR(joint.normal_force, p * area, 1e-10 * p * area) << step;
      EXPECT_NEAR(joint.tangential_force, -shear * area, 1e-9 * tau * area) << step;
      EXPECT_NEAR(end.energy.elastic, 0.5 * volume * (p * p / 1e9 + shear * shear / 0.5e9), 1e-9 * work) << step;
      EXPECT_NEAR(end.energy.friction, dissipated, 1e-9 * work) << step;
    }
    EXPECT_NEAR(dissipated, tau * area * (A - yield) + 2.0 * 4.0 * tau * area * (A - yield), 1e-9 * work);
  }
}

// In increments so coarse that slip turns within one, friction still takes and never gives.
TEST(CyclicLoad, FrictionNeverGivesEnergyBack) {
  for (int parts : {1, 2, 3}) {
    // Pressed less while it is driven back: the force before is along the slip and larger than that at the end.
    const auto solution = run(cyclic(1e6, 0.3, 2e-3, parts),
                              {"steps.2.loads={down: 0.3, drive: -1}", "steps.4.loads={down: 0.5, drive: -0.7}"});
    last(solution);
    double before = 0.0;
    for (const analysis::IncrementResult& increment : solution.increments) {
      EXPECT_GE(increment.energy.friction, before - 1e-12 * increment.energy.external)
          << parts << ": " << increment.step_name;
      before = increment.energy.friction;
    }
  }
}

// The loop closes: the second cycle begins and ends with the same forces, and takes as much as the first.
TEST(CyclicLoad, HysteresisLoopCloses) {
  const auto solution = run(cyclic(1e6, 0.3, 2e-3, 8));
  const auto at = [&](std::size_t reversal) -> const analysis::IncrementResult& {
    return solution.increments.at(8 + 16 * reversal);
  };
  last(solution);
  const double force = at(0).contacts.front().tangential_force;
  for (std::size_t k = 0; k <= 4; ++k)
    EXPECT_NEAR(at(k).contacts.front().tangential_force, k % 2 == 0 ? force : -force, 1e-8 * std::abs(force)) << k;
  const double first = at(2).energy.friction - at(0).energy.friction,
               second = at(4).energy.friction - at(2).energy.friction;
  EXPECT_NEAR(second, first, 1e-9 * first);
}

}  // namespace
}  // namespace scabo::verification
