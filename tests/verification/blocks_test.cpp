// Towers and walls of blocks that contact alone holds, pushed from the left. Statics of the whole (width B, height H,
// weight rho g per volume, push q per area) is the oracle:
//
//     every joint slides at q = mu rho g B;     the whole turns about its toe at q = rho g B^2 / H
//
// Two elastic blocks have one verdict in every size and unit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "run.hpp"

namespace scabo::verification {
namespace {

constexpr double weight_per_volume = 2000.0 * 9.81;

struct Blocks {
  int columns, courses;
  double friction;
  double unit = 1.0;  ///< length of a block in the model's unit of length; forces stay in N

  double height() const { return columns == 1 ? 1.0 : 0.5; }  // of a block
  double width() const { return columns; }
  double whole_height() const { return courses * height(); }
  double weight() const { return weight_per_volume * width() * whole_height(); }
  double collapse_push() const {
    return std::min(friction * weight_per_volume * width(), weight_per_volume * width() * width() / whole_height());
  }
};

std::vector<std::pair<double, double>> spans_of_course(const Blocks& blocks, int course) {
  std::vector<std::pair<double, double>> spans;
  const bool shifted = blocks.columns > 1 && course % 2 == 1;  // running bond: half blocks at the ends
  for (double left = 0.0; left < blocks.columns;) {
    const double size = shifted && (left == 0.0 || left == blocks.columns - 0.5) ? 0.5 : 1.0;
    spans.emplace_back(left, left + size);
    left += size;
  }
  return spans;
}

/// In a model whose unit of length is `unit` times smaller than the metre.
std::string model_of(const Blocks& blocks, double push, int increments) {
  const double s = blocks.unit, area = s * s;
  std::string bodies =
                  fmt::format("  floor: {{rigid: true, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}}}\n",
                              -s, -s, (blocks.columns + 2) * s, s),
              contacts, loads, factors;
  std::vector<std::pair<double, double>> below;
  int count = 0;
  const auto touch = [&](const std::string& a, const std::string& b) {
    contacts += fmt::format("  c{}: {{between: [{}, {}], friction: {}}}\n", ++count, a, b, blocks.friction);
  };
  for (int z = 0; z < blocks.courses; ++z) {
    const auto spans = spans_of_course(blocks, z);
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const auto [left, right] = spans[k];
      bodies += fmt::format(
          "  b{}_{}: {{material: stone, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}, "
          "mesh: {{size: {}, order: 1}}}}\n",
          z, k, left * s, z * blocks.height() * s, (right - left) * s, blocks.height() * s, 0.25 * s);
      if (k > 0) touch(fmt::format("b{}_{}.right", z, k - 1), fmt::format("b{}_{}.left", z, k));
      if (z == 0) touch("floor.top", fmt::format("b0_{}.bottom", k));
      for (std::size_t j = 0; j < below.size(); ++j)
        if (std::min(below[j].second, right) - std::max(below[j].first, left) > 0.1)
          touch(fmt::format("b{}_{}.top", z - 1, j), fmt::format("b{}_{}.bottom", z, k));
    }
    below = spans;
    loads += fmt::format("  push_{}: {{on: b{}_0.left, traction: [{}, 0]}}\n", z, z, push / area);
    factors += fmt::format(", push_{}: 1", z);
  }
  const std::string steps = increments == 1
                                ? fmt::format("  - {{name: push, loads: {{weight: 1{}}}}}\n", factors)
                                : fmt::format(
                                      "  - {{name: weight, loads: {{weight: 1}}}}\n  - {{name: push, increments: {}, "
                                      "loads: {{weight: 1{}}}}}\n",
                                      increments, factors);
  return fmt::format(
      "scabo: 1\nanalysis: {{type: static, plane: stress, thickness: {}}}\n"
      "materials: {{stone: {{young: {}, poisson: 0.2, density: {}}}}}\nbodies:\n{}supports: [{{on: floor, fix: "
      "[x, y]}}]\nloads:\n  weight: {{gravity: [0, -9.81]}}\n{}contacts:\n{}steps:\n{}",
      s, 5e9 / area, 2000.0 / (area * s), bodies, loads, contacts, steps);
}

/// Normal and tangential force of the joints on the floor.
Vec2 floor_forces(const Blocks& blocks, const analysis::StaticSolution& solution,
                  const analysis::IncrementResult& increment) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t c = 0; c < increment.contacts.size(); ++c)
    if (solution.model.bodies[static_cast<std::size_t>(solution.model.contacts[c].a.body)].name == "floor")
      sum += Vec2(increment.contacts[c].normal_force, increment.contacts[c].tangential_force);
  EXPECT_GE(increment.contacts.size(), static_cast<std::size_t>(blocks.courses));
  return sum;
}

