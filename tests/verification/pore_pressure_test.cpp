// Pressure in contacts and cracks: a block with uplift slides at mu (W - U) and lifts off at W; water in a joint; a
// crack under pressure.
#include <fmt/format.h>

#include "models.hpp"
#include "run.hpp"

namespace scabo::verification {
namespace {

/// A block 2 x 1 m, 0.5 m thick, of 400 kN on a rigid base, pushed sideways.
analysis::StaticSolution block_with_uplift(const std::string& uplift, double push, double friction = 0.6,
                                           const char* mesh = "size: 0.25") {
  return run(fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.5}}
materials: {{concrete: {{young: 30e9, poisson: 0.2}}}}
bodies:
  base: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
  block: {{material: concrete, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}}}}}
supports: [{{on: base, fix: [x, y]}}]
contacts: {{joint: {{between: [base.top, block.bottom], friction: {}}}}}
loads:
  weight: {{on: block.top, pressure: 400e3}}
  uplift: {}
  push: {{on: {{body: block, near: [0, 0]}}, force: [{:.17g}, 0]}}
)",
                         mesh, friction, uplift, push));
}

TEST(PorePressure, UnderABlockLetsItSlideAtTheEffectiveWeight) {
  const double W = 400e3, U = 150e3, limit = 0.6 * (W - U);
  for (const char* mesh : {"size: 0.25", "size: 0.5, order: 1", "kind: fem, size: 0.3"}) {
    const auto stays = block_with_uplift("{in: joint, pressure: 150e3}", (1.0 - 1e-6) * limit, 0.6, mesh);
    const auto& joint = contact_of(last(stays));
    EXPECT_NEAR(joint.normal_force, W - U, 1e-10 * W);
    EXPECT_NEAR(*joint.pore_force, U, 1e-12 * W);
    EXPECT_LT((last(stays).reactions[0] - Vec2(-(1.0 - 1e-6) * limit, W)).norm(), 1e-10 * W);
    EXPECT_EQ(block_with_uplift("{in: joint, pressure: 150e3}", (1.0 + 1e-6) * limit, 0.6, mesh).outcome,
              analysis::Outcome::mechanism);
  }
}

TEST(PorePressure, LiftsABlockOffAtItsWeight) {
  EXPECT_EQ(block_with_uplift("{in: joint, pressure: 399.99e3}", 0.0).outcome, analysis::Outcome::solved);
  EXPECT_EQ(block_with_uplift("{in: joint, pressure: 400.01e3}", 0.0).outcome, analysis::Outcome::mechanism);
}

// Triangular uplift: half the force, and its moment moves the resultant. U = 60 kN, acting a third of the base from the
// left: the effective resultant is at x = (400 - 60 2/3) / 340.
TEST(PorePressure, ThatFallsAlongTheBaseHasTheRightForceAndMoment) {
  for (const char* uplift : {"{in: joint, pressure: {over: x, at: [0, 2], values: [120e3, 0]}}",
                             "{in: joint, water: {level: 0, unit_weight: 60e3, up: [1, 0]}}"}) {
    const bool water = std::string(uplift).find("water") != std::string::npos;  // zero everywhere: x > 0
    const auto solution = block_with_uplift(uplift, 0.0);
    const auto& joint = contact_of(last(solution));
    const double U = water ? 0.0 : 60e3;
    EXPECT_NEAR(*joint.pore_force, U, 1e-10);
    EXPECT_NEAR(joint.normal_force, 400e3 - U, 1e-9 * 400e3);
    double moment = 0.0;
    for (const analysis::PairResult& pair : joint.pairs) moment += pair.position.x() * pair.normal_force;
    EXPECT_NEAR(moment, 400e3 - U * 2.0 / 3.0, 1e-9 * 400e3);
  }
}

// A drain at x = 0.37 within an element: full pressure to the left of it falls to a third there, then to zero.
TEST(PorePressure, WithADrainWithinAnElementIsExact) {
  const double a = 0.37, p = 120e3;
  // Two trapezoids: 40 kN/m2 and more over a, a triangle to 2 m.
  const double left = 0.5 * (p + p / 3.0) * a, right = 0.5 * p / 3.0 * (2.0 - a);
  const double moment_left = a * a * (p / 3.0 / 2.0 + (p - p / 3.0) / 6.0),
               moment_right = right * (a + (2.0 - a) / 3.0);
  for (const char* mesh : {"size: 0.5, order: 1", "size: 0.5", "kind: fem, size: 0.3"}) {
    const auto solution = block_with_uplift(
        "{in: joint, pressure: {over: x, at: [0, 0.37, 2], values: [120e3, 40e3, 0]}}", 0.0, 0.6, mesh);
    const auto& joint = contact_of(last(solution));
    EXPECT_NEAR(*joint.pore_force, 0.5 * (left + right), 1e-11 * p) << mesh;
    double moment = 0.0;
    for (const analysis::PairResult& pair : joint.pairs) moment += pair.position.x() * pair.normal_force;
    EXPECT_NEAR(moment, 400e3 - 0.5 * (moment_left + moment_right), 1e-9 * 400e3) << mesh;
  }
}

