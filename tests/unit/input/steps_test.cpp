// Factors of loads and prescribed displacements at the end of every step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/input/models.hpp"

namespace scabo::input {
namespace {

using namespace testing_models;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* pressed =
    "scabo: 1\n"
    "materials: {m: {young: 1, poisson: 0}}\n"
    "bodies: {b: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 1}}}\n"
    "supports:\n"
    "  - {on: b.bottom, fix: [x, y]}\n"
    "  - {on: b.top_left, displacement: [null, 1]}\n"
    "  - {on: b.top_right, displacement: [null, 2], name: stroke}\n"
    "loads: {first: {on: b.right, force: [1, 0]}, second: {on: b.left, force: [1, 0]}}\n";

TEST(Steps, WithoutStepsEverythingGoesToOne) {
  const Model model = parse(pressed);
  ASSERT_EQ(model.steps.size(), 1u);
  EXPECT_EQ(model.steps[0].name, "step_1");
  EXPECT_EQ(model.steps[0].increments, 1);
  EXPECT_THAT(model.steps[0].load_factors, ElementsAre(1.0, 1.0));
  EXPECT_THAT(model.steps[0].support_factors, ElementsAre(1.0, 1.0, 1.0));
}

TEST(Steps, NamedFactorsChangeAndOthersStay) {
  const Model model = parse(std::string(pressed) +
                            "steps:\n"
                            "  - {name: one, loads: {first: 0.5}}\n"
                            "  - {increments: 3, loads: {second: -2, stroke: 0.25}}\n"
                            "  - {loads: {first: 0}}\n"
                            "  - {name: all}\n");
  ASSERT_EQ(model.steps.size(), 4u);
  EXPECT_EQ(model.steps[1].name, "step_2");
  EXPECT_EQ(model.steps[1].increments, 3);
  EXPECT_THAT(model.steps[0].load_factors, ElementsAre(0.5, 0.0));
  EXPECT_THAT(model.steps[1].load_factors, ElementsAre(0.5, -2.0));
  EXPECT_THAT(model.steps[2].load_factors, ElementsAre(0.0, -2.0));
  EXPECT_THAT(model.steps[3].load_factors, ElementsAre(1.0, 1.0));
  // Without a name of its own, a displacement is there from the first step.
  EXPECT_THAT(model.steps[0].support_factors, ElementsAre(1.0, 1.0, 0.0));
  EXPECT_THAT(model.steps[1].support_factors, ElementsAre(1.0, 1.0, 0.25));
  EXPECT_THAT(model.steps[2].support_factors, ElementsAre(1.0, 1.0, 0.25));
  EXPECT_THAT(model.steps[3].support_factors, ElementsAre(1.0, 1.0, 1.0));
}

TEST(Steps, InWhichABodyComesOrGoesLeaveLoadsAsTheyAre) {
  std::string text(pressed);
  text.replace(
      text.find("mesh: {size: 1}}}"), 17,
      "mesh: {size: 1}},\n  new: {material: m, shape: {rectangle: {corner: [1, 0], size: [1, 1]}}, mesh: {size: 1}, "
      "added: build, removed: dig}}");
  const Model model = parse(text +
                            "contacts: {joint: {between: [b.right, new.left], bond: true}}\n"
                            "steps:\n"
                            "  - {name: one, loads: {first: 0.5, second: 3}}\n"
                            "  - {name: build}\n"
                            "  - {name: all}\n"
                            "  - {name: half, loads: {second: 0.5, stroke: 0.25}}\n"
                            "  - {name: dig}\n");
  ASSERT_EQ(model.steps.size(), 5u);
  EXPECT_THAT(model.steps[1].load_factors, ElementsAre(0.5, 3.0));
  EXPECT_THAT(model.steps[2].load_factors, ElementsAre(1.0, 1.0));
  EXPECT_THAT(model.steps[4].load_factors, ElementsAre(1.0, 0.5));
  EXPECT_THAT(model.steps[4].support_factors, ElementsAre(1.0, 1.0, 0.25));
}

TEST(Steps, WhatIsNeverAppliedIsAMistake) {
  const std::string mistakes = mistakes_in(std::string(pressed) + "steps: [{loads: {first: 1, second: 0}}]\n");
  EXPECT_THAT(mistakes, HasSubstr("load 'second' is never applied"));
  EXPECT_THAT(mistakes, HasSubstr("the displacement of support 'stroke' is never applied"));
  EXPECT_THAT(mistakes, testing::Not(HasSubstr("'first'")));
}

TEST(Steps, SupportsThatMoveAlikeDoNotConflict) {
  std::string text = pressed;
  const auto with = [&](const std::string& second, const std::string& steps) {
    std::string result = text;
    result.insert(result.find("loads:"), "  - " + second + "\n");
    return result + steps;
  };
  EXPECT_THAT(mistakes_in(with("{on: b.top_right, displacement: [null, 2]}", "")), testing::IsEmpty());
  // The same displacement, but one of the two only in the second step.
  EXPECT_THAT(mistakes_in(with("{on: b.top_right, displacement: [null, 2]}",
                               "steps: [{loads: {first: 1, second: 1}}, {loads: {stroke: 1}}]\n")),
              HasSubstr("they share a point"));
}

TEST(Steps, FollowCurvesAndAreRepeated) {
  const Model model =
      parse(block("curves: {wave: {sine: {amplitude: 2, periods: 1}}, up: {ramp: {to: 1, end: 0.5}}, "
                  "idle: {table: [[0, 0], [1, 1]]}}\n"
                  "steps: [{name: shake, increments: 3, cycles: 2, loads: {push: wave}}, "
                  "{loads: {push: up}}]\n"));
  ASSERT_EQ(model.steps.size(), 3u);
  EXPECT_EQ(model.steps[0].name, "shake_1");
  EXPECT_EQ(model.steps[1].name, "shake_2");
  EXPECT_EQ(model.steps[1].load_curves, std::vector<int>{0});
  EXPECT_EQ(model.steps[1].load_factors, std::vector<double>{0.0});
  EXPECT_EQ(model.steps[1].increments, 5);  // thirds, and the extremes at a quarter and three quarters
  EXPECT_EQ(model.steps[2].load_factors, std::vector<double>{1.0});
  EXPECT_EQ(model.steps[2].ends, (std::vector<double>{0.5, 1.0}));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0].text, "curve 'idle' has no effect: no step uses it");
}

TEST(Steps, CoefficientsOfFrictionStayUntilTheyAreChanged) {
  const std::string text = block(
      "contacts: {base: {between: [floor.top, block.bottom], friction: 0.5}}\n"
      "steps: [{name: a}, {name: b, friction: {base: 0.2}}, {name: c, loads: {push: 2}}]\n");
  std::string with_floor = text;
  with_floor.replace(with_floor.find("supports:"), 0,
                     "  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}\n");
  with_floor.replace(with_floor.find("block.bottom, fix"), std::string("block.bottom").size(), "floor");
  const Model model = parse(with_floor);
  ASSERT_EQ(model.steps.size(), 3u);
  EXPECT_EQ(model.steps[0].friction, std::vector<double>{0.5});
  EXPECT_EQ(model.steps[1].friction, std::vector<double>{0.2});
  EXPECT_EQ(model.steps[1].backward_friction, std::vector<double>{0.2});  // in both directions
  EXPECT_EQ(model.steps[1].load_factors, std::vector<double>{1.0});       // as they were
  EXPECT_EQ(model.steps[2].friction, std::vector<double>{0.2});
}

}  // namespace
}  // namespace scabo::input
