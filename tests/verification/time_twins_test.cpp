// Steps in time in other units, turned, mirrored, with bodies in another order and with results at other times.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics.hpp"

namespace scabo::verification {
namespace {

using analysis::IncrementResult;
using analysis::StaticSolution;

struct Twin {
  const char* name = "";
  double unit = 1.0;   ///< a metre in lengths of the model; masses and times stay
  double angle = 0.0;  ///< of the whole model
  bool plain = false, mirrored = false, reordered = false, swapped = false;
  int every = 1;  ///< results at every so many times of the first

  std::string vector(double x, double y, double factor = 1.0) const {
    const double side = mirrored ? -x : x;
    return fmt::format("[{}, {}]", factor * (side * std::cos(angle) - y * std::sin(angle)),
                       factor * (side * std::sin(angle) + y * std::cos(angle)));
  }
  /// A rectangle, counter-clockwise, as a polygon with names: its mesh turns with it. Or drawn as a rectangle
  /// (`plain`): its mesh is that of its mirror image, mirrored.
  std::string rectangle(double x, double y, double width, double height) const {
    if (plain)
      return fmt::format("shape: {{rectangle: {{corner: {}, size: [{}, {}]}}}}",
                         vector(mirrored ? x + width : x, y, unit), width * unit, height * unit);
    return fmt::format(
        "shape: {{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
        "edge_4}}}}}}",
        vector(x, y, unit), vector(x + width, y, unit), vector(x + width, y + height, unit),
        vector(x, y + height, unit));
  }
  std::string bodies(const std::string& a, const std::string& b) const { return reordered ? b + a : a + b; }
  std::string between(const char* a, const char* b) const {
    return swapped ? fmt::format("[{}, {}]", b, a) : fmt::format("[{}, {}]", a, b);
  }
};

const Twin twins[] = {{.name = "in millimetres", .unit = 1000.0},
                      {.name = "turned", .angle = 0.6},
                      {.name = "turned by a right angle, in inches", .unit = 39.37, .angle = 0.5 * std::numbers::pi},
                      {.name = "mirrored", .plain = true, .mirrored = true},
                      {.name = "mirrored, in feet", .unit = 3.281, .plain = true, .mirrored = true, .reordered = true},
                      {.name = "reordered", .reordered = true},
                      {.name = "swapped", .swapped = true},
                      {.name = "results at other times", .every = 2}};

/// Forces, energies and reactions of all increments are those of the twin.
void expect_same(const StaticSolution& one, const StaticSolution& other, const Twin& twin, double force,
                 double energy) {
  ASSERT_EQ(other.outcome, analysis::Outcome::solved) << twin.name << other.reason;
  std::size_t compared = 0;
  for (const IncrementResult& b : other.increments) {
    const auto same = std::find_if(one.increments.begin(), one.increments.end(), [&](const IncrementResult& a) {
      return a.time.has_value() == b.time.has_value() && std::abs(a.time.value_or(0.0) - b.time.value_or(0.0)) < 1e-9;
    });
    ASSERT_NE(same, one.increments.end()) << twin.name;
    const IncrementResult& a = *same;
    ++compared;
    const double forces = 1e-8 * force, energies = 1e-8 * energy, of_energy = twin.unit * twin.unit;
    EXPECT_NEAR(b.contacts[0].normal_force / twin.unit, a.contacts[0].normal_force, forces) << twin.name;
    EXPECT_NEAR(std::abs(b.contacts[0].tangential_force) / twin.unit, std::abs(a.contacts[0].tangential_force), forces)
        << twin.name;
    EXPECT_NEAR(b.reactions[0].norm() / twin.unit, a.reactions[0].norm(), forces) << twin.name;
    EXPECT_NEAR(b.energy.kinetic / of_energy, a.energy.kinetic, energies) << twin.name;
    EXPECT_NEAR(b.energy.elastic / of_energy, a.energy.elastic, energies) << twin.name;
    EXPECT_NEAR(b.energy.friction / of_energy, a.energy.friction, energies) << twin.name;
    EXPECT_NEAR(b.energy.impact / of_energy, a.energy.impact, energies) << twin.name;
  }
  EXPECT_GE(compared, one.increments.size() / 2) << twin.name;
}

// The bar on a wall of dynamics_test.cpp.
std::string bar(const Twin& twin) {
  const double unit = twin.unit;
  return fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress, thickness: {}}}
materials: {{bar: {{young: {}, poisson: 0, density: {}}}}}
bodies:
{}supports: [{{on: wall, fix: [x, y]}}]
initial: [{{on: bar, velocity: {}}}]
contacts: {{hit: {{between: {}, friction: 0}}}}
steps: [{{dynamic: {{duration: 1.5, step: {}}}, increments: {}}}]
)",
                     unit, 900.0 / unit, 1.0 / (unit * unit * unit),
                     twin.bodies(fmt::format("  wall: {{rigid: true, {}}}\n", twin.rectangle(-1, -1, 1, 3)),
                                 fmt::format("  bar: {{material: bar, {}, mesh: {{kind: fem, size: {}, order: 1}}}}\n",
                                             twin.rectangle(5, 0, 10, 1), 0.5 * unit)),
                     twin.vector(-10, 0, unit),
                     twin.mirrored ? twin.between("wall.left", "bar.right") : twin.between("wall.right", "bar.left"),
                     1.0 / 120.0, 90 / twin.every);
}