// Between two bodies that are divided differently, in water that reaches half up the joint between them.
TEST(PorePressure, OfWaterThatReachesHalfUpAJointIsExact) {
  const auto solution = run(R"(
scabo: 1
materials: {concrete: {young: 30e9, poisson: 0.2}}
bodies:
  left: {material: concrete, shape: {rectangle: {corner: [0, 0], size: [2, 3]}}, mesh: {size: 0.4, order: 3}}
  right: {material: concrete, shape: {rectangle: {corner: [2, 0], size: [2, 3]}}, mesh: {kind: fem, size: 0.45}}
supports: [{on: left.left, fix: [x, y]}, {on: right.right, fix: [x, y]}]
contacts: {joint: {between: [left.right, right.left], friction: 0.5}}
loads: {water: {in: joint, water: {level: 1.3, unit_weight: 9.81e3}}}
)");
  EXPECT_NEAR(*contact_of(last(solution)).pore_force, 0.5 * 9.81e3 * 1.3 * 1.3, 1e-9);
  EXPECT_GT(contact_of(last(solution)).open, 0);  // the water opens the joint
  EXPECT_NEAR(last(solution).reactions[0].x(), 0.5 * 9.81e3 * 1.3 * 1.3 + contact_of(last(solution)).normal_force,
              1e-7);
}

// The factor of a step: the block slides when the pressure rises, not by the push.
TEST(PorePressure, RisesByStepsAsALoad) {
  const auto solution = run(R"(
scabo: 1
materials: {concrete: {young: 30e9, poisson: 0.2}}
bodies:
  lower: {material: concrete, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}, mesh: {size: 0.5}}
  upper: {material: concrete, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.4}}
supports: [{on: lower.bottom, fix: [x, y]}]
springs: [{on: upper.right, k_n: 1e5, name: stop}]
contacts: {joints: {between: [lower, upper], friction: 0.5}}
loads:
  weight: {on: upper.top, pressure: 200e3}
  push: {on: upper.left, pressure: 150e3}
  water: {in: joints, pressure: 100e3}
steps:
  - {name: weigh, loads: {weight: 1}}
  - {name: push, loads: {push: 1}}
  - {name: fill, increments: 4, loads: {water: 2.0}}
)");
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  ASSERT_EQ(solution.increments.size(), 6u);
  EXPECT_EQ(contact_of(increment_at(solution, 1)).pore_force.value(), 0.0);
  for (std::size_t i = 2; i < 6; ++i) {
    const auto& joint = contact_of(increment_at(solution, i));
    const double U = 200e3 * 0.5 * static_cast<double>(i - 1);
    EXPECT_NEAR(*joint.pore_force, U, 1e-9 * U);
    EXPECT_NEAR(joint.normal_force, 400e3 - U, 1e-8 * 400e3);
    EXPECT_NEAR(increment_at(solution, i).reactions[0].y(), 400e3, 1e-8 * 400e3);
    // What friction cannot hold goes into the stop.
    EXPECT_NEAR(-increment_at(solution, i).springs[0].x(), std::max(0.0, 150e3 - 0.5 * (400e3 - U)), 2e-3 * 150e3) << i;
  }
}

// Infinite slope with seepage along it, water at the surface: the pressure on the slip surface at the depth z is
// gamma_w z cos^2 beta, and the ground slides where tan phi = gamma tan beta / (gamma - gamma_w).
TEST(PorePressure, InASlopeLetsItSlideAtItsFactorOfSafety) {
  const double beta = 0.25, depth = 1.0, gamma = 19e3, gamma_w = 9.81e3;  // depth: at right angles to the slope
  const double c = std::cos(beta), s = std::sin(beta), z = depth / c;
  const double critical = gamma * std::tan(beta) / (gamma - gamma_w);
  const auto at = [&](double along, double across) {
    return fmt::format("[{:.17g}, {:.17g}]", c * along - s * across, s * along + c * across);
  };
  for (const double safety : {1.0 + 1e-6, 1.0 - 1e-6}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{soil: {{young: 20e6, poisson: 0.3, density: 1900}}}}
bodies:
  rock: {{rigid: true, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}}}
  soil: {{material: soil, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}, mesh: {{size: 1}}}}
