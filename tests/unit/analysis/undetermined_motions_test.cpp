// Which motion of a loose body is given: the smallest one, in any unit.
#include "scabo/analysis/diagnostics/undetermined_motions.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::analysis {
namespace {

/// A block of 2 m x 1 m that is pushed into a corner, let go and then warmed or cooled by `change` degrees, in which it
/// expands by 1e-5 times as much. `metre`: in the unit of length.
StaticSolution loose_block(double change, double metre) {
  const auto at = [&](double x, double y) { return fmt::format("[{}, {}]", x * metre, y * metre); };
  const std::string text = fmt::format(
      R"(scabo: 1
materials: {{stone: {{young: {0}, poisson: 0.25, expansion: 1e-5}}}}
bodies:
  block: {{material: stone, shape: {{rectangle: {{corner: {1}, size: {2}}}}}, mesh: {{size: {3}}}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: {4}, size: {5}}}}}}}
  wall: {{rigid: true, shape: {{rectangle: {{corner: {4}, size: {6}}}}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: wall, fix: [x, y]}}]
loads:
  push: {{on: block, body_force: [-{7}, -{7}]}}
  change: {{on: block, temperature: {8}}}
contacts:
  base: {{between: [floor.top, block.bottom], friction: 0.3}}
  side: {{between: [wall.right, block.left], friction: 0.3}}
steps:
  - {{loads: {{push: 1}}}}
  - {{loads: {{push: 0}}}}
  - {{loads: {{change: 1}}}}
)",
      20e9 / metre / metre, at(0, 0), at(2, 1), 0.25 * metre, at(-1, -1), at(4, 1), at(1, 3),
      1e5 / metre / metre / metre, change);
  return solve_static(input::parse_model(text, "model.yaml"));
}

/// What a node of the block has moved in the last increment.
struct Moved {
  Vec2 from, by;
};
std::vector<Moved> last_motion(const StaticSolution& solution) {
  std::vector<Moved> moved;
  const std::vector<Vec2>& nodes = solution.mesh.bodies[0].nodes;
  const Vector by =
      solution.increments.at(2).fields.displacements[0] - solution.increments.at(1).fields.displacements[0];
  for (std::size_t node = 0; node < nodes.size(); ++node) moved.push_back({nodes[node], by.segment<2>(place_of(node))});
  return moved;
}

TEST(UndeterminedMotions, ABodyThatShrinksKeepsItsMiddle) {
  for (const double metre : {1.0, 1000.0}) {
    const StaticSolution solution = loose_block(-30, metre);
    ASSERT_EQ(solution.outcome, Outcome::solved) << solution.reason;
    for (const auto& [from, by] : last_motion(solution))
      EXPECT_LT((by + 30e-5 * (from - Vec2(1.0, 0.5) * metre)).norm(), 1e-12 * metre) << from.transpose();
  }
}

// It would have to move both ways about its middle, and is in a corner.
TEST(UndeterminedMotions, ABodyThatGrowsMovesNoFurtherThanItsNeighboursPushIt) {
  for (const double metre : {1.0, 1000.0}) {
    const StaticSolution solution = loose_block(30, metre);
    ASSERT_EQ(solution.outcome, Outcome::solved) << solution.reason;
    for (const auto& [from, by] : last_motion(solution))
      EXPECT_LT((by - 30e-5 * from).norm(), 1e-12 * metre) << from.transpose();
  }
}

}  // namespace
}  // namespace scabo::analysis
