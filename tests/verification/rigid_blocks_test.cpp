// Models whose bodies are all rigid: stacks of blocks at rest and in time, by statics and by the motion of a rigid
// body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

using analysis::IncrementResult;
using analysis::StaticSolution;

constexpr double weight = 20e3 * 9.81;  // of a block

/// Blocks of 1 x 2 on each other, density 10000, and a force at the top left corner of the uppermost one. `unit`: of
/// length; `angle`: of the whole model; `swapped`: the sides of contacts.
std::string stack(int blocks, double push, const std::string& steps, double unit = 1.0, double angle = 0.0,
                  bool swapped = false) {
  const auto turned = [&](double x, double y) {
    return fmt::format("[{}, {}]", x * std::cos(angle) - y * std::sin(angle),
                       x * std::sin(angle) + y * std::cos(angle));
  };
  const auto at = [&](double x, double y) { return turned(unit * x, unit * y); };
  std::string bodies, contacts;
  for (int k = 0; k < blocks; ++k) {
    bodies +=
        fmt::format("  block_{}: {{rigid: true, density: {}, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}}}\n", k,
                    10e3 / unit / unit / unit, at(0, 2 * k), at(1, 2 * k), at(1, 2 * k + 2), at(0, 2 * k + 2));
    const std::string below = k == 0 ? "floor.edge_3" : fmt::format("block_{}.edge_3", k - 1),
                      above = fmt::format("block_{}.edge_1", k);
    contacts += fmt::format("  joint_{}: {{between: [{}, {}], friction: 0.6}}\n", k, swapped ? above : below,
                            swapped ? below : above);
  }
  return fmt::format(
      "scabo: 1\nanalysis: {{thickness: {}}}\nbodies:\n"
      "  floor: {{rigid: true, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}}}\n{}"
      "supports: [{{on: floor, fix: [x, y]}}]\n"
      "loads: {{weight: {{gravity: {}}}, push: {{on: block_{}.vertex_4, force: {}}}}}\ncontacts:\n{}steps:\n{}",
      unit, at(-1, -1), at(2, -1), at(2, 0), at(-1, 0), bodies, turned(0, -9.81 * unit), blocks - 1,
      turned(push * unit, 0), contacts, steps);
}

TEST(RigidBlocks, InAStackCarryForceAndMoment) {
  for (const bool swapped : {false, true}) {
    const double push = 0.05 * weight;
    const StaticSolution solution = run(stack(3, push, "  - {name: all}\n", 1.0, 0.0, swapped));
    const IncrementResult& at = last(solution);
    for (int k = 0; k < 3; ++k) {
      const auto& contact = contact_of(at, static_cast<std::size_t>(k));
      const double N = (3 - k) * weight, moment = push * 2.0 * (3 - k);
      EXPECT_NEAR(contact.normal_force, N, 1e-9 * weight);
      EXPECT_NEAR(std::abs(contact.tangential_force), push, 1e-9 * weight);
      ASSERT_EQ(contact.pairs.size(), 2u);
      EXPECT_NEAR(contact.pairs[0].normal_force, 0.5 * N - moment, 1e-9 * weight);
      EXPECT_NEAR(contact.pairs[1].normal_force, 0.5 * N + moment, 1e-9 * weight);
      EXPECT_NEAR(contact.pairs[1].pressure, (0.5 * N + moment) / 0.5, 1e-9 * weight);
    }
  }
}

// A push at the top turns a block over from W b / (2 h) on; two blocks slide or turn over together.
TEST(RigidBlocks, TurnOverAtTheLoadOfStatics) {
  for (const int blocks : {1, 2}) {
    const double limit = weight * blocks * 0.5 / (2.0 * blocks);
    EXPECT_EQ(run(stack(blocks, (1.0 - 1e-6) * limit, "  - {name: all}\n")).outcome, analysis::Outcome::solved);
    EXPECT_EQ(run(stack(blocks, (1.0 + 1e-6) * limit, "  - {name: all}\n")).outcome, analysis::Outcome::mechanism);
  }
}

