// Forces of pairs that are not unique although displacements are: bodies that meet in a point, and rigid bodies with
// more pairs than equations of equilibrium. How many pairs, and which totals, follows by hand.
#include "scabo/analysis/diagnostics/undetermined_forces.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "scabo/analysis/quasistatic/attempt.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::analysis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The text of the warning; empty where there is none.
std::string warned(const std::string& text) {
  const StaticSolution solution = solve_static(input::parse_model(text, "model.yaml"));
  EXPECT_EQ(solution.outcome, Outcome::solved) << solution.reason;
  std::string found;
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::undetermined_force) {
      EXPECT_EQ(found, "") << "said twice";
      found = warning.text;
    }
  return found;
}

/// A stone over two others, all 1 or 2 times `size` wide, on supports; what is between the lower two.
std::string three_stones(double size, const std::string& between_lower_ones,
                         const std::string& friction = "bond: true") {
  const auto stone = [&](const char* name, double x, double y, double width) {
    return fmt::format(
        "  {}: {{material: stone, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}, mesh: {{size: {}, order: "
        "1}}}}\n",
        name, x * size, y * size, width * size, size, 0.5 * size);
  };
  return "scabo: 1\nmaterials: {stone: {young: 1e9, poisson: 0.2}}\nbodies:\n" + stone("left", 0, 0, 1) +
         stone("right", 1, 0, 1) + stone("top", 0, 1, 2) +
         "supports: [{on: left.bottom, fix: [x, y]}, {on: right.bottom, fix: [x, y]}]\n"
         "loads: {press: {on: top.top, traction: [1e4, -1e5]}}\ncontacts:\n" +
         "  on_left: {between: [left.top, top.bottom], " + friction + "}\n" +
         "  on_right: {between: [right.top, top.bottom], " + friction + "}\n" + between_lower_ones;
}

constexpr const char* bonded = "  between: {between: [left.right, right.left], bond: true}\n";

// The three pairs in the point where all three meet pass any force around it; five others are unique, and the two that
// supports hold are no pairs.
TEST(UndeterminedForces, OfThreeBodiesThatMeetInAPoint) {
  for (const double size : {1.0, 1e-3, 1e3})
    EXPECT_THAT(warned(three_stones(size, bonded)),
                AllOf(HasSubstr("the forces of 3 of 8 pairs"),
                      HasSubstr("all contacts except contacts 'on_left', 'on_right' and 'between'")))
        << size;
}

TEST(UndeterminedForces, NoneWhereOneOfTheThreeContactsIsMissing) { EXPECT_EQ(warned(three_stones(1.0, "")), ""); }

// Two bodies, each pair with nodes of its own.
TEST(UndeterminedForces, NoneOfAnElasticBlockWithManyPairs) {
  EXPECT_EQ(
      warned("scabo: 1\n"
             "materials: {stone: {young: 1e9, poisson: 0.2}}\n"
             "bodies:\n"
             "  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}\n"
             "  block: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}\n"
             "supports: [{on: floor, fix: [x, y]}]\n"
             "loads: {press: {on: block.top, traction: [1e4, -1e5]}}\n"
             "contacts: {base: {between: [floor.top, block.bottom], friction: 0.5}}\n"),
      "");
}

// Ten forces of five pairs, on points that a support holds, and three equations of equilibrium. Their sum is unique.
TEST(UndeterminedForces, OfARigidBlockOnHeldPoints) {
  EXPECT_THAT(warned("scabo: 1\n"
                     "materials: {stone: {young: 1e9, poisson: 0.2}}\n"
                     "bodies:\n"
                     "  floor: {material: stone, shape: {rectangle: {corner: [0, -1], size: [2, 1]}}, "
                     "mesh: {size: 0.5, order: 1}}\n"
                     "  block: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}}\n"
                     "supports: [{on: floor.top, fix: [x, y]}]\n"
                     "loads: {press: {on: block, force: [1, -10]}}\n"
                     "contacts: {base: {between: [floor.top, block.bottom], friction: 0.5}}\n"),
              AllOf(HasSubstr("contact 'base': the forces of "), HasSubstr(" of 5 pairs"),
                    HasSubstr("stresses and the total force of every contact are unique")));
}

/// A rigid block of 2 x 1 m on five points of a floor whose top edge is held in x and y.
std::string block_on_held_points(const std::string& friction, const std::string& force, const std::string& rest) {
  return "scabo: 1\n"
         "materials: {stone: {young: 1e9, poisson: 0.2}}\n"
         "bodies:\n"
         "  floor: {material: stone, shape: {rectangle: {corner: [0, -1], size: [2, 1]}}, mesh: {size: 0.5, order: "
         "1}}\n"
         "  block: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}}\n"
         "loads: {press: {on: block, force: " +
         force + "}}\ncontacts: {base: {between: [floor.top, block.bottom], friction: " + friction + "}}\n" + rest;
}