supports: [{{on: rock, fix: [x, y]}}]
contacts: {{slip: {{between: [rock.edge_3, soil.edge_1], friction: {:.17g}}}}}
loads:
  weight: {{gravity: [0, -10]}}
  water: {{in: slip, pressure: {:.17g}}}
)",
                                          at(-1, -1), at(11, -1), at(11, 0), at(-1, 0), at(0, 0), at(10, 0),
                                          at(10, depth), at(0, depth), safety * critical, gamma_w * z * c * c));
    EXPECT_EQ(solution.outcome, safety > 1.0 ? analysis::Outcome::solved : analysis::Outcome::mechanism)
        << solution.reason;
    if (safety < 1.0) continue;
    EXPECT_NEAR(contact_of(last(solution)).normal_force, 10.0 * depth * (gamma - gamma_w) * c, 1e-8 * 10.0 * gamma);
  }
}

// The rigid base ends within the first element of the block, which is divided there: water presses on what lies on the
// base, .1 of it, and on nothing beyond. The block hangs from its top, and the pressure opens the joint.
TEST(PorePressure, ActsToTheEndOfABaseWithinAnElement) {
  for (const int order : {1, 2}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.5}}
materials: {{concrete: {{young: 30e9, poisson: 0.2}}}}
bodies:
  base: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [1.1, 1]}}}}}}
  block: {{material: concrete, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5, order: {}}}}}
supports: [{{on: base, fix: [x, y]}}, {{on: block.top, fix: [x, y]}}]
contacts: {{joint: {{between: [base.top, block.bottom], friction: 0.6}}}}
loads: {{uplift: {{in: joint, pressure: 150e3}}}}
)",
                                          order));
    const auto& joint = contact_of(last(solution));
    ASSERT_EQ(static_cast<int>(joint.pairs.size()), order + 1);
    EXPECT_EQ(joint.open, order + 1);
    const double uplift = 150e3 * 0.1 * 0.5;
    EXPECT_NEAR(*joint.pore_force, uplift, 1e-12 * uplift);
    EXPECT_NEAR(last(solution).reactions[1].y(), -uplift, 1e-9 * uplift);
  }
}

// In an open crack it is the pressure on both faces; in a closed one it takes as much off the pairs, and the factors
// are those of the effective stress.
TEST(PorePressure, InACrackIsThatOnItsFaces) {
  CrackedPlate plate;
  plate.half_width = 10, plate.size = 2.5, plate.yy = 0.0;
  plate.crack("flaw", {{-2, 0}, {2, 0}}).refine_at({{-2, 0}, {2, 0}}, 0.4);
  plate.contacts = "flaw: {between: [plate.flaw.left, plate.flaw.right], friction: 0.3}";
  plate.loads = "water: {in: flaw, pressure: 1.5}";
  const auto inside = run(plate.text());
  plate.loads = "face: {on: plate.flaw.left, pressure: 1.5}\n  other_face: {on: plate.flaw.right, pressure: 1.5}";
  const auto faces = run(plate.text());
  const double K = factors_at(last(faces), "plate.flaw.end").K_I;
  EXPECT_GT(K, 1.5 * std::sqrt(3.14159 * 2.0));
  EXPECT_NEAR(factors_at(last(inside), "plate.flaw.end").K_I, K, 1e-9 * K);
  EXPECT_NEAR(factors_at(last(inside), "plate.flaw.start").K_I, K, 1e-4 * K);  // the mesh is not symmetric
  // Closed by a pressure of 4 across it: an effective pressure of 2.5 is left, everywhere.
  plate.yy = -4.0;
  plate.loads = "water: {in: flaw, pressure: 1.5}";
  const auto closed = run(plate.text());
  EXPECT_EQ(contact_of(last(closed)).open, 0);
  EXPECT_NEAR(factors_at(last(closed), "plate.flaw.end").K_I, 0.0, 1e-5 * K);
  for (const analysis::PairResult& pair : contact_of(last(closed)).pairs) {
    EXPECT_NEAR(pair.pressure, 2.5, std::abs(pair.position.x()) < 2.0 - 1e-6 ? 2e-2 : 0.25)
        << pair.position.transpose();
  }
}

}  // namespace
}  // namespace scabo::verification
