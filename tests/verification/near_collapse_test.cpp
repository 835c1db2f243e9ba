// The warning that bodies are close to the load under which they fall. benchmarks/blocks/fall.py, explicit dynamics
// with other elements, lets the wall of 8 x 8 blocks with a friction of 1 fall between 0.90 and 0.92 of its limit load.
#include <algorithm>
#include <string>

#include "blocks.hpp"
#include "run.hpp"

namespace scabo::verification {
namespace {

/// The text of the warning, or nothing; the run must be solved.
std::string told(const analysis::StaticSolution& solution) {
  last(solution);
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::near_collapse) return warning.text;
  return {};
}

std::string told_of_wall(const Blocks& blocks, double part, int increments) {
  return told(run(model_of(blocks, part * blocks.collapse_push(), increments)));
}

TEST(NearCollapse, IsToldOfAWallThatMovesByManyTimesItsDeformation) {
  const Blocks wall{8, 8, 1.0};
  EXPECT_EQ(told_of_wall(wall, 0.7, 10), "");
  const std::string text = told_of_wall(wall, 0.92, 10);
  EXPECT_NE(text.find("step push, increment 10: friction has dissipated"), std::string::npos) << text;
  EXPECT_NE(text.find("body 'b7_"), std::string::npos) << text;  // of the highest course
  EXPECT_NE(told_of_wall(wall, 0.92, 1), "");
  Blocks twin = wall;
  twin.unit = 1000.0;
  twin.angle = 30.0;
  twin.mirrored = true;
  EXPECT_EQ(told_of_wall(twin, 0.7, 10), "");
  EXPECT_NE(told_of_wall(twin, 0.92, 10), "");
}

TEST(NearCollapse, IsNotToldOfWallsAndTowersThatStand) {
  for (const double friction : {0.3, 0.6}) EXPECT_EQ(told_of_wall({8, 8, friction}, 0.8, 10), "") << friction;
  EXPECT_EQ(told_of_wall({1, 10, 0.6}, 0.99, 10), "");  // it turns; nothing slides
}

/// A block of 2 x 1 m under its weight on a rigid floor, friction 0.5, pushed to the right in ten increments.
std::string block(const std::string& more_bodies, const std::string& supports, const std::string& loads,
                  const std::string& more_contacts, const std::string& push) {
  return "scabo: 1\nmaterials: {stone: {young: 5e9, poisson: 0.2, density: 2000}}\nbodies:\n"
         "  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [8, 1]}}}\n"
         "  block: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25, order: "
         "1}}\n" +
         more_bodies + "supports:\n  - {on: floor, fix: [x, y]}\n" + supports +
         "loads:\n  weight: {gravity: [0, -9.81]}\n  push: {on: block.left, traction: [1, 0]}\n" + loads +
         "contacts:\n  base: {between: [floor.top, block.bottom], friction: 0.5}\n" + more_contacts +
         "steps:\n  - {name: weight, loads: {weight: 1}}\n  - {name: push, increments: 10, " + push + "}\n";
}

TEST(NearCollapse, IsNotToldOfABlockThatSlidesToAStop) {
  const std::string stop = "  stop: {rigid: true, shape: {rectangle: {corner: [2.01, 0], size: [1, 1]}}}\n";
  const analysis::StaticSolution solution =
      run(block(stop, "  - {on: stop, fix: [x, y]}\n", "", "  end: {between: [block.right, stop.left], friction: 0}\n",
                "loads: {weight: 1, push: 4e4}"));
  EXPECT_EQ(told(solution), "");
  const analysis::Energy& energy = last(solution).energy;
  const double work = 0.5 * 2 * 2000 * 9.81 * 0.01;  // mu N over the gap of 10 mm, but for what increments lose
  EXPECT_NEAR(energy.friction, work, 0.1 * work);
  EXPECT_GT(energy.friction, 10.0 * energy.elastic);  // it would be told but for the gap
}

TEST(NearCollapse, IsNotToldOfABlockThatASupportMoves) {
  const analysis::StaticSolution driven =
      run(block("", "  - {on: block.left, displacement: [0.01, null], name: drive}\n", "", "",
                "loads: {weight: 1, push: 1, drive: 1}"));
  EXPECT_EQ(told(driven), "");
  EXPECT_GT(last(driven).energy.friction, 10.0 * last(driven).energy.elastic);
}

TEST(NearCollapse, IsNotToldOfABlockThatExpands) {
  const analysis::StaticSolution heated =
      run(block("", "", "  heat: {on: block, temperature: 60}\n", "", "loads: {weight: 1, push: 1, heat: 1}"),
          {"materials.stone.expansion=1e-5"});
  EXPECT_EQ(told(heated), "");
  EXPECT_GT(last(heated).energy.friction, 10.0 * last(heated).energy.elastic);
}

TEST(NearCollapse, IsNotToldOfABlockThatSlidesAgainstASpring) {
  const analysis::StaticSolution sprung =
      run(block("", "springs:\n  - {on: block.right, k_n: 1e4}\n", "", "", "loads: {weight: 1, push: 2.1e4}"));
  EXPECT_EQ(told(sprung), "");
  EXPECT_GT(last(sprung).energy.friction, 5.0 * last(sprung).energy.elastic);
}

}  // namespace
}  // namespace scabo::verification
