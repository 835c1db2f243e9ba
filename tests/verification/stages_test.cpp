// Staged construction: bodies that are put in place, or taken away, in a step.
#include <fmt/format.h>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Displacement of the boundary node of a body next to a point.
Vec2 displacement_near(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment,
                       std::size_t body, const Vec2& point) {
  const auto& nodes = solution.mesh.bodies[body].nodes;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if ((nodes[i] - point).norm() < (nodes[nearest] - point).norm()) nearest = i;
  return increment.fields.displacements[body].segment<2>(static_cast<Eigen::Index>(2 * nearest));
}

// A column of blocks of height h, placed one by one on a rigid floor, nu = 0 so that every stress is uniaxial. With
// w = rho g h the weight of a block over its area, the top of block i (from 1) after block n > i was placed has gone
// down since its placing by what the blocks placed since, n - i, have compressed blocks 1 ... i, and by the compression
// of block i by its own weight; block i itself was placed on a top that its weight pressed down as well:
//
//     u_i = sum over k <= i of (weights above and in k that came with or after block i) h / modulus
//         = (i - 1) (n - i + 1) w h / modulus  +  (n - i + 1/2) w h / modulus
//
// All at once, it is sum over k <= i of (n - k + 1/2) w h / modulus.
constexpr double modulus = 1e9, rho = 2000.0, g = 10.0, h = 0.5, w = rho * g * h;
constexpr int blocks = 4;

std::string column(const std::string& added, const std::string& steps, double scale = 1.0,
                   const char* friction = "0.5") {
  return fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: {0}, poisson: 0, density: {1}}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{2}, {2}], size: [{3}, {4}]}}}}}}
  block:
    material: stuff
    shape: {{rectangle: {{corner: [0, 0], size: [{4}, {5}]}}}}
    mesh: {{size: {5}}}
    repeat: {{count: 4, step: [0, {5}]}}
    {6}
supports: [{{on: floor, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -10]}}}}
contacts:
  base: {{between: [floor.top, block_1.bottom], friction: {8}}}
  joint_1: {{between: [block_1.top, block_2.bottom], friction: {8}}}
  joint_2: {{between: [block_2.top, block_3.bottom], friction: {8}}}
  joint_3: {{between: [block_3.top, block_4.bottom], friction: {8}}}
steps: [{7}]
output: {{history: {{top: block_4.top_left.uy, second: block_2.top_left.uy}}}}
)",
                     modulus, rho / scale, -scale, 3.0 * scale, scale, h * scale, added, steps, friction);
}
constexpr const char* one_by_one = "{name: first}, {name: lift_2}, {name: lift_3, increments: 3}, {name: lift_4}";
constexpr const char* added_one_by_one = "added: [first, lift_2, lift_3, lift_4]";

TEST(Stages, AColumnBuiltBlockByBlockSettlesUnderWhatComesLater) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const auto solution = run(column(added_one_by_one, one_by_one, scale));
    EXPECT_TRUE(solution.warnings.empty() || solution.warnings.front().text.find("pairs") != std::string::npos)
        << solution.warnings.front().text;
    ASSERT_EQ(last(solution).step, 4);
    const double unit = w * h * scale / modulus;
    for (const analysis::IncrementResult& increment : solution.increments) {
      EXPECT_LE(increment.certificate.worst(), 1e-10);
      if (increment.reached < 1.0) continue;
      const int n = increment.step;
      EXPECT_EQ(increment.absent.size(), static_cast<std::size_t>(blocks - n));
      for (int i = 1; i <= n; ++i) {
        const double down = ((i - 1) * (n - i + 1) + n - i + 0.5) * unit;
        const Vec2 top =
            displacement_near(solution, increment, static_cast<std::size_t>(i), Vec2(0.5 * scale, i * h * scale));
        EXPECT_NEAR(top.y(), -down, 1e-9 * unit) << "block " << i << " of " << n;
        const double force = increment.contacts[static_cast<std::size_t>(i - 1)].normal_force;
        EXPECT_NEAR(force, (n - i + 1) * w * scale, 1e-9 * w * scale);
      }
      for (std::size_t joint = static_cast<std::size_t>(n); joint < 4; ++joint)
        EXPECT_TRUE(increment.contacts[joint].pairs.empty());
      EXPECT_NEAR(increment.energy.external, increment.energy.elastic + increment.energy.friction,
                  1e-9 * std::abs(increment.energy.elastic));
    }
  }
  const auto at_once = run(column("", "{name: all}"));
  double down = 0.0;
  for (int k = 1; k <= blocks; ++k) down += (blocks - k + 0.5) * w * h / modulus;
  EXPECT_NEAR(displacement_near(at_once, last(at_once), 4, Vec2(0.5, 2.0)).y(), -down, 1e-9 * w * h / modulus);
}