// Without friction there are only the five normal forces, and two equations: a node that is held in x and y takes both.
TEST(UndeterminedForces, OfARigidBlockOnHeldPointsWithoutFriction) {
  EXPECT_THAT(warned(block_on_held_points("0", "[0, -10]",
                                          "supports: [{on: floor.top, fix: [x, y]}, {on: block.top_left, fix: x}]\n")),
              AllOf(HasSubstr("contact 'base': the forces of 5 of 5 pairs"),
                    HasSubstr("the total force of every contact are unique")));
}

// Springs determine how the block moves, and so the total force on it, but not what each of the points takes.
TEST(UndeterminedForces, OfARigidBlockOnSpringsKeepTheirTotal) {
  EXPECT_THAT(
      warned(block_on_held_points("0.5", "[1, -10]",
                                  "supports: [{on: floor.top, fix: [x, y]}]\n"
                                  "springs: [{on: block.top, k_n: 1e6, k_t: 1e6}]\n")),
      AllOf(HasSubstr("contact 'base': the forces of "), HasSubstr("the total force of every contact are unique")));
}

// A block that presses by a millionth of the largest force and less is left out, however undetermined its forces are.
TEST(UndeterminedForces, NoneOfPairsThatHardlyPress) {
  const auto with = [](const char* force) {
    return "scabo: 1\n"
           "materials: {stone: {young: 1e9, poisson: 0.2}}\n"
           "bodies:\n"
           "  floor: {material: stone, shape: {rectangle: {corner: [0, -1], size: [2, 1]}}, "
           "mesh: {size: 0.5, order: 1}}\n"
           "  block: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}}\n"
           "  base: {rigid: true, shape: {rectangle: {corner: [5, -1], size: [2, 1]}}}\n"
           "  heavy: {material: stone, shape: {rectangle: {corner: [5, 0], size: [2, 1]}}, mesh: {size: 0.5}}\n"
           "supports: [{on: floor.top, fix: [x, y]}, {on: base, fix: [x, y]}]\n"
           "loads:\n"
           "  light: {on: block, force: [0, " +
           std::string(force) +
           "]}\n"
           "  press: {on: heavy.top, traction: [0, -1e5]}\n"
           "contacts:\n"
           "  one: {between: [floor.top, block.bottom], friction: 0.5}\n"
           "  other: {between: [base.top, heavy.bottom], friction: 0.5}\n";
  };
  EXPECT_THAT(warned(with("-10")), HasSubstr("contact 'one': the forces of "));
  EXPECT_EQ(warned(with("-1e-3")), "");
}

// It slides 6 mm to the right, until a spring takes what friction does not: what the forces of the pairs may change by
// leaves them at the bound of friction, and has neither a sum nor a moment.
TEST(UndeterminedForces, OfSlippingPairsKeepTheDirectionOfFriction) {
  constexpr double mu = 0.5;
  Options options;
  contact::Problem problem;
  Vector change;
  State at;
  options.on_problems = [&](const IncrementResult&, const std::vector<DiscreteProblem>& problems) {
    problem = problems.back().problem;
  };
  options.on_state = [&](const Prepared& prepared, const State& state, const StaticSolution&) {
    at = state;
    change = undetermined_forces(prepared, state, problem);
  };
  for (const double side : {1.0, -1.0}) {
    change.resize(0);
    const auto model = block_on_held_points(
        fmt::format("{}", mu), fmt::format("[{}, -10]", 8.0 * side),
        "supports: [{on: floor.top, fix: [x, y]}]\nsprings: [{on: block.right, k_n: 500, k_t: 0}]\n");
    const StaticSolution solution = solve_static(input::parse_model(model, "model.yaml"), options);
    ASSERT_EQ(solution.outcome, Outcome::solved) << solution.reason;
    ASSERT_EQ(change.size(), 10);
    double normal = 0.0, tangential = 0.0;
    for (Eigen::Index i = 0; i < 5; ++i) {
      normal += change[2 * i], tangential += change[2 * i + 1];
      if (change[2 * i] == 0.0) continue;
      EXPECT_EQ(at.states[static_cast<std::size_t>(i)], contact::ContactState::slip);
      EXPECT_NEAR(change[2 * i + 1], -side * mu * change[2 * i], 1e-9) << side;
    }
    EXPECT_GT(change.lpNorm<Eigen::Infinity>(), 1e-2);
    EXPECT_NEAR(normal, 0.0, 1e-6);
    EXPECT_NEAR(tangential, 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace scabo::analysis
