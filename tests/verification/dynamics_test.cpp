// Steps in time (docs/methods/23_dynamics.md): closed forms, balance of energy, twins.
#include "dynamics.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scabo/analysis/state/quantities.hpp"

namespace scabo::verification {
namespace {

using analysis::ContactResult;
using analysis::IncrementResult;
using analysis::StaticSolution;

// A bar of length 10 (E = 900, density 1: waves of 30) flies against a wall, gap 5, at a speed of 10 (Doyen, Ern,
// Piperno 2011): contact from .5 to 1.16667, force E v / c = 300; it leaves at the speed at which it came.
std::string bar_on_a_wall(int parts) {
  return fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{bar: {{young: 900, poisson: 0, density: 1}}}}
bodies:
  wall: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [1, 3]}}}}}}
  bar: {{material: bar, shape: {{rectangle: {{corner: [5, 0], size: [10, 1]}}}}, mesh: {{kind: fem, size: {}, order: 1}}}}
supports: [{{on: wall, fix: [x, y]}}]
initial: [{{on: bar, velocity: [-10, 0]}}]
contacts: {{hit: {{between: [wall.right, bar.left], friction: 0}}}}
steps: [{{dynamic: {{duration: 1.5, step: {}}}, increments: 90}}]
)",
                     10.0 / parts, 0.5 * (10.0 / parts) / 30.0);
}

TEST(Dynamics, ABarHitsAWall) {
  double error_before = 0.0;
  for (const int parts : {20, 40}) {
    const StaticSolution solution = run(bar_on_a_wall(parts));
    expect_balanced(solution);
    double impulse = 0.0, in_middle = 0.0;
    int count = 0;
    for (const IncrementResult& at : solution.increments) {
      const double force = at.contacts[0].normal_force;
      impulse += force * 1.5 / 90.0;
      if (*at.time < 0.4999 || *at.time > 1.3) {
        EXPECT_EQ(force, 0.0) << *at.time;
      }
      if (*at.time > 0.6 && *at.time < 1.0) in_middle += force, ++count;
    }
    EXPECT_NEAR(in_middle / count, 300.0, 1.5);
    EXPECT_NEAR(impulse, 200.0, 6.0);
    const analysis::Energy& energy = solution.increments.back().energy;
    const double error = std::abs(energy.kinetic + energy.elastic - 500.0);
    EXPECT_LT(error, 0.02 * 500.0);
    if (error_before > 0.0) EXPECT_LT(error, 0.75 * error_before);
    error_before = error;
  }
}

// Supports on both sides of a pair move apart, which is a gap; towards each other they would press the bodies into each
// other.
TEST(Dynamics, SupportsDoNotPressPointsIntoEachOther) {
  const auto model = [](double towards) {
    return fmt::format(R"(
scabo: 1
analysis: {{type: dynamic}}
materials: {{stone: {{young: 1e9, poisson: 0.2, density: 2000}}}}
bodies:
  low: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {{size: 0.5}}}}
  high: {{material: stone, shape: {{rectangle: {{corner: [0, 1], size: [1, 1]}}}}, mesh: {{size: 0.5}}}}
supports:
  - {{on: low.top, fix: [x, y]}}
  - {{name: moving, on: high.bottom, displacement: [0, {}]}}
contacts: {{joint: {{between: [low.top, high.bottom], friction: 0.5}}}}
curves: {{slowly: {{table: [[0, 0], [1, 1]]}}}}
steps: [{{dynamic: {{duration: 1, step: 0.05}}, loads: {{moving: slowly}}, increments: 2}}]
)",
                       towards);
  };
  EXPECT_EQ(run(model(0.01)).outcome, analysis::Outcome::solved);
  EXPECT_THROW(run(model(-0.01)), InputError);
}

// A slender rod that contact alone holds goes from rest into motion, though the gaps that follow from its displacements
// have their rounding errors. An interference that no step at rest has resolved is refused.
TEST(Dynamics, WhatContactAloneHoldsGoesFromRestIntoMotion) {
  const auto model = [](double gap, const std::string& rest) {
    return fmt::format(R"(
scabo: 1
analysis: {{plane: stress, thickness: 0.5{}}}
materials: {{rod: {{young: 100, poisson: 0, density: 1}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [8, 1]}}}}}}
  rod: {{material: rod, shape: {{rectangle: {{corner: [0, 0], size: [6, 0.2]}}}}, mesh: {{kind: fem, size: 0.2, order: 1}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads: {{press: {{on: rod.top, pressure: 2}}}}
contacts: {{base: {{between: [floor.top, rod.bottom], friction: 0.2, gap: {}}}}}
steps:
{}  - {{name: stay, dynamic: {{duration: 0.1, step: 0.02}}, increments: 1}}
)",
                       rest.empty() ? ", type: dynamic" : "", gap, rest);
  };
  for (const double gap : {0.0, -1e-3}) {
    const StaticSolution solution = run(model(gap, "  - {name: press}\n"));
    ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
    EXPECT_NEAR(last(solution).contacts[0].normal_force, 6.0, 1e-6);
  }
  EXPECT_THROW(run(model(-1e-3, "")), InputError);
}