TEST(RigidBlocks, SlideOffAnInclineBeyondFriction) {
  const double angle = std::atan(0.6), W = 4e3 * 9.81;
  const auto incline = [&](double friction) {
    return fmt::format(R"(
scabo: 1
bodies:
  ground: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [9, 1]}}}}}}
  slab: {{rigid: true, density: 1000, shape: {{rectangle: {{corner: [0, 0], size: [4, 1]}}}}}}
supports: [{{on: ground, fix: [x, y]}}]
loads: {{weight: {{gravity: [{}, {}]}}}}
contacts: {{base: {{between: all, friction: {}}}}}
)",
                       9.81 * std::sin(angle), -9.81 * std::cos(angle), friction);
  };
  EXPECT_EQ(run(incline(0.599)).outcome, analysis::Outcome::mechanism);
  const auto& base = contact_of(last(run(incline(0.601))));
  EXPECT_NEAR(base.normal_force, W * std::cos(angle), 1e-9 * W);
  EXPECT_NEAR(std::abs(base.tangential_force), W * std::sin(angle), 1e-9 * W);
}

/// A block of 1 x 1 and density 1000 on a floor, held along it by a spring at its lower left corner, and pushed along
/// it at the upper right one. All turned by a right angle where `upright`; `unit`: of length.
std::string on_a_spring_at_rest(double stiffness, double push, double unit, bool upright) {
  const auto at = [&](double x, double y) {
    return upright ? fmt::format("[{}, {}]", -unit * y, unit * x) : fmt::format("[{}, {}]", unit * x, unit * y);
  };
  return fmt::format(
      "scabo: 1\nanalysis: {{thickness: {}}}\nbodies:\n"
      "  floor: {{rigid: true, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}}}\n"
      "  block: {{rigid: true, density: {}, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}}}\n"
      "supports: [{{on: floor, fix: [x, y]}}]\nsprings: [{{on: block.vertex_1, {}: {}, name: spring}}]\n"
      "loads: {{weight: {{gravity: {}}}, push: {{on: block.vertex_3, force: {}}}}}\n"
      "contacts: {{base: {{between: [floor.edge_3, block.edge_1], friction: 0.1}}}}\n",
      unit, at(-2, -1), at(2, -1), at(2, 0), at(-2, 0), 1e3 / (unit * unit * unit), at(-0.5, 0), at(0.5, 0), at(0.5, 1),
      at(-0.5, 1), upright ? "k_y" : "k_x", stiffness, at(0, -10), at(push, 0));
}

// Friction holds what it can, a tenth of the weight of 10 kN, and the spring the rest, however soft it is.
TEST(RigidBlocks, RestOnTheFloorBesideASpring) {
  for (const double unit : {1.0, 1e3, 1e-3})
    for (const bool upright : {false, true})
      for (const double stiffness : {1e9, 1e4, 1.0, 1e-6})
        for (const double push : {0.0, 500.0, 2000.0}) {
          if (push > 1e3 && stiffness < 1e4) continue;  // it would slide off the floor
          const StaticSolution solution = run(on_a_spring_at_rest(stiffness, push, unit, upright));
          ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
          const IncrementResult& at = last(solution);
          EXPECT_NEAR(contact_of(at).normal_force, 1e4 * unit, 1e-6 * unit);
          EXPECT_NEAR(std::abs(contact_of(at).tangential_force), std::min(push, 1e3) * unit, 1e-6 * unit);
        }
}

const std::string time_steps =
    "  - {name: rest, loads: {weight: 1}}\n"
    "  - {name: push, dynamic: {duration: 0.1, step: 1e-3}, loads: {push: 1}, increments: 5}\n";

