// What a whole model file becomes.
#include "scabo/input/read_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/input/models.hpp"

namespace scabo::input {
namespace {

using namespace testing_models;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* two_bodies =
    "scabo: 1\n"
    "title: Two\n"
    "materials: {m: {young: 1, poisson: 0.5}, n: {young: 2, poisson: -0.5, density: 3}}\n"
    "bodies:\n"
    "  floor: {rigid: true, shape: {rectangle: {corner: [0, -1], size: [2, 1]}}}\n"
    "  block: {material: n, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5, kind: "
    "fem}}\n"
    "supports:\n"
    "  - {on: floor, fix: [x, y]}\n"
    "  - {on: block.left, fix: x}\n"
    "  - {on: block.left, fix: [x]}\n"
    "  - {on: {body: block, near: [2, 1]}, displacement: [1e-3, null], name: pull}\n"
    "loads:\n"
    "  weight: {gravity: [0, -9.81]}\n"
    "  press: {on: block.top, pressure: 5}\n"
    "contacts:\n"
    "  ground: {between: [floor.top, block.bottom], friction: 0.3, gap: -1e-6}\n";

TEST(ReadModel, ResolvesNamesToIndices) {
  const Model model = parse(two_bodies);
  EXPECT_EQ(model.file, "model.yaml");
  EXPECT_EQ(model.title, "Two");
  ASSERT_EQ(model.bodies.size(), 2u);
  EXPECT_TRUE(model.bodies[0].rigid);
  EXPECT_EQ(model.bodies[0].material, -1);
  EXPECT_EQ(model.bodies[1].material, 1);
  EXPECT_EQ(model.bodies[1].mesh.kind, MeshKind::fem);
  EXPECT_EQ(model.materials[1].density, 3.0);
  EXPECT_EQ(model.bodies[1].source.line, 6);

  EXPECT_EQ(model.supports[0].on.kind, Place::Kind::body);
  EXPECT_EQ(model.supports[1].on.kind, Place::Kind::edge);
  EXPECT_EQ(model.supports[1].on.index, 3);
  EXPECT_FALSE(model.supports[1].displacement[1]);
  EXPECT_EQ(model.supports[3].on.kind, Place::Kind::near);
  EXPECT_EQ(model.supports[3].on.near, Vec2(2.0, 1.0));
  EXPECT_EQ(model.supports[3].displacement[0], 1e-3);

  EXPECT_FALSE(model.loads[0].on);
  EXPECT_EQ(std::get<Gravity>(model.loads[0].kind).value, Vec2(0.0, -9.81));
  EXPECT_EQ(std::get<Pressure>(model.loads[1].kind).value, 5.0);
  EXPECT_EQ(model.contacts[0].a.text, "floor.top");
  EXPECT_EQ(model.contacts[0].b.index, 0);
  EXPECT_EQ(model.contacts[0].gap, -1e-6);
}

TEST(ReadModel, SupportsAreNamedAfterTheirPlaces) {
  const Model model = parse(two_bodies);
  std::vector<std::string> names;
  for (const Support& support : model.supports) names.push_back(support.name);
  EXPECT_THAT(names, ElementsAre("floor", "block.left", "block.left (2)", "pull"));
}

TEST(ReadModel, DefaultsAreThoseOfTheDocuments) {
  const Model model = parse(block());
  EXPECT_EQ(model.analysis.plane, Plane::stress);
  EXPECT_EQ(model.analysis.thickness, 1.0);
  EXPECT_EQ(model.bodies[0].mesh.order, 2);
  EXPECT_EQ(model.bodies[0].mesh.kind, MeshKind::superelement);
  EXPECT_TRUE(model.bodies[0].mesh.centre.isApprox(Vec2(1.0, 0.5)));
  EXPECT_EQ(model.solver.tolerance, 1e-10);
  EXPECT_EQ(model.solver.iterations, 50);
  EXPECT_EQ(model.solver.halvings, 6);
}

TEST(ReadModel, PlaneStressTakesIncompressibleMaterialAndPlaneStrainDoesNot) {
  const std::string text = two_bodies;
  EXPECT_THAT(mistakes_in(text), IsEmpty());
  EXPECT_THAT(mistakes_in("analysis: {plane: strain}\n" + text), HasSubstr("less than 0.5 (plane strain)"));
}

TEST(ReadModel, InterferenceAloneLoadsAModel) {
  const std::string text =
      "scabo: 1\nmaterials: {m: {young: 1, poisson: 0}}\nbodies:\n"
      "  a: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 1}}\n"
      "  b: {material: m, shape: {rectangle: {corner: [0, TOP], size: [1, 1]}}, mesh: {size: 1}}\n"
      "supports: [{on: a.bottom, fix: [x, y]}, {on: b.top, fix: [x, y]}]\n"
      "contacts: {c: {between: [a.top, b.bottom]GAP}}\n";
  const auto with = [&](const std::string& top, const std::string& gap) {
    std::string result = text;
    result.replace(result.find("TOP"), 3, top);
    result.replace(result.find("GAP"), 3, gap);
    return result;
  };
  EXPECT_THAT(mistakes_in(with("1", "")), HasSubstr("the model has no loading"));
  EXPECT_THAT(mistakes_in(with("1", ", gap: 1e-4")), HasSubstr("the model has no loading"));
  EXPECT_THAT(mistakes_in(with("1", ", gap: -1e-4")), IsEmpty());
  EXPECT_THAT(mistakes_in(with("0.999", "")), IsEmpty());  // interference by geometry
}

TEST(ReadModel, NumbersAtTheEdgeOfTheirRange) {
  EXPECT_THAT(mistakes_in(block("analysis: {thickness: 1e-3}\nsolver: {halvings: 0}\nsteps: [{increments: 100000}]\n")),
              IsEmpty());
  EXPECT_THAT(mistakes_in(block("solver: {halvings: -1}\n")), HasSubstr("from 0 to 30"));
}

TEST(ReadModel, ManyMistakesAreCountedNotAllTold) {
  std::string text = "scabo: 1\nbodies:\n";
  for (int i = 0; i < 1000; ++i) text += "  b" + std::to_string(i) + ": 1\n";
  const std::string mistakes = mistakes_in(text);
  EXPECT_EQ(std::count(mistakes.begin(), mistakes.end(), '\n'), 200);
  EXPECT_TRUE(mistakes.ends_with("model.yaml: and 802 more mistakes")) << mistakes.substr(mistakes.size() - 100);
}

TEST(ReadModel, SupportsThatAgreeMayShareACorner) {
  EXPECT_THAT(mistakes_in(block("steps: [{}]\n")), IsEmpty());
  const std::string base = block();
  const auto with = [&](const std::string& support) {
    std::string result = base;
    result.replace(result.find("fix: [x, y]}]"), 13, "fix: [x, y]}, " + support + "]");
    return result;
  };
  EXPECT_THAT(mistakes_in(with("{on: block.left, fix: x}")), IsEmpty());
  EXPECT_THAT(mistakes_in(with("{on: block.top, displacement: [null, -1]}")), IsEmpty());
  EXPECT_THAT(mistakes_in(with("{on: block.left, displacement: [1, null]}")), HasSubstr("they share a point"));
  EXPECT_THAT(mistakes_in(with("{on: block, displacement: [1, null]}")), HasSubstr("they share a point"));
}

TEST(Schema, IsTheOneInTheSourceTree) {
  EXPECT_THAT(std::string(model_schema()), HasSubstr("https://json-schema.org/draft/2020-12/schema"));
  EXPECT_EQ(model_schema().front(), '{');
}

/// A writer of YAML 1.1 takes the key `on` for a truth value and writes `true`.
std::string with_true_for_on(std::string text) {
  for (auto at = text.find("{on: "); at != std::string::npos; at = text.find("{on: ")) text.replace(at, 5, "{true: ");
  return text;
}

TEST(ReadModel, TakesTrueForOn) {
  const Model model = parse(with_true_for_on(block()));
  EXPECT_EQ(model.supports.at(0).on.text, "block.bottom");
  EXPECT_EQ(model.loads.at(0).on->text, "block.right");
}

TEST(ReadModel, TakesTrueForOnInJsonToo) {
  std::string text = with_true_for_on(block());
  for (auto at = text.find("{true: "); at != std::string::npos; at = text.find("{true: "))
    text.replace(at, 7, "{\"true\": ");
  EXPECT_EQ(parse(text).supports.at(0).on.text, "block.bottom");
}

TEST(ReadModel, OverridesOfOnReplaceTrue) {
  EXPECT_EQ(parse(with_true_for_on(block()), {{"loads.push.on", "block.top"}}).loads.at(0).on->text, "block.top");
}

TEST(ReadModel, TrueIsNoKeyWhereOnIsNone) {
  EXPECT_THAT(mistakes_in(block("solver: {true: 1}\n")), HasSubstr("solver.true: unknown key 'true'"));
}

TEST(ReadModel, TheMouthOfACrackIsAPointAnEdgeOrACorner) {
  const auto crack_of = [](const std::string& mouth) {
    return parse(
               shaped(
                   "{polygon: {vertices: [[0, 0], [2, 0], [2, 2], [0, 2]], names: {left: edge_4, top_left: vertex_4}}}",
                   "{size: 0.5}, cracks: [{tip: [1, 1], mouth: " + mouth + "}]"))
        .bodies.front()
        .cracks.front();
  };
  for (const char* mouth : {"top_left", "body.top_left"}) {
    const Crack named = crack_of(mouth), at_point = crack_of("[0, 2]");
    EXPECT_EQ(named.mouth, Vec2(0.0, 2.0)) << mouth;
    EXPECT_EQ(named.edge, at_point.edge);
    EXPECT_EQ(named.at, at_point.at);
  }
  EXPECT_EQ(crack_of("left").mouth, Vec2(0.0, 1.0));
}

TEST(ReadModel, FieldsAreAllUnlessSomeAreNamed) {
  const OutputFields all = parse(block()).output.fields;
  EXPECT_TRUE(all.displacement && all.stress && all.principal && all.von_mises && all.contact);
  const Output some = parse(block("output: {fields: [stress, contact], every: 7}\n")).output;
  EXPECT_TRUE(some.fields.stress && some.fields.contact);
  EXPECT_FALSE(some.fields.displacement || some.fields.principal || some.fields.von_mises);
  EXPECT_EQ(some.every, 7);
  const OutputFields none = parse(block("output: {fields: []}\n")).output.fields;
  EXPECT_FALSE(none.any_of_bodies() || none.contact);
}

}  // namespace
}  // namespace scabo::input