// A rigid block on a bed without mass, stiff enough to be rigid too, under a ground acceleration.
std::string block_on_ground(const std::string& curve, double shaken, double step) {
  return fmt::format(R"(
scabo: 1
analysis: {{plane: stress}}
materials: {{rock: {{young: 1e12, poisson: 0.2, density: 0}}}}
bodies:
  block: {{rigid: true, density: 1000, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}}}
  ground: {{material: rock, shape: {{rectangle: {{corner: [-0.5, -1], size: [3, 1]}}}}, mesh: {{size: 0.5, order: 1}}}}
supports: [{{on: ground.bottom, fix: [x, y]}}]
loads: {{weight: {{on: block, force: [0, -19620]}}}}
contacts: {{base: {{between: [ground.top, block.bottom], friction: 0.3}}}}
curves: {{quake: {{{0}}}}}
steps:
  - {{name: rest}}
  - {{name: shake, dynamic: {{duration: {1}, step: {2}, ground: {{x: quake}}}}, increments: 50}}
  - {{name: calm, dynamic: {{duration: 0.5, step: {2}}}, increments: 5}}
)",
                     curve, shaken, step);
}

/// Slip of the first pair in contact after every increment.
std::vector<double> slips(const StaticSolution& solution) {
  std::vector<double> slips;
  for (const IncrementResult& at : solution.increments)
    slips.push_back(at.contacts[0].pairs[static_cast<std::size_t>(*at.contacts[0].first_in_contact) - 1].slip);
  return slips;
}

// One cycle of .5 g sin(2 pi t/.5 s), friction .3, g = 9.81: the block slips 24.48784 mm back and .42046 mm are left.
TEST(Dynamics, ABlockSlipsOnAShakingGround) {
  const StaticSolution solution = run(block_on_ground("sine: {amplitude: 4.905, periods: 1}", 0.5, 5e-4));
  expect_balanced(solution);
  const std::vector<double> slip = slips(solution);
  EXPECT_NEAR(*std::min_element(slip.begin(), slip.end()), -24.48784e-3, 3e-6);
  EXPECT_NEAR(slip.back(), 0.42046e-3, 3e-6);
  EXPECT_LT(solution.increments.back().energy.kinetic, 1e-12);
  EXPECT_NEAR(solution.increments.back().contacts[0].normal_force, 19620.0, 1e-3);
}

// A pulse of .5 g for .25 s, which the curve begins and ends at once: V^2/(2 g) (1/mu - 1/A), V = .5 g .25 s.
TEST(Dynamics, ABlockSlipsUnderAPulse) {
  const StaticSolution solution =
      run(block_on_ground("table: [[0, 4.905], [0.25, 4.905], [0.25, 0], [0.5, 0]]", 0.5, 1e-3));
  expect_balanced(solution);
  const double V = 4.905 * 0.25;
  EXPECT_NEAR(slips(solution).back(), -V * V / (2.0 * 9.81) * (1.0 / 0.3 - 1.0 / 0.5), 2e-5);
}

