// Closed forms of contact laws on whole models. Uniform states: without Poisson's ratio, a block with the
// shear traction of its top on its sides as well has sigma_yy = -p and tau everywhere, and every pair its
// share of the area.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// A block of 2 x 1 m on a rigid plane under pressure p (pull where negative) and shear tau, joined by `law`.
std::string sheared_block(double p, double tau, const std::string& law, int order = 2) {
  return fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.5}}
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.25, order: {}}}}}
  plane: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
supports:
  - {{on: plane, fix: [x, y]}}
loads:
  top: {{on: block.top, traction: [{}, {}]}}
  left: {{on: block.left, traction: [0, {}]}}
  right: {{on: block.right, traction: [0, {}]}}
contacts:
  joint: {{between: [plane.top, block.bottom], {}}}
)",
                     order, tau, -p, -tau, tau, law);
}

constexpr double just_below = 1.0 - 1e-6, just_above = 1.0 + 1e-6;

void expect_held(const std::string& model) {
  const auto solution = run(model);
  const analysis::ContactResult& contact = contact_of(last(solution));
  EXPECT_EQ(contact.open + contact.slip, 0);
  EXPECT_EQ(contact.broken.value_or(0), 0);
}

void expect_mechanism(const std::string& model, const std::string& motion) {
  const auto solution = run(model);
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(solution.reason.find("mechanism: body 'block': " + motion), std::string::npos) << solution.reason;
}

// As on an incline: W cos / A = p, W sin / A = tau, slips when tan > mu + c A / (W cos).
TEST(CohesiveBlock, SlidesAboveCohesionAndFriction) {
  const double mu = 0.4, c = 3e4;
  for (int order : {1, 2, 4})
    for (double p : {1e4, 1e5}) {
      const double limit = c + mu * p;
      const std::string law = fmt::format("friction: {}, cohesion: {}", mu, c);
      expect_held(sheared_block(p, limit * just_below, law, order));
      expect_mechanism(sheared_block(p, limit * just_above, law, order), "translation along (1, 0)");
    }
}

TEST(CohesiveBlock, HangsByItsTensileStrength) {
  const std::string law = "friction: 0.4, cohesion: 1e6, tension: 2e4";
  expect_held(sheared_block(-2e4 * just_below, 0.0, law));
  const auto falls = run(sheared_block(-2e4 * just_above, 0.0, law));
  EXPECT_EQ(falls.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(falls.reason.find("mechanism"), std::string::npos) << falls.reason;
}

// Numbers far above the loads prove no mechanism where there is none.
TEST(CohesiveBlock, IsHeldByHugeStrengthsAndFriction) {
  for (const char* law : {"friction: 1e3, cohesion: 1e99, tension: 1e99", "friction: 1e6, cohesion: 1e6, tension: 1e6",
                          "cohesion: 1e13, tension: 1e12", "friction: 1e6, cohesion: 1e99, tension: 1e99"})
    expect_held(sheared_block(-2e4, 1e4, law));
}

TEST(TrescaBlock, SlidesAtItsShearStrengthWhateverThePressure) {
  for (double p : {1e4, 1e6}) {
    expect_held(sheared_block(p, 5e4 * just_below, "shear_strength: 5e4"));
    expect_mechanism(sheared_block(p, 5e4 * just_above, "shear_strength: 5e4"), "translation along (1, 0)");
  }
}

/// The block's top is moved by (u_x, u_y) in the steps given; its foot is joined by `law`.
std::string moved_block(double u_x, double u_y, const std::string& law,
                        const std::string& steps = "[{increments: 1}]") {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.25}}}}
  plane: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
supports:
  - {{on: plane, fix: [x, y]}}
  - {{on: block.top, displacement: [null, {}], name: lift}}
  - {{on: block.top, displacement: [{}, null], name: push}}
contacts:
  joint: {{between: [plane.top, block.bottom], {}}}
steps: {}
)",
                     u_y, u_x, law, steps);
}