// The order of placing does not change the stress, and within a step the weight grows with the increments.
TEST(Stages, TheWeightOfABodyGrowsOverItsStep) {
  const auto solution = run(column(added_one_by_one, one_by_one));
  const auto& third = increment_at(solution, 2);
  EXPECT_EQ(third.step_name, "lift_3");
  EXPECT_NEAR(contact_of(third, 2).normal_force, w / 3.0, 1e-9 * w);
  EXPECT_NEAR(contact_of(third, 0).normal_force, (2.0 + 1.0 / 3.0) * w, 1e-9 * w);
}

// Taken away again, the blocks below come back to where they were, and nothing is left of the one above.
TEST(Stages, ABodyThatIsTakenAwayReleasesWhatCarriedIt) {
  const auto solution = run(column(
      "added: [first, lift_2, lift_3, lift_4]\n    removed: [null, null, back, down]",
      "{name: first}, {name: lift_2}, {name: lift_3}, {name: lift_4}, {name: down, increments: 2}, {name: back}"));
  const double unit = w * h / modulus;
  const auto& half = increment_at(solution, 4);
  EXPECT_NEAR(contact_of(half, 0).normal_force, 3.5 * w, 1e-9 * w);
  EXPECT_TRUE(half.contacts[3].pairs.empty());
  EXPECT_EQ(last(solution).absent, (std::vector<int>{3, 4}));
  EXPECT_NEAR(displacement_near(solution, last(solution), 2, Vec2(0.5, 1.0)).y(), -1.5 * unit, 1e-9 * unit);
  EXPECT_NEAR(displacement_near(solution, last(solution), 1, Vec2(0.5, 0.5)).y(), -1.5 * unit, 1e-9 * unit);
  EXPECT_NEAR(last(solution).energy.external, last(solution).energy.elastic, 1e-9 * last(solution).energy.elastic);
}

// Ground with the stress K0, of two layers that are bonded, rests on a rigid floor between smooth walls. The upper
// layer, of depth d and with a surcharge q, is dug out: the lower one, H high, is relieved of q + gamma d, and rises by
// (q + gamma d) H / M with the constrained modulus M = modulus (1 - nu) / ((1 + nu)(1 - 2 nu)); its horizontal stress
// falls by nu / (1 - nu) times that.
TEST(Stages, GroundRisesByWhatIsDugOut) {
  const double young = 50e6, nu = 0.3, gamma = 20e3, K0 = 0.5, q = 30e3, d = 2.0, H = 3.0;
  const double M = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)), relief = q + gamma * d;
  for (const char* mesh : {"size: 1", "kind: fem, size: 1", "kind: polygons, size: 1"})
    for (const char* increments : {"1", "4", "auto"}) {
      const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{soil: {{young: {0}, poisson: {1}}}}}
bodies:
  low: {{material: soil, shape: {{rectangle: {{corner: [0, -5], size: [4, 3]}}}}, mesh: {{{2}}}}}
  high: {{material: soil, shape: {{rectangle: {{corner: [0, -2], size: [4, 2]}}}}, mesh: {{{2}}}, removed: dig}}
supports:
  - {{on: low.bottom, fix: y}}
  - {{on: low.left, fix: x}}
  - {{on: low.right, fix: x}}
  - {{on: high.left, fix: x}}
  - {{on: high.right, fix: x}}
loads:
  ground: {{field: {{vertical: {{unit_weight: {3}, surface: 0, surcharge: {4}}}, K0: {5}}}}}
  surcharge: {{on: high.top, pressure: {4}}}
contacts: {{layers: {{between: [low.top, high.bottom], bond: true}}}}
steps: [{{name: start}}, {{name: dig, increments: {6}}}]
output: {{points: [[2, -3]]}}
)",
                                            young, nu, mesh, gamma, q, K0, increments));
      const auto& start = increment_at(solution, 0);
      EXPECT_LT(start.fields.displacements[0].lpNorm<Eigen::Infinity>(), 1e-12 * relief * H / M);
      EXPECT_NEAR(contact_of(start).normal_force, 4.0 * relief, 1e-9 * relief);
      EXPECT_NEAR(start.reactions[0].y(), 4.0 * (relief + gamma * H), 1e-9 * relief);
      const auto& end = last(solution);
      const double rise = relief * H / M;
      EXPECT_NEAR(displacement_near(solution, end, 0, Vec2(2.0, -2.0)).y(), rise, 1e-9 * rise) << mesh;
      EXPECT_NEAR(end.reactions[0].y(), 4.0 * gamma * H, 1e-9 * relief);
      const double horizontal = 3.0 * K0 * (relief + 0.5 * gamma * H) - 3.0 * nu / (1.0 - nu) * relief;
      EXPECT_NEAR(end.reactions[1].x(), horizontal, 1e-9 * relief);
      EXPECT_EQ(end.reactions[3].norm(), 0.0);
      EXPECT_EQ(end.fields.displacements[1].lpNorm<Eigen::Infinity>(), 0.0);
      EXPECT_EQ(end.absent, std::vector<int>{1});
    }
}

