// Laws of joints in steps in time, against closed forms of a rigid block.
#include <fmt/format.h>

#include <cmath>

#include "dynamics.hpp"

namespace scabo::verification {
namespace {

using analysis::IncrementResult;
using analysis::StaticSolution;

constexpr double mass_pushed = 2000.0, weight_pushed = 9.81 * mass_pushed;

/// A rigid block of 2 t on 2 m2 of rigid ground, at rest under its weight, then pushed along it by a sudden force.
StaticSolution pushed(const std::string& law, double push) {
  return run(fmt::format(R"(
scabo: 1
analysis: {{plane: stress}}
bodies:
  ground: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [9, 1]}}}}}}
  block: {{rigid: true, density: 1000, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}}}
supports: [{{on: ground, fix: [x, y]}}]
loads: {{weight: {{on: block, gravity: [0, -9.81]}}, push: {{on: block, force: [{}, 0]}}}}
contacts: {{base: {{between: [ground.top, block.bottom], {}}}}}
steps:
  - {{name: rest, loads: {{weight: 1}}}}
  - {{name: push, dynamic: {{duration: 0.3, step: 1e-3}}, loads: {{push: 1}}, increments: 3}}
)",
                         push, law));
}

/// As expect_balanced(), where the energies may be nothing but rounding.
void expect_solved(const StaticSolution& solution) {
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  for (const IncrementResult& at : solution.increments) {
    EXPECT_LT(at.certificate.worst(), 1e-10);
    EXPECT_LT(at.certificate.energy_balance, 1e-9);
  }
}

struct Joint {
  const char* law;
  double push, bound;  ///< largest force of the joint while the block moves, or the push if it stays
};

// The block stays, or moves by half of (push - bound)/mass t^2: 2 m2 of joint.
TEST(LawsInTime, ABlockMovesByWhatIsLeftOfThePush) {
  for (const Joint& joint :
       {Joint{"friction: 0.3, cohesion: 5e3", 15e3, 15e3},              // below 0.3 weight + 10 kN
        {"friction: 0.3, cohesion: 5e3", 16.5e3, 0.3 * weight_pushed},  // which is lost when it breaks
        {"friction: 0.3, cohesion: {lasting: 5e3}", 16.5e3, 0.3 * weight_pushed + 10e3},
        {"shear_strength: 5e3", 12e3, 10e3},
        {"friction: {forward: 0.2, backward: 0.6}", 10e3, 0.2 * weight_pushed},
        {"friction: {forward: 0.2, backward: 0.6}", -10e3, -10e3},
        {"friction: {static: 0.5, dynamic: 0.3}", 9e3, 9e3},
        {"friction: {static: 0.5, dynamic: 0.3}", 10e3, 0.3 * weight_pushed},
        {"bond: true", 1e9, 1e9}}) {
    const StaticSolution solution = pushed(joint.law, joint.push);
    expect_solved(solution);
    for (const IncrementResult& at : solution.increments) {
      const double t = at.time.value_or(0.0), exact = 0.5 * (joint.push - joint.bound) / mass_pushed * t * t;
      EXPECT_NEAR(at.fields.displacements[1][0], exact, 1e-9 + 0.01 * exact) << joint.law << ' ' << joint.push;
    }
    EXPECT_NEAR(last(solution).contacts[0].tangential_force, -joint.bound, 1e-6 * std::abs(joint.bound)) << joint.law;
  }
}

// Friction that falls from 0.5 to 0.3 over 20 mm under a push of 0.52 of the weight: s = a/l^2 (cosh l t - 1), a = 0.02
// g, l^2 = 0.2 g/20 mm.
TEST(LawsInTime, FrictionFallsWithSlip) {
  const StaticSolution solution =
      pushed("friction: {static: 0.5, dynamic: 0.3, slip_distance: 0.02}", 0.52 * weight_pushed);
  expect_balanced(solution);
  const double a = 0.02 * 9.81, l = std::sqrt(0.2 * 9.81 / 0.02);
  for (std::size_t i = 1; i <= 3; ++i) {
    const IncrementResult& at = increment_at(solution, i);
    const double exact = a / (l * l) * (std::cosh(l * *at.time) - 1.0);
    EXPECT_NEAR(at.fields.displacements[1][0] / exact, 1.0, 0.02) << i;
  }
}

// A block that hangs by the tensile strength of its joint, or falls freely.
TEST(LawsInTime, ABlockHangsByTensileStrength) {
  for (const bool holds : {true, false}) {
    const StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
bodies:
  ceiling: {{rigid: true, shape: {{rectangle: {{corner: [-1, 1], size: [4, 1]}}}}}}
  block: {{rigid: true, density: 1000, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}}}
supports: [{{on: ceiling, fix: [x, y]}}]
loads: {{weight: {{on: block, gravity: [0, -9.81]}}}}
contacts: {{joint: {{between: [ceiling.bottom, block.top], friction: 0.3, cohesion: 1e5, tension: {}}}}}
steps: [{{dynamic: {{duration: 0.1, step: 1e-3}}, increments: 2}}]
)",
                                                    holds ? 10e3 : 9.5e3));
    expect_solved(solution);
    for (const IncrementResult& at : solution.increments) {
      const double t = *at.time;
      EXPECT_NEAR(at.fields.displacements[1][1], holds ? 0.0 : -0.5 * 9.81 * t * t, 1e-12);
      EXPECT_NEAR(at.contacts[0].normal_force, holds ? -weight_pushed : 0.0, 1e-6);
    }
  }
}

// Two halves of a column that are bonded move as two that are tied.
TEST(LawsInTime, ABondIsATie) {
  const auto model = [](const std::string& joint) {
    return run(fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{stone: {{young: 1e8, poisson: 0.2, density: 2000, damping: {{ratio: 0.05, between: [5, 50]}}}}}}
bodies:
  low: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}, mesh: {{kind: fem, size: 0.5, order: 2}}}}
  high: {{material: stone, shape: {{rectangle: {{corner: [0, 2], size: [1, 2]}}}}, mesh: {{kind: fem, size: 0.5, order: 2}}}}
supports: [{{on: low.bottom, fix: [x, y]}}]
{}
curves: {{quake: {{sine: {{amplitude: 3, periods: 2}}}}}}
steps: [{{dynamic: {{duration: 0.2, step: 1e-3, ground: {{x: quake}}}}, increments: 10}}]
)",
                           joint));
  };
  const StaticSolution bonded = model("contacts: {joint: {between: [low.top, high.bottom], bond: true}}"),
                       tied = model("ties: {joint: {between: [low.top, high.bottom]}}");
  expect_balanced(bonded);
  expect_balanced(tied);
  const double largest = last(tied).fields.displacements[1].lpNorm<Eigen::Infinity>();
  EXPECT_GT(largest, 1e-4);
  for (std::size_t i = 0; i < 10; ++i) {
    const Vector &a = increment_at(bonded, i).fields.displacements[1],
                 &b = increment_at(tied, i).fields.displacements[1];
    EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), 1e-3 * largest) << i;
  }
}

}  // namespace
}  // namespace scabo::verification