// Lifted by u the joint carries E u / h per area; at the strength it breaks, opens by u and stays open on the
// way back, where it closes again at u = 0 and carries pressure, but no pull any more.
TEST(BrittleJoint, BreaksAtItsClosedFormLiftAndStaysBroken) {
  const double strength = 2e4, limit = strength * 1.0 / 1e9, force = 2.0 * strength;
  const auto model = [&](double lift, const std::string& steps) {
    return moved_block(0.0, lift, "cohesion: 1e6, tension: 2e4", steps);
  };
  const auto holds = run(model(limit * just_below, "[{increments: 1}]"));
  const analysis::ContactResult& joint = last(holds).contacts.front();
  EXPECT_NEAR(joint.normal_force, -force * just_below, 1e-8 * force);
  EXPECT_EQ(joint.broken, 0);
  const auto breaks = run(model(
      limit * just_above, "[{increments: 3}, {name: back, loads: {lift: 0.5}}, {name: press, loads: {lift: -1}}]"));
  last(breaks);
  ASSERT_EQ(breaks.increments.size(), 5u);
  EXPECT_NEAR(contact_of(increment_at(breaks, 1)).normal_force, -force * just_above * 2 / 3, 1e-8 * force);
  for (std::size_t k : {2u, 3u}) {
    const analysis::ContactResult& open = contact_of(increment_at(breaks, k));
    EXPECT_EQ(open.open, static_cast<int>(open.pairs.size()));
    EXPECT_EQ(open.broken, static_cast<int>(open.pairs.size()));
    EXPECT_EQ(open.normal_force, 0.0);
    EXPECT_NEAR(open.max_gap, limit * just_above * (k == 2 ? 1.0 : 0.5), 1e-15);
  }
  EXPECT_NEAR(contact_of(increment_at(breaks, 4)).normal_force, force * just_above, 1e-8 * force);
}

// Pressed, moved to and fro, lifted, moved and put down again: while it slides the joint carries c A + mu N in either
// direction, however far it has slipped, and nothing while it is open.
TEST(LastingCohesion, ActsOnClosedPairsAfterAnySlipAndLift) {
  const double mu = 0.2, c = 1e5, area = 2.0, normal = 1e9 * 1e-3 * area, bound = mu * normal + c * area;
  for (const int sense : {1, -1}) {
    const auto solution = run(moved_block(5e-3 * sense, 1e-3, "friction: 0.2, cohesion: {lasting: 1e5}",
                                          "[{name: press, loads: {lift: -1, push: 0}}, {name: forth, increments: 2, "
                                          "loads: {push: 1}}, {name: back, loads: "
                                          "{push: -1}}, {name: up, loads: {lift: 1}}, {name: along, loads: {push: "
                                          "0.5}}, {name: down, loads: {lift: -1}}, "
                                          "{name: again, loads: {push: -1}}]"));
    last(solution);
    ASSERT_EQ(solution.increments.size(), 8u);
    const auto expect_at = [&](std::size_t increment, double tangential, double normal_force) {
      const analysis::ContactResult& joint = contact_of(increment_at(solution, increment));
      EXPECT_NEAR(joint.normal_force, normal_force, 1e-8 * normal) << increment;
      EXPECT_NEAR(joint.tangential_force, sense * tangential, 1e-8 * bound) << increment;
    };
    expect_at(2, -bound, normal);
    expect_at(3, bound, normal);
    expect_at(4, 0.0, 0.0);
    expect_at(5, 0.0, 0.0);
    expect_at(7, bound, normal);
    EXPECT_FALSE(contact_of(last(solution)).broken);
  }
}