/// A wall of rigid blocks 1 x 0.5 m in running bond on a rigid floor, under its weight, then ground that accelerates.
std::string rigid_wall(int columns, int courses, const std::string& curve, double duration) {
  std::string bodies, loads, contacts, weights;
  std::vector<std::pair<double, double>> below;
  for (int z = 0; z < courses; ++z) {
    std::vector<std::pair<double, double>> spans;
    for (double x = z % 2 == 0 ? 0.0 : -0.5; x < columns; x += 1.0)
      spans.emplace_back(std::max(x, 0.0), std::min(x + 1.0, static_cast<double>(columns)));
    const auto add = [&](const std::string& a, const std::string& b) {
      contacts += fmt::format("  {}_{}: {{between: [{}, {}], friction: 0.6}}\n", a.substr(0, a.find('.')),
                              b.substr(0, b.find('.')), a, b);
    };
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const auto [left, right] = spans[k];
      const std::string name = fmt::format("b{}x{}", z, k);
      bodies += fmt::format(
          "  {}: {{rigid: true, density: 2000, shape: {{rectangle: {{corner: [{}, {}], size: [{}, 0.5]}}}}}}\n", name,
          left, 0.5 * z, right - left);
      loads += fmt::format("  w{}x{}: {{on: {}, force: [0, {}]}}\n", z, k, name, -9810.0 * (right - left));
      weights += fmt::format("{}w{}x{}: 1", weights.empty() ? "" : ", ", z, k);
      if (k > 0) add(fmt::format("b{}x{}.right", z, k - 1), name + ".left");
      if (z == 0) add("floor.top", name + ".bottom");
      for (std::size_t j = 0; z > 0 && j < below.size(); ++j)
        if (std::min(right, below[j].second) > std::max(left, below[j].first))
          add(fmt::format("b{}x{}.top", z - 1, j), name + ".bottom");
    }
    below = std::move(spans);
  }
  return fmt::format(R"(
scabo: 1
bodies:
  floor: {{rigid: true, density: 2000, shape: {{rectangle: {{corner: [-1, -1], size: [{}, 1]}}}}}}
{}supports: [{{on: floor.bottom, fix: [x, y]}}]
loads:
{}contacts:
{}curves: {{quake: {{{}}}}}
steps:
  - {{name: rest, loads: {{{}}}}}
  - {{name: shake, dynamic: {{duration: {}, step: 2e-3, ground: {{x: quake}}}}, increments: 10}}
)",
                     columns + 2, bodies, loads, contacts, curve, weights, duration);
}

/// Normal and tangential force on all stones of the first course.
Vec2 force_of_base(const StaticSolution& solution, const IncrementResult& at) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t c = 0; c < at.contacts.size(); ++c)
    if (solution.model.contacts[c].name.starts_with("floor"))
      sum += Vec2(at.contacts[c].normal_force, at.contacts[c].tangential_force);
  return sum.cwiseAbs();
}

// 16 t under 1 m/s2: nothing moves against the ground, all energies are rounding, and every step is solved.
TEST(Dynamics, AWallThatSticksToItsGroundStaysAtRest) {
  const StaticSolution solution = run(rigid_wall(4, 4, "table: [[0, 1], [0.05, 1]]", 0.05));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  for (const IncrementResult& at : solution.increments) {
    for (const ContactResult& contact : at.contacts)
      for (const analysis::PairResult& pair : contact.pairs) EXPECT_LE(std::abs(pair.slip), 1e-11);
    EXPECT_LE(at.certificate.worst(), 1e-10);
    if (at.time) EXPECT_NEAR(force_of_base(solution, at)[1], 16e3, 1e-6 * 16e3);
  }
}

// The same of 100 blocks under ground that shakes by .2 mm: the forces of the joints are far from unique, and where
// they are small the certificate allows slips of 1e-10 m in each of the 25 steps.
TEST(Dynamics, AWallThatSticksToShakingGroundStaysAtRest) {
  const StaticSolution solution = run(rigid_wall(10, 10, "sine: {amplitude: 3, periods: 1}", 0.05));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  for (const IncrementResult& at : solution.increments) {
    for (const ContactResult& contact : at.contacts)
      for (const analysis::PairResult& pair : contact.pairs) EXPECT_LE(std::abs(pair.slip), 1e-9);
    EXPECT_LE(at.certificate.worst(), 1e-10);
    if (at.time) EXPECT_NEAR(force_of_base(solution, at)[0], 981e3, 1e-6 * 981e3);
  }
}

// Under 8 m/s2 a wall slides on its base; its blocks turn a little, so that it presses a little more than its weight.
TEST(Dynamics, AWallOfRigidBlocksSlidesOnItsGround) {
  const StaticSolution solution = run(rigid_wall(10, 10, "table: [[0, 8], [0.02, 8]]", 0.02));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  for (const IncrementResult& at : solution.increments)
    if (at.time) EXPECT_LT(at.certificate.energy_balance, 1e-9);
  const Vec2 force = force_of_base(solution, solution.increments.back());
  EXPECT_NEAR(force[0], 981e3, 0.02 * 981e3);
  EXPECT_NEAR(force[1], 0.6 * force[0], 1e-9 * force[0]);
}

