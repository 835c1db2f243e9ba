// Springs that are softer by far than what contact does: they take no digits from it, or the run says so.
#include <fmt/format.h>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// A block on a floor, pressed and pushed, with a spring of stiffness k along x and y at its corner, or none.
std::string block_with_a_spring(double k) {
  const std::string spring =
      k > 0.0 ? fmt::format("springs: [{{on: block.top_right, k_x: {0}, k_y: {0}}}]\n", k) : std::string();
  return fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{s: {{young: 10e9, poisson: 0.2, density: 2500}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-3, -1], size: [6, 1]}}}}}}
  block: {{material: s, shape: {{rectangle: {{corner: [-1, 0], size: [2, 1]}}}}, mesh: {{kind: fem, size: 0.25}}}}
supports: [{{on: floor, fix: [x, y]}}]
{}loads:
  weight: {{gravity: [0, -9.81]}}
  press: {{on: block.top, pressure: 1e5}}
  push: {{on: block.left, traction: [1e4, 0]}}
contacts: {{base: {{between: [floor.top, block.bottom], friction: 0.3}}}}
)",
                     spring);
}

// The spring takes what it should, k times its displacement, and the rest stays as it is without: contact takes away
// nearly all of the way that the loads would move the block on its spring alone, 25 m with 10 kN/m.
TEST(Springs, SoftOnesBesideAContactTakeNoDigits) {
  const double alone = last(run(block_with_a_spring(0.0))).energy.external;
  for (const double k : {1e6, 1e5, 1e4, 1e3, 1e2}) {
    const auto solution = run(block_with_a_spring(k));
    const analysis::Energy& energy = last(solution).energy;
    EXPECT_NEAR(energy.external, alone, (1e-10 * k + 1e-6) * alone) << k;
    EXPECT_NEAR(energy.external, energy.elastic + energy.friction, 1e-6 * energy.elastic) << k;
  }
}

// A rigid block of 10 kN on an elastic floor, in m and in mm: friction holds the push, and the spring takes next to
// nothing. Gaps count by the way that the loads would move the block on its spring, 10 km, so that contact is solved to
// a smaller tolerance.
TEST(Springs, SoftOnesBesideARigidBlockOnAnElasticFloor) {
  for (const double unit : {1.0, 1e3})
    for (const char* axis : {"k_x", "k_y"})
      for (const double k : {1e4, 1e2, 1.0})
        for (const double push : {0.0, 500.0}) {
          const auto at = [&](double x, double y) { return fmt::format("[{}, {}]", x * unit, y * unit); };
          const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{s: {{young: {}, poisson: 0.2}}}}
bodies:
  floor: {{material: s, shape: {{rectangle: {{corner: {}, size: {}}}}}, mesh: {{size: {}}}}}
  block: {{rigid: true, shape: {{rectangle: {{corner: {}, size: {}}}}}}}
supports: [{{on: floor.bottom, fix: [x, y]}}]
springs: [{{on: block.bottom_left, {}: {}}}]
loads: {{weight: {{on: block, force: [0, -1e4]}}, push: {{on: block.top_right, force: [{}, 0]}}}}
contacts: {{base: {{between: [floor.top, block.bottom], friction: 0.1}}}}
)",
                                                unit, 1e9 / (unit * unit), at(-2, -1), at(4, 1), 0.25 * unit,
                                                at(-0.5, 0), at(1, 1), axis, k / unit, push));
          ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << axis << ", " << k << ": " << solution.reason;
          EXPECT_NEAR(contact_of(last(solution)).normal_force, 1e4, 0.1);
          EXPECT_NEAR(std::abs(contact_of(last(solution)).tangential_force), push, 0.1);
        }
}

// Where no digits are left, the run is not solved and says why.
TEST(Springs, ThatAreTooSoftBesideAContactAreNotSolved) {
  for (const double k : {1.0, 1e-2, 1e-6}) {
    const auto solution = run(block_with_a_spring(k));
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged) << k;
    EXPECT_NE(solution.reason.find("the springs of body 'block' give way "), std::string::npos) << solution.reason;
  }
}