// So much shear that the block lifts at one end, in one increment and in ten, and back. At most the pair at the end of
// the open part has no cohesion, where it would open with it and closes without.
TEST(LastingCohesion, BoundsTheShearOfEveryClosedPairOfAJointThatOpensPartly) {
  const double mu = 0.3, c = 2e5;
  const auto forces = [&](const std::string& steps, int sense) {
    const auto solution = run(moved_block(2e-2 * sense, -3e-4, "friction: 0.3, cohesion: {lasting: 2e5}", steps));
    const analysis::ContactResult& joint = contact_of(last(solution));
    EXPECT_GT(joint.open, 1);
    int without = 0;
    for (const analysis::PairResult& pair : joint.pairs) {
      if (pair.state == contact::ContactState::open) {
        EXPECT_EQ(std::max(std::abs(pair.normal_force), std::abs(pair.tangential_force)), 0.0) << pair.pair;
        continue;
      }
      const bool has_none = std::abs(pair.shear) < 0.5 * c;
      without += has_none;
      EXPECT_NEAR(std::abs(pair.shear), (has_none ? 0.0 : c) + mu * pair.pressure, 1e-8 * c) << pair.pair;
    }
    EXPECT_LE(without, 1);
    EXPECT_TRUE(solution.warnings.empty());
    return Vec2(joint.normal_force, sense * joint.tangential_force);
  };
  const std::string press = "[{name: press, loads: {lift: 1, push: 0}}, ";
  const Vec2 once = forces(press + "{name: push, loads: {push: 1}}]", 1);
  EXPECT_LT((forces(press + "{name: push, loads: {push: 1}}]", -1) - once).norm(), 1e-8 * once.norm());
  EXPECT_LT((forces(press + "{name: push, increments: 10, loads: {push: 1}}]", 1) - once).norm(), 1e-8 * once.norm());
  const Vec2 back =
      forces(press + "{name: push, loads: {push: 1}}, {name: back, increments: 3, loads: {push: -1}}]", 1);
  EXPECT_LT((back - Vec2(once[0], -once[1])).norm(), 1e-8 * once.norm());
}

TEST(LastingCohesion, ThatManyPairsCannotHaveIsTold) {
  const auto solution = run(moved_block(2e-2, -3e-4, "friction: 0.3, cohesion: {lasting: 6e5}",
                                        "[{name: press, loads: {lift: 1, push: 0}}, {name: push, loads: {push: 1}}]"));
  last(solution);
  const auto told = std::find_if(solution.warnings.begin(), solution.warnings.end(), [](const Warning& warning) {
    return warning.text.find("closed pairs of contact 'joint' have no cohesion") != std::string::npos;
  });
  EXPECT_NE(told, solution.warnings.end());
}

// Once all pairs slide, the whole force falls from at most mu_s N to mu_d N.
TEST(SlidingBlock, ForceFallsFromTheStaticToTheDynamicCoefficient) {
  for (const char* distance : {"0", "1e-6"}) {
    const auto solution = run(
        moved_block(2e-3, -1e-3, fmt::format("friction: {{static: 0.5, dynamic: 0.3, slip_distance: {}}}", distance),
                    "[{name: press, loads: {lift: 1}}, {name: push, increments: 10}]"));
    const analysis::ContactResult& contact = contact_of(last(solution));
    EXPECT_EQ(contact.slip, static_cast<int>(contact.pairs.size()));
    EXPECT_NEAR(contact.tangential_force, -0.3 * contact.normal_force, 1e-9 * contact.normal_force);
    double most = 0.0;
    for (const analysis::IncrementResult& increment : solution.increments) {
      const analysis::ContactResult& joint = increment.contacts.front();
      for (const analysis::PairResult& pair : joint.pairs)
        EXPECT_LE(std::abs(pair.tangential_force), 0.5 * pair.normal_force + 1e-6);
      most = std::max(most, std::abs(joint.tangential_force / joint.normal_force));
    }
    EXPECT_GT(most, 0.3);
  }
}

// Coefficients given along the contact: sliding, every pair has its own.
TEST(SlidingBlock, EveryPairHasTheCoefficientOfItsPosition) {
  const auto solution = run(moved_block(5e-3, -1e-3, "friction: {along: [[0, 0.2], [0.5, 0.2], [1, 0.4]]}",
                                        "[{name: press, loads: {lift: 1}}, {name: push, increments: 4}]"));
  const analysis::ContactResult& contact = contact_of(last(solution));
  for (const analysis::PairResult& pair : contact.pairs) {
    if (pair.state != contact::ContactState::slip) continue;
    const double s = pair.position.x() / 2.0, mu = s < 0.5 ? 0.2 : 0.2 + 0.4 * (s - 0.5);
    EXPECT_NEAR(std::abs(pair.tangential_force), mu * pair.normal_force, 1e-9 * contact.normal_force);
  }
  EXPECT_GT(contact.slip, 10);
}

