// Values from the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/input/models.hpp"

namespace scabo::input {
namespace {

using namespace testing_models;
using testing::HasSubstr;

TEST(ParseOverride, SplitsAtTheFirstEqualsSign) {
  const Override override = parse_override("title=a=b");
  EXPECT_EQ(override.path, "title");
  EXPECT_EQ(override.value, "a=b");
  EXPECT_EQ(parse_override(" solver.tolerance = 1e-9").path, "solver.tolerance");
}

TEST(ParseOverride, RefusesWhatHasNoPathOrValue) {
  for (const char* text : {"", "title", "=3", " =3", ".=3", "a..b=3", "a.=3", ".a=3"}) {
    EXPECT_THROW(parse_override(text), InputError) << text;
  }
}

TEST(Overrides, ReplaceValuesInMapsAndLists) {
  const Model model = parse(block(), {{"materials.steel.young", "5"},
                                      {"supports.0.fix", "y"},
                                      {"loads.push.force", "[0, 7]"},
                                      {"bodies.block.mesh", "{size: 0.25, order: 4}"}});
  EXPECT_EQ(model.materials[0].young, 5.0);
  EXPECT_FALSE(model.supports[0].displacement[0]);
  EXPECT_EQ(std::get<Force>(model.loads[0].kind).value, Vec2(0.0, 7.0));
  EXPECT_EQ(model.bodies[0].mesh.order, 4);
}

TEST(Overrides, AddKeysAndSections) {
  const Model model = parse(block(), {{"bodies.block.mesh.order", "3"},
                                      {"analysis.plane", "strain"},
                                      {"solver", "{halvings: 2}"},
                                      {"title", "changed"}});
  EXPECT_EQ(model.bodies[0].mesh.order, 3);
  EXPECT_EQ(model.analysis.plane, Plane::strain);
  EXPECT_EQ(model.solver.halvings, 2);
  EXPECT_EQ(model.title, "changed");
}

TEST(Overrides, TheLastOneHolds) { EXPECT_EQ(parse(block(), {{"title", "a"}, {"title", "b"}}).title, "b"); }

TEST(Overrides, NullTakesAKeyOrAnItemAway) {
  const Model model =
      parse(block("title: a\n"), {{"supports", "[{on: block.left, fix: y}, {on: block.bottom, fix: [x, y]}]"},
                                  {"supports.0", "~"},
                                  {"materials.steel.density", "null"},
                                  {"title", " null "}});
  ASSERT_EQ(model.supports.size(), 1U);
  EXPECT_TRUE(model.supports[0].displacement[0]);
  EXPECT_FALSE(model.materials[0].density);
  EXPECT_EQ(model.title, "");
  EXPECT_EQ(mistakes_in(block(), {{"materials.steel.young", "null"}}),
            "model.yaml:2:20: materials.steel: 'young' is missing");
  EXPECT_EQ(mistakes_in(block(), {{"loads.pull", "null"}}),
            "model.yaml: --set loads.pull: loads has no 'pull' (available: push)");
  EXPECT_EQ(mistakes_in(block(), {{"solver.tolerance", "null"}}),
            "model.yaml: --set solver.tolerance: the model has no 'solver' (available: scabo, materials, bodies, "
            "supports, loads)");
}

TEST(Overrides, NullInAListOfNumbersKeepsTheirPlaces) {
  const std::vector<Override> moved = {{"supports", "[{on: block.left, displacement: [1, 2]}]"}};
  auto overrides = moved;
  overrides.push_back({"supports.0.displacement.0", "null"});
  const Model model = parse(block(), overrides);
  EXPECT_FALSE(model.supports[0].displacement[0]);
  EXPECT_TRUE(model.supports[0].displacement[1]);
  overrides.push_back({"supports.0.displacement.0", "~"});  // once more
  EXPECT_FALSE(parse(block(), overrides).supports[0].displacement[0]);
  EXPECT_EQ(mistakes_in(block(), {{"loads.push.force.0", "null"}}),
            "model.yaml: --set loads.push.force.0: must be a number, not nothing");
}

TEST(Overrides, ChangeOnlyTheAliasTheyName) {
  const std::string text =
      "scabo: 1\nmaterials: {m: &m {young: 1, poisson: 0}, n: *m}\n"
      "bodies: {b: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 1}}}\n"
      "supports: [{on: b.bottom, fix: [x, y]}]\nloads: {p: {on: b.top, pressure: 1}}\n";
  const Model model = parse(text, {{"materials.n.young", "2"}});
  EXPECT_EQ(model.materials[0].young, 1.0);
  EXPECT_EQ(model.materials[1].young, 2.0);
}

TEST(Overrides, MistakesNameTheOverride) {
  const auto mistake = [](const std::string& path, const std::string& value) {
    return mistakes_in(block(), {{path, value}});
  };
  EXPECT_EQ(mistake("materials.steel.young", "-1"),
            "model.yaml: --set materials.steel.young: must be greater than 0, not -1");
  EXPECT_EQ(mistake("loads.push.force", "[0, x]"), "model.yaml: --set loads.push.force.1: must be a number, not 'x'");
  EXPECT_EQ(mistake("materials.stel.young", "1"),
            "model.yaml: --set materials.stel.young: materials has no 'stel' (did you mean 'steel'?)");
  EXPECT_EQ(
      mistake("materials.steel.yuong", "1"),
      "model.yaml: --set materials.steel.yuong: unknown key 'yuong' (available: young, poisson, density, damping, "
      "orthotropic, anisotropic, expansion)");
  EXPECT_EQ(mistake("supports.1.fix", "x"),
            "model.yaml: --set supports.1.fix: supports is a list of one entry: write 0, not '1'");
  EXPECT_EQ(
      mistake("title.of.it", "x"),
      "model.yaml: --set title.of.it: the model has no 'title' (available: scabo, materials, bodies, supports, loads)");
  EXPECT_EQ(mistake("scabo.version", "1"),
            "model.yaml: --set scabo.version: scabo is '1', which has no keys: replace it as a whole");
  EXPECT_THAT(mistake("loads.push.force", "[0, "), HasSubstr("model.yaml: --set loads.push.force: not valid YAML"));
  EXPECT_THAT(mistake("materials.steel.young", ""), HasSubstr("has no value: give one"));
  EXPECT_THAT(mistake("bodies.block.mesh.order", ""),
              HasSubstr("--set bodies.block.mesh.order: has no value: give one"));
  EXPECT_THAT(mistake("bodies.block.mesh.size", "1e-9"), HasSubstr("--set bodies.block.mesh.size: gives"));
}

}  // namespace
}  // namespace scabo::input
