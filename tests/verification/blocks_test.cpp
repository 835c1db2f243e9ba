// Towers and walls of blocks that contact alone holds, pushed from the left. Statics of the whole (width B, height H,
// weight rho g per volume, push q per area) is the oracle:
//
//     every joint slides at q = mu rho g B;     the whole turns about its toe at q = rho g B^2 / H
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

TEST(Wall, SlidesAtItsCollapsePush) {
  const Blocks blocks{4, 4, 0.3};
  EXPECT_EQ(run(model_of(blocks, 0.99 * blocks.collapse_push(), 1)).outcome, analysis::Outcome::solved);
  EXPECT_EQ(run(model_of(blocks, 1.01 * blocks.collapse_push(), 1)).outcome, analysis::Outcome::mechanism);
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

}  // namespace
}  // namespace scabo::verification