// A prop under a beam is taken away: what it carried returns to the beam, which then hangs as one that never had a
// prop. Their meshes differ by the nodes at the prop.
TEST(Stages, APropThatIsTakenAwayLeavesTheBeamWithoutOne) {
  const auto model = [](const char* prop, const char* steps) {
    return fmt::format(R"(
scabo: 1
materials: {{steel: {{young: 200e9, poisson: 0.3, density: 7850}}}}
bodies:
  beam: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [4, 0.2]}}}}, mesh: {{size: 0.2, order: 3}}}}
  {}
supports:
  - {{on: beam.left, fix: [x, y]}}
{}
)",
                       prop, steps);
  };
  const auto propped = run(model(
      "prop: {material: steel, shape: {rectangle: {corner: [3.8, -1], size: [0.2, 1]}}, mesh: {size: 0.1}, removed: "
      "strike}",
      "  - {on: prop.bottom, fix: [x, y]}\nloads: {weight: {gravity: [0, -10]}}\ncontacts: {seat: {between: [prop.top, "
      "beam.bottom], friction: 0}}\nsteps: [{name: cast}, {name: strike, increments: 3}]"));
  const auto free = run(model("", "loads: {weight: {gravity: [0, -10]}}"));
  const Vec2 tip(4.0, 0.2);
  const double down = displacement_near(free, last(free), 0, tip).y();
  EXPECT_GT(displacement_near(propped, increment_at(propped, 0), 0, tip).y(), 0.1 * down);
  EXPECT_NEAR(displacement_near(propped, last(propped), 0, tip).y(), down, 1e-3 * std::abs(down));
}

// What stands on a body that is taken away falls, and the message names it.
TEST(Stages, WhatStandsOnWhatIsTakenAwayIsAMechanism) {
  const auto solution = run(column("removed: [null, null, dig, null]", "{name: all}, {name: dig, increments: 2}"));
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(solution.reason.find("step dig, increment 1: mechanism: body 'block_4'"), std::string::npos)
      << solution.reason;
}

// Friction: the slip of a joint counts from the placing of the body above, and what happens before does not count.
TEST(Stages, SlipCountsFromThePlacing) {
  const auto solution =
      run(R"(
scabo: 1
materials: {stuff: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  base: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [5, 1]}}}
  block: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [1, 0.5]}}, mesh: {size: 0.25}, added: place}
supports: [{on: base, displacement: [1e-3, -2e-3], name: drive}]
loads: {weight: {gravity: [0, -10]}}
contacts: {seat: {between: [base.top, block.bottom], friction: 0.5}, floor: {between: [ledge.top, other.bottom], friction: 0.1}}
steps: [{name: move}, {name: place}, {name: back, loads: {drive: 0}}]
)",
          {"bodies.ledge={rigid: true, shape: {rectangle: {corner: [9, -1], size: [5, 1]}}}",
           "bodies.other={material: stuff, shape: {rectangle: {corner: [10, 0], size: [1, 0.5]}}, mesh: {size: 0.25}}",
           "supports=[{on: base, displacement: [1e-3, -2e-3], name: drive}, {on: ledge, fix: [x, y]}]"});
  const auto& placed = increment_at(solution, 1);
  const Vec2 corner(0.0, 0.0);
  EXPECT_LT(std::abs(displacement_near(solution, placed, 1, corner).x()), 1e-5);
  EXPECT_LT(std::abs(displacement_near(solution, placed, 1, corner).y()), 1e-5);
  const Vec2 moved =
      displacement_near(solution, last(solution), 1, corner) - displacement_near(solution, placed, 1, corner);
  EXPECT_LT((moved - Vec2(-1e-3, 2e-3)).norm(), 1e-9);  // carried back by friction, without slip
  EXPECT_NEAR(contact_of(last(solution)).normal_force, 10e3, 1e-5);
}

// Pairs that supports hold on both sides count from the placing as well: the ground has come up by 2 mm before the
// block is placed on it. It may sink by 1 mm then, but not rise by 1 mm, because supports hold the block.
TEST(Stages, HeldPairsCountFromThePlacing) {
  const auto model = [](const char* after) {
    return fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2, density: 2000}}}}
bodies:
  ground: {{material: stuff, shape: {{rectangle: {{corner: [0, -1], size: [1, 1]}}}}, mesh: {{size: 0.5}}}}
  block: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [1, 0.5]}}}}, mesh: {{size: 0.5}}, added: place}}
supports:
  - {{on: ground.top, displacement: [0, 2e-3], name: lift}}
  - {{on: block.bottom, fix: [x, y]}}
loads: {{weight: {{gravity: [0, -10]}}}}
contacts: {{seat: {{between: [ground.top, block.bottom], friction: 0.5}}}}
steps: [{{name: raise}}, {{name: place}}, {{name: more, loads: {{lift: {}}}}}]
)",
                       after);
  };
  last(run(model("0.5")));
  try {
    run(model("1.5"));
    FAIL() << "the block cannot give way";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("keep it at an overlap of 0.001"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scabo::verification