// Impulse and momentum: what the wall gives to the bar changes the velocity of its centroid, and nothing else does.
// Forces are means of time steps, here of all.
TEST(Dynamics, TheImpulseOfTheWallIsTheMomentumOfTheBar) {
  const StaticSolution solution = run(bar_on_a_wall(20), {"solver={halvings: 0}", "steps.0.increments=180"});
  expect_balanced(solution);
  double impulse = 0.0;
  for (const IncrementResult& at : solution.increments) {
    impulse += at.contacts[0].normal_force * 1.5 / 180.0;
    double momentum = 0.0;
    for (const mesh::Cell& cell : solution.mesh.bodies[1].cells)
      for (const mesh::LineElement& side : cell.boundary)
        momentum += at.fields.velocities[1][2 * side.nodes.front()] / (4.0 * 40.0) * 10.0;
    EXPECT_NEAR(momentum, -100.0 + impulse, 1e-9 * 100.0) << *at.time;
  }
  EXPECT_GT(impulse, 190.0);
}

// GetFEM's bar: u = (1 - x)/2 at first, E = density = length = 1, fixed at x = 1, wall at x = 0: the period is 3 and
// the pressure 1/2 for 1 < t < 2.
TEST(Dynamics, ABarThatIsLetGoHitsAgainAndAgain) {
  const StaticSolution solution = run(R"(
scabo: 1
analysis: {plane: stress}
materials: {bar: {young: 1, poisson: 0, density: 1}}
bodies:
  bar: {material: bar, shape: {rectangle: {corner: [0, 0], size: [1, 0.1]}}, mesh: {kind: fem, size: 0.02, order: 1}}
  wall: {rigid: true, shape: {rectangle: {corner: [-0.5, -0.5], size: [0.5, 1]}}}
supports:
  - {on: wall, fix: [x, y]}
  - {on: bar.right, fix: [x, y]}
loads: {pull: {on: bar.left, traction: [0.5, 0]}}
contacts: {hit: {between: [wall.right, bar.left], friction: 0}}
steps:
  - {name: pull}
  - {name: go, dynamic: {duration: 6, step: 0.01}, loads: {pull: 0}, increments: 120}
)");
  expect_balanced(solution);
  double sum = 0.0;
  int count = 0;
  for (const IncrementResult& at : solution.increments) {
    if (!at.time) continue;
    const double phase = std::fmod(*at.time, 3.0), force = at.contacts[0].normal_force;
    if (*at.time > 1.2 && *at.time < 1.8) sum += force, ++count;
    if (phase > 0.02 && phase < 0.9) EXPECT_EQ(force, 0.0) << *at.time;
  }
  EXPECT_NEAR(sum / count, 0.05, 5e-4);
  const analysis::Energy& end = solution.increments.back().energy;
  EXPECT_NEAR(end.kinetic + end.elastic, 0.0125, 0.015 * 0.0125);
}

// An elastic block on an elastic bed without mass, 3 g for 1 s: its energy above that at rest, motion, strain and
// height, is never more than 1.001 times that at the end of the shaking.
TEST(Dynamics, ABedWithoutMassGivesNoEnergy) {
  for (const double step : {5e-4, 1e-3, 2e-3}) {
    const StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials:
  stone: {{young: 1e9, poisson: 0.2, density: 2400}}
  bed: {{young: 2e9, poisson: 0.2, density: 0}}
bodies:
  block: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [2, 2]}}}}, mesh: {{kind: fem, size: 0.5, order: 1}}}}
  bed: {{material: bed, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}, mesh: {{kind: fem, size: 0.5, order: 1}}}}
supports: [{{on: bed.bottom, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -9.81], on: block}}}}
contacts: {{base: {{between: [bed.top, block.bottom], friction: 0.5}}}}
curves: {{quake: {{sine: {{amplitude: 29.43, periods: 5}}}}}}
steps:
  - {{name: rest}}
  - {{name: shake, dynamic: {{duration: 1, step: {0}, ground: {{x: quake}}}}, increments: 4}}
  - {{name: after, dynamic: {{duration: 1, step: {0}}}, increments: 100}}
)",
                                                    step));
    expect_balanced(solution);
    const auto energy = [&](const IncrementResult& at) {
      double height = 0.0;  // of the centroid
      for (const mesh::Cell& cell : solution.mesh.bodies[0].cells)
        for (const mesh::LineElement& side : cell.boundary)
          height += at.fields.displacements[0][2 * side.nodes.front() + 1] / (4.0 * 16.0);
      return at.energy.kinetic + at.energy.elastic + 4.0 * 2400.0 * 9.81 * height;
    };
    const double rest = energy(solution.increments[0]), shaken = energy(increment_at(solution, 4)) - rest;
    EXPECT_GT(shaken, 1e3);
    for (std::size_t i = 5; i < solution.increments.size(); ++i)
      EXPECT_LT(energy(solution.increments[i]) - rest, 1.001 * shaken) << step << ' ' << i;
  }
}