// A push of .3 W at the top turns the block about its right corner: m (b^2 + h^2)/3 alpha = F h - W b/2. The gap of the
// left pair is alpha t^2/2 b; base shear F - m alpha h/2 and force W + m alpha b/2.
TEST(RigidBlocks, TurnOverInTimeAboutTheirCorner) {
  const double alpha = (0.3 * 2.0 - 0.5) * 9.81 / (5.0 / 3.0), m = weight / 9.81;
  for (const double angle : {0.0, 0.5}) {
    for (const bool swapped : {false, true}) {
      const double unit = swapped ? 1e-3 : 1.0;
      const StaticSolution solution = run(stack(1, 0.3 * weight, time_steps, 1.0 / unit, angle, swapped));
      const IncrementResult& at = last(solution);
      const auto& contact = contact_of(at);
      const auto& opened = *std::max_element(contact.pairs.begin(), contact.pairs.end(),
                                             [](const auto& a, const auto& b) { return a.gap < b.gap; });
      EXPECT_NEAR(opened.gap * unit, 0.5 * alpha * 0.01, 1e-9);
      EXPECT_NEAR(contact.normal_force * unit, weight + 0.5 * m * alpha, 1e-7 * weight);
      EXPECT_NEAR(std::abs(contact.tangential_force) * unit, 0.3 * weight - m * alpha, 1e-7 * weight);
      EXPECT_NEAR(at.energy.kinetic * unit * unit, 0.5 * m * 5.0 / 3.0 * std::pow(alpha * 0.1, 2), 1e-6 * weight);
      EXPECT_LT(at.certificate.energy_balance, 1e-9);
    }
  }
}

// v = 1, friction .3, g = 10: at rest after 1/3 s and 1/6 m, and the kinetic energy has become heat.
TEST(RigidBlocks, SlideUntilFrictionStopsThem) {
  const std::string text = R"(
scabo: 1
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [5, 1]}}}
  block: {rigid: true, density: 1000, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}}
supports: [{on: floor, fix: [x, y]}]
loads: {weight: {gravity: [0, -10]}}
initial: [{on: block, velocity: [1, 0]}]
contacts: {base: {between: all, friction: 0.3}}
steps:
  - {name: rest, loads: {weight: 1}}
  - {name: slide, dynamic: {duration: 0.5, step: 1e-3}, increments: 5}
)";
  const IncrementResult& at = last(run(text));
  EXPECT_NEAR(std::abs(contact_of(at).pairs[0].slip), 1.0 / 6.0, 2e-6);
  EXPECT_NEAR(at.energy.friction, 500.0, 1e-6 * 500.0);
  EXPECT_LT(at.energy.kinetic, 1e-20);
}

// A block on a spring, omega = 4 pi, slides with mu = .1 at g = 10: in each half cycle it turns 2 d earlier than
// before, d = mu g / omega^2, until it stays within d of where the spring is at rest.
double on_a_spring(double t) {
  const double omega = 4.0 * std::numbers::pi, d = 1.0 / (omega * omega), A = std::hypot(d, 0.5 / omega),
               phase = std::asin(d / A);
  double turned = (0.5 * std::numbers::pi - phase) / omega;
  if (t <= turned) return A * std::sin(omega * t + phase) - d;
  double side = 1.0, X = A - d;
  for (; X > d && t > turned + std::numbers::pi / omega; turned += std::numbers::pi / omega) {
    X -= 2.0 * d;
    side = -side;
  }
  return X > d ? side * (d + (X - d) * std::cos(omega * (t - turned))) : side * X;
}

TEST(RigidBlocks, VibrateWithFrictionUntilTheyStay) {
  const auto largest_error = [](double step) {
    const double omega = 4.0 * std::numbers::pi;
    const StaticSolution solution = run(fmt::format(R"(
scabo: 1
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [5, 1]}}}}}}
  block: {{rigid: true, density: 1000, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}}}
supports: [{{on: floor, fix: [x, y]}}]
springs: [{{on: block.bottom_left, k_x: {}}}]
loads: {{weight: {{gravity: [0, -10]}}}}
initial: [{{on: block, velocity: [0.5, 0]}}]
contacts: {{base: {{between: all, friction: 0.1}}}}
steps:
  - {{name: swing, loads: {{weight: 1}}, dynamic: {{duration: 2, step: {}}}, increments: 100}}
)",
                                                    1000.0 * omega * omega, step));
    double largest = 0.0;
    for (const IncrementResult& at : solution.increments)
      if (at.time)
        largest = std::max(largest, std::abs(std::abs(contact_of(at).pairs[0].slip) - std::abs(on_a_spring(*at.time))));
    EXPECT_LT(last(solution).energy.kinetic, 1e-12);
    EXPECT_LT(last(solution).certificate.energy_balance, 1e-9);
    return largest;
  };
  EXPECT_LT(largest_error(2e-3), 2e-4);
  EXPECT_LT(largest_error(5e-4), 3e-5);
}

}  // namespace
}  // namespace scabo::verification