void holds(const Blocks& blocks, double part, int increments) {
  SCOPED_TRACE(fmt::format("{} x {}, mu {}, {} of the collapse push, {} increments", blocks.columns, blocks.courses,
                           blocks.friction, part, increments));
  const double push = part * blocks.collapse_push();
  const analysis::StaticSolution solution = run(model_of(blocks, push, increments));
  const Vec2 carried = floor_forces(blocks, solution, last(solution));
  EXPECT_NEAR(carried[0], blocks.weight(), 1e-9 * blocks.weight());
  EXPECT_NEAR(carried[1], -push * blocks.whole_height(), 1e-9 * blocks.weight());  // B above: friction against the push
  for (const analysis::IncrementResult& increment : solution.increments) {
    EXPECT_LE(increment.newton_iterations, 10);
    EXPECT_EQ(increment.halvings, 0);
  }
}

TEST(Tower, StandsToItsCollapsePush) {
  for (const int courses : {2, 10, 50})
    for (const double friction : {0.3, 1.0})
      for (const double part : {0.0, 0.5, 0.99}) holds({1, courses, friction}, part, 1);
}

TEST(Tower, StandsToItsCollapsePushInTenIncrements) {
  for (const int courses : {10, 50}) holds({1, courses, 0.6}, 0.99, 10);
}

TEST(Tower, FallsAboveItsCollapsePush) {
  for (const Blocks& blocks : {Blocks{1, 2, 0.3}, Blocks{1, 10, 0.6}, Blocks{1, 50, 0.6}}) {
    const auto solution = run(model_of(blocks, 1.01 * blocks.collapse_push(), 1));
    EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism) << blocks.courses << ": " << solution.reason;
  }
}

TEST(Wall, InRunningBondCarriesWeightAndPush) {
  for (const int size : {4, 8})
    for (const double friction : {0.3, 0.6})
      for (const double part : {0.0, 0.5}) holds({size, size, friction}, part, 1);
}

TEST(Tower, OfTwoHundredBlocksStandsToItsCollapsePush) {
  for (const double friction : {0.3, 1.0})
    for (const double part : {0.5, 0.9, 0.99}) holds({1, 200, friction}, part, 1);
}

// Near its collapse load hundreds of joints of a wall have opened or slip, and a path of equilibria follows Newton.
TEST(Wall, CarriesNearlyItsCollapsePush) {
  const auto carries = [](const Blocks& blocks, double part) {
    const double push = part * blocks.collapse_push();
    const analysis::StaticSolution solution = run(model_of(blocks, push, 1));
    const Vec2 carried = floor_forces(blocks, solution, last(solution));
    EXPECT_NEAR(carried[0], blocks.weight(), 1e-8 * blocks.weight());
    EXPECT_NEAR(carried[1], -push * blocks.whole_height(), 1e-8 * blocks.weight());
    EXPECT_LE(last(solution).newton_iterations, 13);
    EXPECT_EQ(last(solution).halvings, 0);
  };
  for (const double friction : {0.3, 0.6, 1.0}) carries({4, 4, friction}, 0.99);
  for (const double friction : {0.3, 0.6}) carries({8, 8, friction}, 0.99);
  carries({8, 8, 1.0}, 0.9);
}

TEST(Wall, CarriesNearlyItsCollapsePushInTenIncrements) {
  for (const double friction : {0.3, 0.6, 1.0}) holds({4, 4, friction}, 0.99, 10);
}

// Forces within the cones balance the push, so that it is no mechanism; but the equilibria that the push passes through
// end at 0.93 of it (docs/methods/12), and no other was found.
TEST(Wall, WithStrongFrictionFallsBeforeItsLimitLoad) {
  const Blocks blocks{8, 8, 1.0};
  EXPECT_EQ(run(model_of(blocks, 0.92 * blocks.collapse_push(), 1)).outcome, analysis::Outcome::solved);
  const auto solution = run(model_of(blocks, 0.99 * blocks.collapse_push(), 1));
  EXPECT_EQ(solution.outcome, analysis::Outcome::collapse) << solution.reason;
  EXPECT_EQ(solution.increments.back().halvings, 0);
}

// A wall of separate blocks falls before the whole slides or turns: parts of it turn, along steps in the bond. Limit
// analysis (the largest push for which forces within the friction cones of all joints balance every block, a linear
// programme, benchmarks/blocks) gives 0.978 of that push for 16 x 16 blocks and friction 0.6; no solution exists above.
TEST(Wall, OfManyBlocksFallsBeforeTheWholeSlides) {
  const Blocks blocks{16, 16, 0.6};
  const auto solution = run(model_of(blocks, 0.98 * blocks.collapse_push(), 1));
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism) << solution.reason;
}

