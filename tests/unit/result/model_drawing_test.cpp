#include "scabo/result/model_drawing.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::result {
namespace {

using Json = nlohmann::json;

Json drawing_of(const std::string& text) {
  const model::Model model = input::parse_model(text, "model.yaml");
  return Json::parse(model_drawing(model, analysis::check(model)));
}

Json block() {
  return drawing_of(R"(
scabo: 1
title: A block
materials: {soft: {young: 1e4, poisson: 0.3, density: 2}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
  block:
    material: soft
    shape: {rectangle: {corner: [0, 0], size: [2, 1]}}
    holes: {bore: {circle: {centre: [1, 0.5], radius: 0.2}}}
    mesh: {kind: polygons, size: 0.25}
supports:
  - {on: floor, fix: [x, y]}
  - {on: block.left, fix: normal}
springs: [{on: block.bore, k_n: 5}]
loads:
  down: {on: block.top, pressure: 3}
  up: {on: block.top, pressure: -3}
  push: {on: block.top_left, force: [2, 0]}
  weight: {gravity: [0, -9.81]}
  heat: {temperature: 5}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}
)");
}

const Json& named(const Json& list, const std::string& name) {
  for (const Json& entry : list)
    if (entry["name"] == name) return entry;
  throw std::runtime_error("there is no " + name);
}

TEST(ModelDrawing, BodiesHaveTheirLoopsAndCells) {
  const Json drawing = block();
  EXPECT_EQ(drawing["title"], "A block");
  const Json& floor = drawing["bodies"][0];
  EXPECT_TRUE(floor["rigid"]);
  EXPECT_TRUE(floor["cells"].empty());
  EXPECT_EQ(floor["loops"], Json::parse("[[[-1.0, -1.0], [3.0, -1.0], [3.0, 0.0], [-1.0, 0.0]]]"));
  const Json& body = drawing["bodies"][1];
  ASSERT_EQ(body["loops"].size(), 2U);
  double area = 0.0;  // of the cells: the block without its bore
  for (const Json& cell : body["cells"])
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Json &a = cell[i], &b = cell[(i + 1) % cell.size()];
      area += 0.5 * (a[0].get<double>() * b[1].get<double>() - b[0].get<double>() * a[1].get<double>());
    }
  EXPECT_NEAR(area, 2.0 - 0.04 * 3.14159265, 5e-3);
}

TEST(ModelDrawing, EdgesAreNamedAtTheirMiddle) {
  const Json& edges = block()["bodies"][1]["edges"];
  const Json& top = named(edges, "top");
  EXPECT_EQ(top["at"], Json::parse("[1.0, 1.0]"));
  EXPECT_NEAR(top["normal"][1].get<double>(), 1.0, 1e-12);
}

TEST(ModelDrawing, DirectionsAreThoseOfTheModel) {
  const Json drawing = block();
  EXPECT_EQ(named(drawing["supports"], "floor")["along"].size(), 2U);
  EXPECT_EQ(named(drawing["supports"], "floor")["points"], Json::parse("[[1.0, -0.5]]"));
  const Json& left = named(drawing["supports"], "block.left")["along"];
  ASSERT_EQ(left.size(), 1U);
  EXPECT_NEAR(left[0][0].get<double>(), -1.0, 1e-12);
  const auto direction = [&](const char* name) {
    const Json& along = named(drawing["loads"], name)["along"];
    return Vec2(along.at(0)[0].get<double>(), along.at(0)[1].get<double>());
  };
  EXPECT_LT((direction("down") - Vec2(0, -1)).norm(), 1e-12);
  EXPECT_LT((direction("up") - Vec2(0, 1)).norm(), 1e-12);
  EXPECT_LT((direction("push") - Vec2(1, 0)).norm(), 1e-12);
  EXPECT_LT((direction("weight") - Vec2(0, -1)).norm(), 1e-12);
  EXPECT_EQ(named(drawing["loads"], "weight")["points"].size(), 1U);  // the floor has no weight
  EXPECT_TRUE(named(drawing["loads"], "heat")["along"].empty());
  EXPECT_FALSE(named(drawing["springs"], "block.bore")["points"].empty());
}

TEST(ModelDrawing, ContactsHaveTheirPairs) {
  const Json drawing = block();
  const Json& base = named(drawing["contacts"], "base")["points"];
  EXPECT_GE(base.size(), 9U);
  for (const Json& x : base) EXPECT_EQ(x[1].get<double>(), 0.0);
}

}  // namespace
}  // namespace scabo::result