/// A cantilever of 2 x 1 m in one body, or in two halves bonded along the middle.
std::string cantilever(bool halves) {
  const std::string bodies = halves ? R"(
  lower: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 0.5]}}, mesh: {kind: fem, size: 0.25}}
  upper: {material: m, shape: {rectangle: {corner: [0, 0.5], size: [2, 0.5]}}, mesh: {kind: fem, size: 0.25}})"
                                    : R"(
  upper: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.25}})";
  const std::string lower_support = halves ? "\n  - {on: lower.left, fix: [x, y]}" : "";
  const std::string joint = halves ? "contacts: {joint: {between: [lower.top, upper.bottom], bond: true}}\n" : "";
  return "scabo: 1\nmaterials: {m: {young: 1e9, poisson: 0.3}}\nbodies:" + bodies + "\nsupports:" + lower_support +
         "\n  - {on: upper.left, fix: [x, y]}\nloads:\n  top: {on: upper.top, traction: [3e3, -1e4]}\n" + joint;
}

// Same elements, same nodes: two halves bonded are the body in one piece, node by node.
TEST(BondedHalves, AreTheBodyInOnePiece) {
  const auto whole = run(cantilever(false)), halves = run(cantilever(true));
  last(whole);
  const analysis::ContactResult& joint = last(halves).contacts.front();
  EXPECT_EQ(joint.stick, static_cast<int>(joint.pairs.size()));
  const auto& nodes = whole.mesh.bodies[0].nodes;
  double largest = 0.0, difference = 0.0;
  int compared = 0;
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t i = 0; i < halves.mesh.bodies[b].nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        if ((nodes[j] - halves.mesh.bodies[b].nodes[i]).norm() > 1e-9) continue;
        const Vec2 u = whole.increments.back().fields.displacements[0].segment<2>(static_cast<Eigen::Index>(2 * j));
        const Vec2 v = halves.increments.back().fields.displacements[b].segment<2>(static_cast<Eigen::Index>(2 * i));
        largest = std::max(largest, u.norm());
        difference = std::max(difference, (u - v).norm());
        ++compared;
      }
  EXPECT_GT(compared, 100);
  EXPECT_LT(difference, 1e-9 * largest);
}

TEST(Uniqueness, IsReportedWhereAskedFor) {
  const auto solution = run(moved_block(1e-4, -1e-3, "friction: 0.1"), {"solver.uniqueness=true"});
  ASSERT_TRUE(last(solution).uniqueness.has_value());
  EXPECT_EQ(last(solution).uniqueness->verdict, "proven");
  EXPECT_FALSE(last(run(moved_block(1e-4, -1e-3, "friction: 0.1"))).uniqueness.has_value());
}

// A block that is glued to a floor is heated: its joint fails from both ends, and which pairs fall first does not
// depend on where W holds the body, which contact alone holds.
TEST(Laws, AJointThatFailsFromBothEndsStaysSymmetric) {
  for (const double heat : {2.0, 5.0, -5.0}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{s: {{young: 10e9, poisson: 0.2, density: 2500, expansion: 1e-5}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-3, -1], size: [6, 1]}}}}}}
  block: {{material: s, shape: {{rectangle: {{corner: [-1, 0], size: [2, 1]}}}}, mesh: {{size: 0.25}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  weight: {{gravity: [0, -9.81]}}
  heat: {{on: block, temperature: {{constant: {}}}}}
  press: {{on: block.top, pressure: 1e5}}
contacts: {{joint: {{between: [floor.top, block.bottom], friction: 0.3, cohesion: 5e4}}}}
)",
                                          heat));
    const std::vector<analysis::PairResult>& pairs = contact_of(last(solution)).pairs;
    ASSERT_EQ(pairs.size(), 17u);
    EXPECT_GT(contact_of(last(solution)).broken.value_or(0), 2) << "the test is meant to have joints that fail";
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const analysis::PairResult& other = pairs[pairs.size() - 1 - i];
      EXPECT_NEAR(pairs[i].normal_force, other.normal_force, 1e-6) << heat << ", pair " << i;
      EXPECT_NEAR(pairs[i].tangential_force, -other.tangential_force, 1e-6) << heat << ", pair " << i;
    }
  }
}

}  // namespace
}  // namespace scabo::verification
