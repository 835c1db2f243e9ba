// An increment that fails leaves nothing of itself behind: halved and repeated, it ends where it ends when nothing
// fails.
#include <string>

#include "run.hpp"

namespace scabo::verification {
namespace {

const char* const tower = R"(
scabo: 1
materials: {concrete: {young: 10e9, poisson: 0.2, density: 2000}}
bodies:
  first: {material: concrete, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}
  second: {material: concrete, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.25}}
  third: {material: concrete, shape: {rectangle: {corner: [0, 2], size: [2, 1]}}, mesh: {size: 0.25}}
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
supports: [{on: floor, fix: [x, y]}]
loads:
  weight: {gravity: [0, -10]}
  push: {on: third.left, force: [20e3, 0]}
contacts:
  base: {between: [floor.top, first.bottom], friction: 0.5}
  lower: {between: [first.top, second.bottom], friction: 0.5}
  upper: {between: [second.top, third.bottom], friction: 0.6}
steps:
  - {name: weight, loads: {weight: 1}}
  - {name: push, increments: 4, loads: {push: 1}}
  - {name: release, increments: 4, loads: {push: 0}}
  - {name: lift, increments: 2, loads: {weight: 0}}
)";

TEST(History, BlocksThatOnlyContactHoldsThroughAWholeCycle) {
  const auto solution = run(tower);
  ASSERT_EQ(solution.increments.size(), 11u);
  const analysis::IncrementResult& end = last(solution);
  // Friction keeps what it took: the energy is not given back, and without weight nothing presses any more.
  EXPECT_GT(end.energy.friction, 0.0);
  for (const analysis::ContactResult& contact : end.contacts) EXPECT_NEAR(contact.normal_force, 0.0, 1e-6);
  for (const analysis::IncrementResult& increment : solution.increments)
    EXPECT_GE(increment.energy.friction, -1e-12) << increment.step_name;
}

TEST(History, FailedAttemptsLeaveNothingBehind) {
  const auto easy = run(tower);
  const auto hard = run(tower, {"solver.iterations=1"});  // fails, and is helped by other starts or halved
  ASSERT_EQ(hard.outcome, analysis::Outcome::solved) << hard.reason;
  bool helped = false;
  for (std::size_t k = 0; k < 5; ++k) {
    const analysis::IncrementResult &first = increment_at(easy, k), &second = increment_at(hard, k);
    helped = helped || second.attempts.size() > 1 || second.newton_iterations > 1;
    if (second.halvings > 0) break;  // another path of loading from here on
    for (std::size_t c = 0; c < 3; ++c) {
      const analysis::ContactResult &a = contact_of(first, c), &b = contact_of(second, c);
      EXPECT_NEAR(a.normal_force, b.normal_force, 1e-6 * 120e3);
      EXPECT_NEAR(a.tangential_force, b.tangential_force, 1e-6 * 120e3);
      EXPECT_EQ(a.stick, b.stick);
      EXPECT_EQ(a.slip, b.slip);
    }
  }
  EXPECT_TRUE(helped) << "the test is meant to make Newton's method fail";
}

// Complaint 5 of the design: bodies that touch at zero force.
TEST(History, TouchingAtZeroForce) {
  const auto solution = run(tower, {"loads.weight.gravity=[0, -1e-3]", "loads.push.force=[1e-3, 0]"});
  EXPECT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
}

// Supports lift a block off the floor, which takes no force at all, and set it down again until it is pressed.
TEST(History, SupportsThatMoveABodyWithoutStress) {
  const auto solution = run(R"(
scabo: 1
materials: {m: {young: 1e9, poisson: 0.2}}
bodies:
  block: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}
  floor: {rigid: true, shape: {rectangle: {corner: [-2, -1], size: [5, 1]}}}
supports:
  - {on: floor, fix: [x, y]}
  - {on: block.top, displacement: [1e-3, 1e-3], name: up}
contacts:
  joint: {between: [floor.top, block.bottom], friction: 0}
steps: [{name: lift, increments: 2, loads: {up: 1}}, {name: lower, increments: 4, loads: {up: -1}}]
)");
  for (std::size_t k : {0u, 1u, 2u}) EXPECT_EQ(contact_of(increment_at(solution, k)).open, 17);
  EXPECT_GT(contact_of(increment_at(solution, 5)).normal_force, 1e6);
}

}  // namespace
}  // namespace scabo::verification