// It is the block, elastic or rigid, not the elastic floor on which it rests, whose side of the contact is as flexible
// as the pair. The message says what was measured.
TEST(Springs, ThatAreTooSoftAreThoseThatAreNamed) {
  for (const bool rigid : {false, true}) {
    std::string model = block_with_a_spring(0.1);
    const auto replace = [&](const std::string& old, const std::string& other) {
      model.replace(model.find(old), old.size(), other);
    };
    replace("{rigid: true,", "{material: s, mesh: {kind: fem, size: 0.5},");
    replace("on: floor,", "on: floor.bottom,");
    if (rigid) {
      replace("block: {material: s,", "block: {rigid: true,");
      replace(", mesh: {kind: fem, size: 0.25}", "");
    }
    const auto solution = run(model);
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
    EXPECT_NE(solution.reason.find("of the displacements, and 3e-05 is allowed"), std::string::npos) << solution.reason;
    EXPECT_NE(solution.reason.find("the springs of body 'block' give way "), std::string::npos) << solution.reason;
  }
}

// A spring that is softer by far than the blocks, and a crack that slips at first and sticks then: gaps count by the
// way that loads would move a block on the spring alone, and those of stiff pairs not at all. With what interior points
// leave of them the forces of the crack were wrong by 14 %, or not taken as a solution. Each tenth of the spring brings
// the forces nearer to those without, by a tenth.
TEST(Springs, BesideACrackInContact) {
  const auto force = [](double k) {
    const auto solution =
        run(fmt::format(R"(
scabo: 1
analysis: {{plane: stress}}
materials: {{stone: {{young: 12e9, poisson: 0.25, density: 2000}}}}
bodies:
  floor: {{material: stone, shape: {{rectangle: {{corner: [-2.4, 1.1], size: [4.8, 1]}}}}, mesh: {{size: 0.25, order: 2}}}}
  left: {{material: stone, shape: {{rectangle: {{corner: [-2.4, 2.1], size: [2.1, 1.2]}}}}, mesh: {{kind: fem, size: 0.35, order: 2}}}}
  right:
    material: stone
    shape: {{rectangle: {{corner: [-0.3, 2.1], size: [2.7, 1.2]}}}}
    mesh: {{kind: polygons, size: 0.35, order: 1}}
    cracks: [{{path: [[1.17, 2.58], [0.89, 2.86]], name: flaw}}]
contacts:
  faces: {{between: [right.flaw.left, right.flaw.right], friction: 0.5}}
  bed_left: {{between: [floor.top, left.bottom], friction: 0.5}}
  bed_right: {{between: [floor.top, right.bottom], friction: 0.5}}
  between: {{between: [left.right, right.left], friction: 0.5}}
supports: [{{on: floor.bottom, fix: [x, y]}}]
{}
loads:
  weight: {{gravity: [0, -9.81]}}
  press: {{on: left.top, pressure: 1e6}}
  push: {{on: right.top, traction: [-27e3, 0]}}
steps:
  - {{name: settle, loads: {{weight: 1, press: 1}}}}
  - {{name: go, loads: {{push: 1}}}}
)",
                        k > 0.0 ? fmt::format("springs: [{{on: left.left, k_n: {}, k_t: 0}}]", k) : ""));
    EXPECT_EQ(contact_of(last(solution)).stick, static_cast<int>(contact_of(last(solution)).pairs.size())) << k;
    const analysis::Energy& energy = increment_at(solution, 0).energy;
    EXPECT_NEAR(energy.external, energy.elastic + energy.friction, 1e-8 * energy.elastic) << k;
    return contact_of(last(solution)).normal_force;
  };
  const double alone = force(0.0), stiff = force(1e6), soft = force(1e5);
  EXPECT_NEAR((alone - soft) / (alone - stiff), 0.1, 1e-3);
  EXPECT_NEAR(soft, alone, 1e-5 * alone);
}

// Ground at rest under its initial stress on a spring: displacements are rounding, and what they say of pairs is
// nothing.
TEST(Springs, UnderBodiesAtRestLoseNothing) {
  const auto solution = run(R"(
scabo: 1
analysis: {plane: strain}
materials: {s: {young: 1e9, poisson: 0.25}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-3, -1], size: [6, 1]}}}
  block: {material: s, shape: {rectangle: {corner: [-1, 0], size: [2, 1]}}, mesh: {kind: polygons, size: 0.3}}
supports: [{on: floor, fix: [x, y]}]
springs: [{on: block.right, k_n: 1e5, k_t: 1e5}]
loads:
  before: {on: block, field: {stress: [0, -1e6, 0]}}
  press: {on: block.top, pressure: 1e6}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}
)");
  EXPECT_NEAR(contact_of(last(solution)).normal_force, 2e6, 1.0);
}

}  // namespace
}  // namespace scabo::verification