// Loads that grow slowly do what they do at rest.
TEST(Dynamics, SlowLoadingIsStatic) {
  const auto model = [](const std::string& step) {
    return R"(
scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 1e9, poisson: 0.2, density: 2000, damping: {ratio: 0.5, between: [100, 400]}}}
bodies:
  low: {material: stone, shape: {rectangle: {corner: [0, 0], size: [1, 0.5]}}, mesh: {size: 0.25, order: 2}}
  high: {material: stone, shape: {rectangle: {corner: [0, 0.5], size: [1, 0.5]}}, mesh: {size: 0.25, order: 2}}
supports: [{on: low.bottom, fix: [x, y]}]
loads:
  press: {on: high.top, pressure: 1e6}
  push: {on: high.left, traction: [0.3e6, 0]}
contacts: {joint: {between: [low.top, high.bottom], friction: 0.6}}
curves: {slowly: {table: [[0, 0], [1, 1], [1.2, 1]]}}
steps:
  - {name: press, loads: {press: 1}}
)" + step;
  };
  const StaticSolution in_time =
                           run(model("  - {name: push, dynamic: {duration: 1.2, step: 2e-3}, loads: {push: slowly}, "
                                     "increments: 6}\n")),
                       at_rest = run(model("  - {name: push, loads: {push: 1}, increments: 10}\n"));
  expect_balanced(in_time);
  const ContactResult &moved = in_time.increments.back().contacts[0], &rested = at_rest.increments.back().contacts[0];
  EXPECT_NEAR(moved.normal_force, rested.normal_force, 1e-4 * rested.normal_force);
  EXPECT_NEAR(moved.tangential_force, rested.tangential_force, 1e-4 * rested.normal_force);
  EXPECT_NEAR(moved.max_pressure, rested.max_pressure, 1e-4 * rested.max_pressure);
  const Vector &u = in_time.increments.back().fields.displacements[1],
               &v = at_rest.increments.back().fields.displacements[1];
  EXPECT_LT((u - v).lpNorm<Eigen::Infinity>(), 1e-4 * v.lpNorm<Eigen::Infinity>());
}

// Bodies that fly and turn: velocity of the centroid, and rotation times the arm of the point.
TEST(Dynamics, VelocitiesOfPoints) {
  const StaticSolution solution = run(R"(
scabo: 1
analysis: {type: dynamic, plane: stress}
materials: {rubber: {young: 5e6, poisson: 0.45, density: 1100}}
bodies:
  bar: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.25}}
  stone: {rigid: true, density: 2000, shape: {rectangle: {corner: [5, 0], size: [1, 1]}}}
  far: {rigid: true, shape: {rectangle: {corner: [5, 9], size: [1, 1]}}}
supports: [{on: far, fix: [x, y]}]
contacts: {never: {between: [stone.top, far.bottom], friction: 0}}
initial: [{on: bar, velocity: [-1, 0.5], rotation: 2}, {on: stone, velocity: [0, 1], rotation: 3}]
steps: [{dynamic: {duration: 0.01, step: 1e-3}, increments: 1}]
output: {history: {a: bar.bottom_left.vx, b: bar.bottom_left.vy, c: stone.bottom_left.vx, d: stone.top_right.vy}}
)");
  const double exact[] = {0.0, -1.5, 1.5, 2.5};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(
        analysis::value_of(solution, last(solution), std::get<model::Quantity>(solution.model.output.history[i].of))
            .value(),
        exact[i], 1e-10);
}

TEST(Dynamics, TenThousandStepsKeepTheEnergy) {
  const StaticSolution solution = run(R"(
scabo: 1
analysis: {type: dynamic, plane: stress}
materials: {bar: {young: 1, poisson: 0, density: 1}}
bodies: {bar: {material: bar, shape: {rectangle: {corner: [0, 0], size: [1, 0.25]}}, mesh: {kind: fem, size: 0.25, order: 1}}}
supports: [{on: bar.left, fix: [x, y]}]
initial: [{on: bar, velocity: [0.1, 0.05], rotation: 0.1}]
steps: [{dynamic: {duration: 1000, step: 0.1}, increments: 20}]
)");
  const double begin = solution.increments.front().energy.external;
  for (const IncrementResult& at : solution.increments)
    EXPECT_NEAR(at.energy.kinetic + at.energy.elastic, begin, 1e-10 * begin);
}

}  // namespace
}  // namespace scabo::verification