TEST(TimeTwins, OfABarThatHitsAWall) {
  const StaticSolution one = run(bar({.name = "one"})), plain = run(bar({.name = "plain", .plain = true}));
  expect_balanced(one);
  expect_balanced(plain);
  for (const Twin& twin : twins) expect_same(twin.plain ? plain : one, run(bar(twin)), twin, 300.0, 500.0);
}

// A block that slides and hops on rock whose ground shakes along x and y.
std::string block(const Twin& twin) {
  const double unit = twin.unit;
  std::string x, y;
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.005 * i, s = 2.0 * std::numbers::pi * t / 0.3,
                 along = (twin.mirrored ? -8.0 : 8.0) * std::sin(2.0 * s), up = 2.0 * std::sin(3.0 * s),
                 c = std::cos(twin.angle), n = std::sin(twin.angle);
    x += fmt::format("{}[{}, {}]", i > 0 ? ", " : "", t, unit * (c * along - n * up));
    y += fmt::format("{}[{}, {}]", i > 0 ? ", " : "", t, unit * (n * along + c * up));
  }
  const auto body = [&](const char* name, const std::string& shape) {
    return fmt::format("  {}: {{material: stone, {}, mesh: {{kind: fem, size: {}, order: 2}}}}\n", name, shape,
                       0.5 * unit);
  };
  return fmt::format(
      R"(
scabo: 1
analysis: {{plane: strain, thickness: {}}}
materials: {{stone: {{young: {}, poisson: 0.2, density: {}, damping: {{ratio: 0.05, between: [20, 200]}}}}}}
bodies:
{}supports: [{{on: rock.bottom, fix: [x, y]}}]
loads: {{weight: {{gravity: {}, on: block}}}}
contacts: {{base: {{between: {}, friction: 0.4}}}}
curves: {{x: {{table: [{}]}}, y: {{table: [{}]}}}}
steps:
  - {{name: rest}}
  - {{name: shake, dynamic: {{duration: 0.3, step: 1e-3, ground: {{x: x, y: y}}}}, increments: {}}}
solver: {{halvings: 1}}
)",
      unit, 2e9 / unit, 2400.0 / (unit * unit * unit),
      twin.bodies(body("block", twin.rectangle(0, 0, 2, 1.5)), body("rock", twin.rectangle(-1, -1, 4, 1))),
      twin.vector(0, -9.81, unit), twin.between("rock.top", "block.bottom"), x, y, 30 / twin.every);
}

TEST(TimeTwins, OfABlockThatSlides) {
  const StaticSolution one = run(block({.name = "one"})), plain = run(block({.name = "plain", .plain = true}));
  expect_balanced(one);
  expect_balanced(plain);
  ASSERT_GT(last(one).energy.friction, 100.0);
  const double weight = one.increments[0].contacts[0].normal_force;
  for (const Twin& twin : twins)
    expect_same(twin.plain ? plain : one, run(block(twin)), twin, weight, last(one).energy.friction);
}

}  // namespace
}  // namespace scabo::verification