TEST(Wall, SlidesAtItsCollapsePush) {
  const Blocks blocks{4, 4, 0.3};
  EXPECT_EQ(run(model_of(blocks, 0.99 * blocks.collapse_push(), 1)).outcome, analysis::Outcome::solved);
  EXPECT_EQ(run(model_of(blocks, 1.01 * blocks.collapse_push(), 1)).outcome, analysis::Outcome::mechanism);
}

// A block 4 x 0.5 m close below a ceiling. Forces of floor and ceiling, both pressed, could balance any push, but
// nothing presses the block against the ceiling: it slides at mu times its weight, mu rho g 2 m^2 = 19,620 N.
TEST(Block, BelowACeilingSlidesAtTheFrictionLimitOfTheFloor) {
  const auto under = [](double traction) {
    return run(fmt::format(
        "scabo: 1\nmaterials: {{stone: {{young: 5e9, poisson: 0.2, density: 2000}}}}\nbodies:\n"
        "  floor: {{rigid: true, shape: {{rectangle: {{corner: [-2, -1], size: [8, 1]}}}}}}\n"
        "  ceiling: {{rigid: true, shape: {{rectangle: {{corner: [-2, 0.501], size: [8, 1]}}}}}}\n"
        "  block: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [4, 0.5]}}}}, mesh: {{size: 0.25, "
        "order: "
        "1}}}}\n"
        "supports: [{{on: floor, fix: [x, y]}}, {{on: ceiling, fix: [x, y]}}]\n"
        "loads:\n  weight: {{gravity: [0, -9.81]}}\n  push: {{on: block.left, traction: [{}, 0]}}\n"
        "contacts:\n  below: {{between: [floor.top, block.bottom], friction: 0.5}}\n"
        "  above: {{between: [block.top, ceiling.bottom], friction: 0.5}}\n"
        "steps:\n  - {{name: weight, loads: {{weight: 1}}}}\n  - {{name: push, loads: {{weight: 1, push: 1}}}}\n",
        traction));
  };
  const double limit = 0.5 * weight_per_volume * 2.0 / 0.5;  // as a traction
  EXPECT_EQ(under(0.99 * limit).outcome, analysis::Outcome::solved);
  const auto solution = under(2.0 * limit);
  EXPECT_EQ(solution.outcome, analysis::Outcome::collapse);
  EXPECT_NE(solution.reason.find("collapse: equilibrium ends at 0.5 of the increment"), std::string::npos)
      << solution.reason;
  EXPECT_NE(solution.reason.find("body 'block': translation along (1, 0)"), std::string::npos) << solution.reason;
}

// The same in millimetres and in kilometres: the same forces and iterations, and what falls falls by the same verdict.
TEST(Tower, IsTheSameInEveryUnit) {
  for (const double part : {0.5, 1.01}) {
    const Blocks metres{1, 10, 0.6};
    const auto first = run(model_of(metres, part * metres.collapse_push(), 1));
    for (const double unit : {1e3, 1e-3, 10.0, 0.1}) {
      Blocks other = metres;
      other.unit = unit;
      const auto solution = run(model_of(other, part * metres.collapse_push(), 1));
      ASSERT_EQ(solution.outcome, first.outcome) << unit << ": " << solution.reason;
      if (part > 1.0) continue;
      EXPECT_EQ(last(solution).newton_iterations, last(first).newton_iterations) << unit;
      EXPECT_LT((floor_forces(other, solution, last(solution)) - floor_forces(metres, first, last(first))).norm(),
                1e-9 * metres.weight())
          << unit;
    }
  }
}

/// Two square blocks of `size` m, the lower one fixed at its bottom, the upper one held by contact alone.
struct TwoBlocks {
  std::string name;
  double friction;
  std::string loads;  ///< N stands for a thousandth of the weight of a block
  analysis::Outcome expected;
  double normal_force;  ///< of the joint, in the same unit
  std::string mesh = "order: 1";
  double shift = 0.0;  ///< of the upper block, in sizes
};

