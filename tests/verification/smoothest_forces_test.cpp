// Bodies cut into pieces that meet in points: the forces of single pairs are not unique there, and those that are given
// are the ones of the uncut body. All pressures are known by hand or from Lame's ring.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "verification/run.hpp"

namespace scabo::verification {
namespace {

struct Wall {
  int size = 2;                    // blocks of 1 x 1 along each side
  bool in_bond = false;            // every second course half a block aside
  double angle = 0.0, unit = 1.0;  // turned, and a metre in units of length
  const char* law = "bond: true";
  bool swapped = false;  // sides of every second contact
  const char* mesh = "order: 2";
  double across = 1e6, down = 1e6;  // pressures on the right and on top, Pa
};

/// A square wall under pressure from the right and from above, on rollers at the left and below: its stress is uniform.
std::string text_of(const Wall& wall) {
  const auto at = [&](double x, double y) {
    const double c = std::cos(wall.angle), s = std::sin(wall.angle);
    return fmt::format("[{:.17g}, {:.17g}]", wall.unit * (c * x - s * y), wall.unit * (s * x + c * y));
  };
  struct Block {
    int course;
    double left, right;
    std::string name;
  };
  std::vector<Block> blocks;
  std::string bodies, supports, loads, contacts;
  const double per_area = 1.0 / (wall.unit * wall.unit);
  for (int z = 0; z < wall.size; ++z) {
    std::vector<double> ends{0.0};
    const bool aside = wall.in_bond && z % 2 == 1;
    for (int k = aside ? 0 : 1; k < wall.size; ++k) ends.push_back(aside ? k + 0.5 : k);
    ends.push_back(wall.size);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const std::string name = fmt::format("b{}_{}", z, k);
      const double left = ends[k], right = ends[k + 1];
      blocks.push_back({z, left, right, name});
      const auto line = [&](const std::string& from, const std::string& to, const char* edge) {
        return fmt::format("{{line: {{from: {}, to: {}}}, name: {}}}", from, to, edge);
      };
      bodies += fmt::format("  {}: {{material: s, mesh: {{size: {}, {}}}, shape: {{outline: [{}, {}, {}, {}]}}}}\n",
                            name, 0.25 * wall.unit, wall.mesh, line(at(left, z), at(right, z), "bottom"),
                            line(at(right, z), at(right, z + 1), "right"),
                            line(at(right, z + 1), at(left, z + 1), "top"), line(at(left, z + 1), at(left, z), "left"));
      if (z == 0) supports += fmt::format("  - {{on: {}.bottom, fix: normal}}\n", name);
      if (k == 0) supports += fmt::format("  - {{on: {}.left, fix: normal}}\n", name);
      if (z + 1 == wall.size)
        loads += fmt::format("  top_{}: {{on: {}.top, pressure: {:.17g}}}\n", k, name, wall.down * per_area);
      if (k + 2 == ends.size())
        loads += fmt::format("  right_{}: {{on: {}.right, pressure: {:.17g}}}\n", z, name, wall.across * per_area);
    }
  }
  int number = 0;
  const auto add = [&](const std::string& one, const std::string& other) {
    const bool turned = wall.swapped && number % 2 == 1;
    contacts += fmt::format("  c{}: {{between: [{}, {}], {}}}\n", number++, turned ? other : one, turned ? one : other,
                            wall.law);
  };
  for (const Block& a : blocks)
    for (const Block& b : blocks) {
      if (b.course == a.course && b.left == a.right) add(a.name + ".right", b.name + ".left");
      if (b.course == a.course + 1 && std::min(a.right, b.right) > std::max(a.left, b.left))
        add(a.name + ".top", b.name + ".bottom");
    }
  return fmt::format(
             "scabo: 1\nanalysis: {{thickness: {}}}\nmaterials: {{s: {{young: {:.17g}, poisson: 0.2}}}}\nbodies:\n",
             wall.unit, 30e9 * per_area) +
         bodies + "supports:\n" + supports + "loads:\n" + loads + "contacts:\n" + contacts;
}

/// Every pair has the pressure of the uniform stress, and no shear.
void expect_uniform(const Wall& wall, double accuracy = 1e-8) {
  const analysis::StaticSolution solution = run(text_of(wall));
  const analysis::IncrementResult& increment = last(solution);
  const double per_area = 1.0 / (wall.unit * wall.unit);
  int pairs = 0;
  for (const analysis::ContactResult& contact : increment.contacts) {
    double area = 0.0, pressure = 0.0;
    for (const analysis::PairResult& pair : contact.pairs) {
      const double along = std::abs(pair.normal.x() * std::cos(wall.angle) + pair.normal.y() * std::sin(wall.angle));
      pressure = (along > 0.5 ? wall.across : wall.down) * per_area;
      EXPECT_NEAR(pair.pressure, pressure, accuracy * pressure) << contact.name << " pair " << pair.pair;
      EXPECT_NEAR(pair.shear, 0.0, accuracy * pressure) << contact.name << " pair " << pair.pair;
      area += pair.normal_force / pair.pressure;
      ++pairs;
    }
    EXPECT_NEAR(contact.normal_force, pressure * area, accuracy * pressure * area) << contact.name;
    EXPECT_NEAR(contact.tangential_force, 0.0, accuracy * pressure * area) << contact.name;
  }
  EXPECT_GT(pairs, 4 * wall.size);
}

TEST(SmoothestForces, OfFourBlocksAreUniform) {
  expect_uniform({});
  expect_uniform({.law = "friction: 0.5"});
  expect_uniform({.mesh = "order: 1"});
  expect_uniform({.mesh = "order: 1, kind: fem"});
}

TEST(SmoothestForces, OfNineAndThirtySixBlocksAreUniform) {
  for (const int size : {3, 6})
    for (const char* law : {"bond: true", "friction: 0.5"}) expect_uniform({.size = size, .law = law});
}

TEST(SmoothestForces, AreTheSameTurnedInOtherUnitsAndWithSidesSwapped) {
  expect_uniform({.size = 3, .angle = 0.3});
  expect_uniform({.size = 3, .angle = 0.3, .law = "friction: 0.5"});
  expect_uniform({.size = 3, .unit = 1e3});
  expect_uniform({.size = 3, .swapped = true});
}

// Where a joint ends on another one the shortest forces alone would not be uniform.
TEST(SmoothestForces, OfBlocksInBondAreUniform) {
  expect_uniform({.size = 4, .in_bond = true});
  expect_uniform({.size = 4, .in_bond = true, .angle = -0.7, .law = "friction: 0.5"});
  expect_uniform({.size = 3, .in_bond = true, .across = 2e6});
}

/// A shaft of radius 0.05 in a hub of 0.1, both cut into sectors that stick to each other, pressed into each other by
/// 5e-5: p = d E (1 - (a / b)^2) / (2 a) (Lame).
std::string press_fit(int sectors) {
  std::string text = "scabo: 1\nanalysis: {plane: stress}\nmaterials: {st: {young: 210e9, poisson: 0.3}}\nbodies:\n",
              contacts, hold;
  const auto at = [&](int k, double radius) {
    const double angle = 2.0 * 3.14159265358979323846 * k / sectors;
    return fmt::format("[{:.17g}, {:.17g}]", radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int k = 0; k < sectors; ++k) {
    const int next = (k + 1) % sectors;
    text += fmt::format(
        "  s{}: {{material: st, mesh: {{size: 0.0075}}, shape: {{outline: ["
        "{{line: {{from: [0, 0], to: {}}}, name: lo}}, {{arc: {{to: {}, centre: [0, 0]}}, name: rim}}, "
        "{{line: {{to: [0, 0]}}, name: hi}}]}}}}\n",
        k, at(k, 0.05), at(next, 0.05));
    text += fmt::format(
        "  h{}: {{material: st, mesh: {{size: 0.0075}}, shape: {{outline: ["
        "{{line: {{from: {}, to: {}}}, name: lo}}, {{arc: {{to: {}, centre: [0, 0]}}, name: out}}, "
        "{{line: {{to: {}}}, name: hi}}, {{arc: {{to: {}, centre: [0, 0], direction: clockwise}}, name: bore}}]}}}}\n",
        k, at(k, 0.05), at(k, 0.1), at(next, 0.1), at(next, 0.05), at(k, 0.05));
    contacts += fmt::format("  f{0}: {{between: [s{0}.rim, h{0}.bore], friction: 0, gap: -5e-5}}\n", k);
    contacts += fmt::format("  bs{0}: {{between: [s{0}.hi, s{1}.lo], bond: true}}\n", k, next);
    contacts += fmt::format("  bh{0}: {{between: [h{0}.hi, h{1}.lo], bond: true}}\n", k, next);
  }
  const double c = std::cos(2.0 * 3.14159265358979323846 / sectors),
               s = std::sin(2.0 * 3.14159265358979323846 / sectors);
  hold = fmt::format(
      "supports:\n  - {{on: {{body: s0, near: [0, 0]}}, fix: [x, y]}}\n"
      "  - {{on: {{body: s0, near: {}}}, fix: y}}\n  - {{on: {{body: h0, near: {}}}, fix: {{along: [{:.17g}, "
      "{:.17g}]}}}}\n",
      at(0, 0.05), at(1, 0.1), -s, c);
  return text + "contacts:\n" + contacts + hold;
}

TEST(SmoothestForces, OfAPressFitInSectorsAreThoseOfLame) {
  const double p = 5e-5 * 210e9 * 0.75 / 0.1;  // 7.875e7
  for (const int sectors : {4, 8}) {
    const analysis::StaticSolution solution = run(press_fit(sectors));
    const analysis::IncrementResult& increment = last(solution);
    for (const analysis::ContactResult& contact : increment.contacts) {
      if (contact.name[0] == 'f')
        for (const analysis::PairResult& pair : contact.pairs) EXPECT_NEAR(pair.pressure, p, 2e-3 * p) << contact.name;
      if (contact.name.substr(0, 2) == "bs") {
        EXPECT_NEAR(contact.normal_force, p * 0.05, 2e-3 * p * 0.05) << contact.name;
        for (const analysis::PairResult& pair : contact.pairs) {
          EXPECT_NEAR(pair.pressure, p, 5e-3 * p) << contact.name << " pair " << pair.pair;
          EXPECT_NEAR(pair.shear, 0.0, 5e-3 * p) << contact.name << " pair " << pair.pair;
        }
      }
    }
    EXPECT_TRUE(std::none_of(solution.warnings.begin(), solution.warnings.end(),
                             [](const Warning& warning) { return warning.kind == WarningKind::pressure; }));
  }
}

/// Two equal blocks side by side on a third one, with a gap between them and a shear strength in all joints.
analysis::StaticSolution apart_on_a_floor(const std::array<std::size_t, 3>& order) {
  const std::array<const char*, 3> bodies{"floor: {material: m, shape: {rectangle: {corner: [0, -1], size: [2, 1]}}",
                                          "left: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}",
                                          "right: {material: m, shape: {rectangle: {corner: [1, 0], size: [1, 1]}}"},
      contacts{"a: {between: [floor.top, left.bottom]", "b: {between: [floor.top, right.bottom]",
               "c: {between: [left.right, right.left], gap: 1e-6"};
  std::string text = "scabo: 1\nmaterials: {m: {young: 1e9, poisson: 0.2}}\nbodies:\n";
  for (const std::size_t i : order) text += fmt::format("  {}, mesh: {{size: 0.5}}}}\n", bodies[i]);
  text +=
      "supports: [{on: floor.bottom, fix: [x, y]}]\nloads: {p: {on: left.top, pressure: 1e5}, q: {on: right.top, "
      "pressure: 1e5}}\ncontacts:\n";
  for (const std::size_t i : order) text += fmt::format("  {}, shear_strength: 1e5}}\n", contacts[i]);
  return run(text);
}

// Open pairs carry shear up to a strength that pressure does not change. Where three bodies meet in a point, the two
// pairs on the floor may exchange any force by the shear of the third one: none by symmetry, whatever the order.
TEST(SmoothestForces, OfOpenPairsThatCarryShear) {
  for (const std::array<std::size_t, 3>& order : {std::array<std::size_t, 3>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
    const auto solution = apart_on_a_floor(order);
    EXPECT_TRUE(std::any_of(solution.warnings.begin(), solution.warnings.end(),
                            [](const auto& warning) { return warning.kind == WarningKind::undetermined_force; }));
    for (const analysis::ContactResult& contact : last(solution).contacts) {
      const bool upright = contact.pairs.front().normal.x() != 0.0;
      if (upright) EXPECT_NEAR(contact.tangential_force, 0.0, 1e-6 * 1e5);
      if (!upright) EXPECT_NEAR(contact.normal_force, 1e5, 1e-9 * 1e5);
    }
  }
}

// A rigid block on a floor whose points are all held, under a force beside its middle: pressures along a line (Navier),
// N / A (1 + 12 e x / b^2), where the shortest ones are looked for, and a triangle beyond the kern, where no pair
// pulls.
TEST(SmoothestForces, OfARigidBlockAreAlongALine) {
  const auto block = [](double place) {
    return fmt::format(
        "scabo: 1\nmaterials: {{s: {{young: 1e9, poisson: 0.2}}}}\nbodies:\n"
        "  floor: {{material: s, shape: {{rectangle: {{corner: [0, -1], size: [2, 1]}}}}, mesh: {{size: 0.125, order: "
        "1}}}}\n  block: {{rigid: true, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}}}\n"
        "supports: [{{on: floor.top, fix: [x, y]}}]\n"
        "loads: {{press: {{on: block, force: [0, -10]}}, turn: {{on: block, moment: {}}}}}\n"
        "contacts: {{base: {{between: [floor.top, block.bottom], friction: 0.5}}}}\n",
        -10.0 * place);
  };
  const analysis::StaticSolution solution = run(block(0.2));
  for (const analysis::PairResult& pair : contact_of(last(solution)).pairs) {
    const double x = pair.position.x() - 1.0;
    EXPECT_NEAR(pair.shear, 0.0, 1e-8);
    // Of the trapezoidal rule: the second moment of the tributary lengths is 2^3 / 12 + 2 * 0.125^2 / 6.
    const double inertia = 8.0 / 12.0 + 2.0 * 0.125 * 0.125 / 6.0;
    EXPECT_NEAR(pair.pressure, 5.0 + 10.0 * 0.2 * x / inertia, 1e-8) << x;
  }
  const analysis::StaticSolution beyond = run(block(0.8));  // 0.2 from the edge: a triangle 0.6 long
  for (const analysis::PairResult& pair : contact_of(last(beyond)).pairs) {
    EXPECT_GE(pair.normal_force, 0.0);
    if (pair.position.x() < 2.0 - 0.75) EXPECT_EQ(pair.normal_force, 0.0) << pair.position.x();
  }
}

// Sliding until a spring takes what friction does not, its pairs stay at the bound of friction, against the slip.
TEST(SmoothestForces, OfARigidBlockThatSlidesAreAlongALine) {
  for (const double side : {1.0, -1.0}) {
    const analysis::StaticSolution solution =
        run(fmt::format("scabo: 1\nmaterials: {{s: {{young: 1e9, poisson: 0.2}}}}\nbodies:\n"
                        "  floor: {{material: s, shape: {{rectangle: {{corner: [0, -1], size: [2, 1]}}}}, mesh: "
                        "{{size: 0.25, order: 1}}}}\n"
                        "  block: {{rigid: true, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}}}\n"
                        "supports: [{{on: floor.top, fix: [x, y]}}]\nsprings: [{{on: block.right, k_n: 500, k_t: 0}}]\n"
                        "loads: {{press: {{on: block, force: [{}, -10]}}}}\n"
                        "contacts: {{base: {{between: [floor.top, block.bottom], friction: 0.2}}}}\n",
                        4.0 * side));
    const std::vector<analysis::PairResult>& pairs = contact_of(last(solution)).pairs;
    ASSERT_EQ(pairs.size(), 9u);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(pairs[i].state, contact::ContactState::slip);
      EXPECT_NEAR(pairs[i].shear, -side * 0.2 * pairs[i].pressure, 1e-9);
      if (i > 1)
        EXPECT_NEAR(pairs[i].pressure - 2.0 * pairs[i - 1].pressure + pairs[i - 2].pressure, 0.0, 1e-8) << side << i;
    }
  }
}

// Nine blocks that stick to each other with tensile strength, under their weight: where four of them meet, some joints
// pull by all their strength. The forces of a symmetric wall are symmetric, whichever of them the solver has found.
TEST(SmoothestForces, OfBlocksThatPullAreSymmetric) {
  std::string bodies, contacts;
  const auto name = [](int column, int course) { return fmt::format("b{}{}", column, course); };
  const char* const law = "friction: 0.3, cohesion: 1e4, tension: 1e3";
  for (int z = 0; z < 3; ++z)
    for (int x = 0; x < 3; ++x) {
      bodies += fmt::format(
          "  {}: {{material: s, mesh: {{size: 0.25}}, shape: {{rectangle: {{corner: [{}, {}], size: [1, 0.5]}}}}}}\n",
          name(x, z), x, 0.5 * z);
      contacts += fmt::format("  v{}{}: {{between: [{}.top, {}.bottom], {}}}\n", x, z, z > 0 ? name(x, z - 1) : "floor",
                              name(x, z), law);
      if (x > 0)
        contacts +=
            fmt::format("  h{}{}: {{between: [{}.right, {}.left], {}}}\n", x, z, name(x - 1, z), name(x, z), law);
    }
  const analysis::StaticSolution solution = run(
      fmt::format("scabo: 1\nanalysis: {{plane: strain}}\n"
                  "materials: {{s: {{young: 3e9, poisson: 0.2, density: 2500}}}}\nbodies:\n"
                  "  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [6, 1]}}}}}}\n{}"
                  "supports: [{{on: floor, fix: [x, y]}}]\nloads: {{weight: {{gravity: [0, -9.81]}}}}\ncontacts:\n{}",
                  bodies, contacts));
  const analysis::IncrementResult& end = last(solution);
  const auto of = [&](const std::string& contact) -> const analysis::ContactResult& {
    for (std::size_t c = 0; c < solution.model.contacts.size(); ++c)
      if (solution.model.contacts[c].name == contact) return contact_of(end, c);
    throw std::runtime_error("no contact " + contact);
  };
  double least = 0.0;
  for (int z = 0; z < 3; ++z) {
    const analysis::ContactResult &left = of(fmt::format("v0{}", z)), &right = of(fmt::format("v2{}", z));
    EXPECT_NEAR(left.normal_force, right.normal_force, 1e-6) << z;
    EXPECT_NEAR(left.tangential_force, -right.tangential_force, 1e-6) << z;
    const analysis::ContactResult &one = of(fmt::format("h1{}", z)), &other = of(fmt::format("h2{}", z));
    EXPECT_NEAR(one.normal_force, other.normal_force, 1e-6) << z;
    EXPECT_NEAR(one.tangential_force, -other.tangential_force, 1e-6) << z;
    for (const analysis::PairResult& pair : one.pairs) least = std::min(least, pair.pressure);
  }
  EXPECT_LT(least, -100.0) << "the test is meant to have joints that pull";
}

}  // namespace
}  // namespace scabo::verification
