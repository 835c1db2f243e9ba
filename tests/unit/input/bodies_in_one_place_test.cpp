// Bodies that overlap although nothing joins them are named by a warning.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/input/models.hpp"

namespace scabo::input {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using namespace testing_models;

/// Stones of 1 m by 0.5 m on a rigid floor; `stones` and `rest`: lines of bodies, and of the sections after them.
std::string wall(const std::string& stones,
                 const std::string& rest = "contacts: {joints: {between: all, friction: 0.6}}\n") {
  return "scabo: 1\n"
         "materials: {stone: {young: 20e9, poisson: 0.2, density: 2300}}\n"
         "bodies:\n"
         "  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [9, 1]}}}\n"
         "  low: &stone\n"
         "    material: stone\n"
         "    shape: {rectangle: {corner: [0, 0], size: [1, 0.5]}}\n"
         "    mesh: {size: 0.25}\n"
         "    repeat: {count: 3, step: [1, 0]}\n" +
         stones +
         "supports: [{on: floor, fix: [x, y]}]\n"
         "loads: {weight: {gravity: [0, -9.81]}}\n" +
         rest;
}

std::vector<std::string> warnings_of(const std::string& text) {
  std::vector<std::string> texts;
  for (const Warning& warning : parse(text).warnings)
    if (warning.kind == WarningKind::overlap) texts.push_back(warning.text);
  return texts;
}

TEST(BodiesInOnePlace, AreNotThoseThatStandOnEachOther) {
  EXPECT_THAT(warnings_of(wall("  high: {<<: *stone, shape: {rectangle: {corner: [0.5, 0.5], size: [1, 0.5]}}, repeat: "
                               "{count: 2, step: [1, 0]}}\n")),
              IsEmpty());
}

TEST(BodiesInOnePlace, ACourseThatIsWrittenTwice) {
  EXPECT_THAT(
      warnings_of(wall("  again: *stone\n")),
      ElementsAre("bodies 'low_1' and 'again_1' overlap at (0.5, 0), as do 2 more pairs of bodies, and no contact "
                  "or tie joins them: neither hinders the other there; move or remove one, or join them"));
}

TEST(BodiesInOnePlace, AStoneThatReachesIntoAnother) {
  EXPECT_THAT(warnings_of(wall("  last: {<<: *stone, shape: {rectangle: {corner: [2.9, 0], size: [1, 0.5]}}, repeat: "
                               "{count: 1, step: [1, 0]}}\n")),
              ElementsAre("bodies 'low_3' and 'last_1' overlap at (2.95, 0) and no contact or tie joins them: neither "
                          "hinders the other there; move or remove one, or join them"));
}

TEST(BodiesInOnePlace, AreWantedWhereAContactJoinsThem) {
  const std::string sunk =
      "  sunk: {material: stone, shape: {rectangle: {corner: [5, -0.01], size: [1, 0.5]}}, mesh: {size: 0.25}}\n";
  EXPECT_THAT(warnings_of(wall(sunk,
                               "contacts:\n"
                               "  base: {between: [floor.top, sunk.bottom], friction: 0.6}\n"
                               "  joints: {between: all, friction: 0.6}\n")),
              IsEmpty());
}

TEST(BodiesInOnePlace, AreNotThereAtTheSameTime) {
  const auto steps = [](const std::string& names) {
    return "contacts: {joints: {between: all, friction: 0.6}}\nsteps: [" + names + "]\n";
  };
  const std::string three =
      "{name: a, loads: {weight: 1}}, {name: b, loads: {weight: 1}}, {name: c, loads: {weight: 1}}";
  const auto stones = [](const std::string& when) {
    return "  old: {<<: *stone, shape: {rectangle: {corner: [5, 0], size: [1, 0.5]}}, repeat: {count: 1, step: [1, "
           "0]}, removed: b}\n"
           "  new: {<<: *stone, shape: {rectangle: {corner: [5, 0], size: [1, 0.5]}}, repeat: {count: 1, step: [1, "
           "0]}, added: " +
           when + "}\n";
  };
  EXPECT_THAT(warnings_of(wall(stones("c"), steps(three))), IsEmpty());
  EXPECT_THAT(warnings_of(wall(stones("b"), steps(three))), IsEmpty());
  EXPECT_EQ(warnings_of(wall("  old: {<<: *stone, removed: c}\n", steps(three))).size(), 1u);
}

TEST(BodiesInOnePlace, AreOfNoInterestIfBothAreRigidOrVibrateAlone) {
  EXPECT_THAT(warnings_of(wall("  post: {rigid: true, shape: {rectangle: {corner: [3, -0.5], size: [1, 1]}}}\n")),
              IsEmpty());
  EXPECT_THAT(warnings_of(wall("  again: *stone\n") + "analysis: {type: modal}\n"), IsEmpty());
}

}  // namespace
}  // namespace scabo::input