/// `unit`: a metre in the model's unit of length. Weight grows with the area.
std::string model_of(const TwoBlocks& blocks, double size, double unit) {
  const double side = size * unit, area = unit * unit, force = 1e3 * size * size;
  std::string loads = blocks.loads;
  for (std::size_t at = 0; (at = loads.find(" N", at)) != std::string::npos;) {
    const std::size_t start = loads.find_last_of(" [", at - 1) + 1;
    const std::string number = fmt::format("{}", std::stod(loads.substr(start, at - start)) * force / 1e3);
    loads.replace(start, at + 2 - start, number);
    at = start + number.size();
  }
  const auto body = [&](double left, double bottom) {
    return fmt::format(
        "{{material: m, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}, mesh: {{size: {}, {}}}}}", left,
        bottom, side, side, 0.25 * side, blocks.mesh);
  };
  return fmt::format(
      "scabo: 1\nanalysis: {{plane: stress, thickness: {}}}\n"
      "materials: {{m: {{young: {}, poisson: 0.2, density: {}, expansion: 1e-5}}}}\n"
      "bodies:\n  lower: {}\n  upper: {}\nsupports: [{{on: lower.bottom, fix: [x, y]}}]\nloads:\n{}"
      "contacts: {{joint: {{between: [lower.top, upper.bottom], friction: {}}}}}\n",
      unit, 1e10 / area, 100.0 / (area * unit), body(0.0, 0.0), body(blocks.shift * side, side), loads,
      blocks.friction);
}

constexpr double sizes[] = {100.0, 10.0, 1.0, 0.1, 0.01, 0.001};

const std::string weight = "  weight: {gravity: [0, -10]}\n";  // 1000 N
const TwoBlocks cases[] = {
    {"at rest", 0.5, weight, analysis::Outcome::solved, 1000},
    {"at rest without friction", 0.0, weight, analysis::Outcome::solved, 1000},
    {"pushed below the friction limit", 0.5, weight + "  push: {on: upper.left, force: [499 N, 0]}\n",
     analysis::Outcome::solved, 1000},
    {"pushed beyond it", 0.5, weight + "  push: {on: upper.left, force: [501 N, 0]}\n", analysis::Outcome::mechanism,
     0},
    {"pushed over", 2.0, weight + "  push: {on: upper.top_left, force: [501 N, 0]}\n", analysis::Outcome::mechanism, 0},
    {"loaded in the middle", 0.5, "  press: {on: upper.top, force: [0, -1000 N]}\n", analysis::Outcome::solved, 1000},
    {"lifted", 0.5, "  lift: {on: upper.top, force: [0, 1000 N]}\n", analysis::Outcome::mechanism, 0},
    {"pushed without weight", 0.5, "  push: {on: upper.left, force: [1000 N, 0]}\n", analysis::Outcome::mechanism, 0},
    {"lifted by as much as its weight", 0.5, weight + "  lift: {on: upper.top, force: [0, 1000 N]}\n",
     analysis::Outcome::solved, 0, "order: 2", 0.25},
    {"squeezed", 0.0, "  left: {on: upper.left, force: [1000 N, 0]}\n  right: {on: upper.right, force: [-1000 N, 0]}\n",
     analysis::Outcome::solved, 0},
    {"squeezed, finite elements", 0.0,
     weight + "  left: {on: upper.left, force: [700 N, 0]}\n  right: {on: upper.right, force: [-700 N, 0]}\n",
     analysis::Outcome::solved, 1000, "kind: fem"},
    {"heated without friction", 0.0, weight + "  summer: {temperature: 3}\n", analysis::Outcome::solved, 1000},
};

TEST(TwoElasticBlocks, HaveOneVerdictInEverySizeAndUnit) {
  for (const TwoBlocks& blocks : cases)
    for (const double size : sizes) {
      SCOPED_TRACE(fmt::format("{}, {} m", blocks.name, size));
      const auto metres = run(model_of(blocks, size, 1.0)), millimetres = run(model_of(blocks, size, 1000.0));
      ASSERT_EQ(metres.outcome, blocks.expected) << metres.reason;
      ASSERT_EQ(millimetres.outcome, blocks.expected) << millimetres.reason;
      if (blocks.expected != analysis::Outcome::solved) continue;
      const double weight_of_block = 1000.0 * size * size;
      const analysis::ContactResult &joint = contact_of(last(metres)), &other = contact_of(last(millimetres));
      EXPECT_NEAR(joint.normal_force / weight_of_block, blocks.normal_force / 1000.0, 1e-8);
      for (std::size_t i = 0; i < joint.pairs.size(); ++i) {
        EXPECT_NEAR(other.pairs[i].normal_force, joint.pairs[i].normal_force, 1e-8 * weight_of_block);
        EXPECT_NEAR(other.pairs[i].tangential_force, joint.pairs[i].tangential_force, 1e-8 * weight_of_block);
      }
    }
}

}  // namespace
}  // namespace scabo::verification
