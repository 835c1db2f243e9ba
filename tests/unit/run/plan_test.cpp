#include "scabo/run/plan.hpp"

#include <gtest/gtest.h>

#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::run {
namespace {

/// Of a rectangle of 4 x 1, one super-element of 1,600 degrees of freedom.
double seconds_of(const std::string& centre) {
  const model::Model model = input::parse_model(R"(
scabo: 1
materials: {soft: {young: 1e4, poisson: 0.3}}
bodies:
  b: {material: soft, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: 0.05, order: 4, centre: )" +
                                                    centre + R"(}}
supports: [{on: b.left, fix: [x, y]}]
loads: {down: {on: b.top, pressure: 1}}
)",
                                                "b.yaml");
  return plan_of(model, analysis::check(model)).cells;
}

// A scaling centre near a long side makes the super-element slender as its rays see it: it gets its last digits, which
// takes seven times as long as its stiffness. (Measured: 1.6 s at a distance of 0.05 and 14 s at 0.01, of two blocks.)
TEST(Plan, LastDigitsTakeTheirTime) {
  const double away = seconds_of("[2, 0.05]"), near = seconds_of("[2, 0.01]");
  EXPECT_NEAR(near / away, 8.3, 1.0);
  EXPECT_DOUBLE_EQ(seconds_of("[2, 0.05]"), seconds_of("[2, 0.1]"));
  // One block of more rows than last digits are for.
  EXPECT_DOUBLE_EQ(seconds_of("[1.9, 0.01]"), seconds_of("[1.9, 0.1]"));
}

/// A square, one super-element of 480 degrees of freedom: its right half, or its lower left quarter, is another
/// material.
Plan plan_of_sectors(double young, const std::string& sectors) {
  const model::Model model = input::parse_model(R"(
scabo: 1
materials: {soft: {young: 1, poisson: 0.3}, other: {young: )" +
                                                    std::to_string(young) + R"(, poisson: 0.3}}
bodies:
  b:
    material: soft
    shape: {polygon: {vertices: [[-1, -1], [0, -1], [1, -1], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0]]}}
    mesh: {size: 0.0667, order: 2, centre: [0, 0]}
    sectors: )" + sectors + R"(
supports: [{on: b.edge_1, fix: [x, y]}]
loads: {down: {on: b.edge_5, pressure: 1}}
)",
                                                "b.yaml");
  return plan_of(model, analysis::check(model));
}

// Measured, of one block of 484 degrees of freedom: 0.11 s and 52 MB with materials that differ by a factor of 10, 1.1
// s and 85 MB by 10,000, which makes the last digits matter.
TEST(Plan, SectorsThatDifferMuchGetTheirLastDigits) {
  const std::string quarter = "{edge_1: other, edge_8: other, edge_7: other}";
  const Plan alike = plan_of_sectors(10.0, quarter), unlike = plan_of_sectors(1e4, quarter);
  EXPECT_NEAR(unlike.cells / alike.cells, 8.3, 0.1);
  EXPECT_NEAR(unlike.bytes - alike.bytes, 33e6, 3e6);
}

// A mirror of the shape that is none of the materials halves no work.
TEST(Plan, MaterialsBreakTheSymmetryOfAShape) {
  const double whole = plan_of_sectors(10.0, "{}").cells,
               half = plan_of_sectors(10.0, "{edge_2: other, edge_3: other, edge_4: other, edge_5: other}").cells,
               quarter = plan_of_sectors(10.0, "{edge_1: other, edge_8: other, edge_7: other}").cells;
  EXPECT_NEAR(half / whole, 4.0, 1e-6);
  EXPECT_NEAR(quarter / whole, 16.0, 1e-6);
}

// Newton's method may find nothing where contact alone holds bodies, and what follows it takes many factorisations.
TEST(Plan, SaysHowLongLooseBodiesMayTake) {
  const auto plan = [](const std::string& supports) {
    const model::Model model = input::parse_model(R"(
scabo: 1
materials: {stone: {young: 20e9, poisson: 0.2}}
bodies:
  below: {material: stone, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: 0.01, kind: superelement}}
  above: {material: stone, shape: {rectangle: {corner: [0, 1], size: [4, 1]}}, mesh: {size: 0.01, kind: superelement}}
supports: [{on: below.bottom, fix: [x, y]})" + supports +
                                                      R"(]
loads: {down: {on: above.top, pressure: 1e6}}
contacts: {bed: {between: [below.top, above.bottom], friction: 1.5}}
)",
                                                  "stones.yaml");
    return plan_of(model, analysis::check(model));
  };
  const Plan loose = plan(""), held = plan(", {on: above.left, fix: [x]}");
  EXPECT_GT(loose.interior, loose.contact);
  EXPECT_NE(describe(loose).find("where contact takes interior points"), std::string::npos);
  EXPECT_DOUBLE_EQ(loose.contact, held.contact);
  EXPECT_DOUBLE_EQ(held.interior, 0.0);
  EXPECT_EQ(describe(held).find("interior points"), std::string::npos);
}

// 200 blocks that are rigid, at rest and in 50 steps of time: 2 s by Newton's method, minutes if every step took
// interior points.
TEST(Plan, SaysHowLongWallsOfRigidBlocksMayTake) {
  std::string courses;
  for (int k = 0; k < 10; ++k)
    courses += "  row" + std::to_string(k) + ": {rigid: true, density: 2000, shape: {rectangle: {corner: [" +
               (k % 2 == 0 ? "0" : "0.2") + ", " + std::to_string(0.2 * k) +
               "], size: [0.4, 0.2]}}, repeat: {count: 20, step: [0.4, 0]}}\n";
  const model::Model model = input::parse_model(R"(
scabo: 1
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -0.5], size: [10, 0.5]}}}
)" + courses + R"(supports: [{on: floor, fix: [x, y]}]
loads: {weight: {gravity: [0, -9.81]}}
contacts: {joint: {between: all, friction: 0.6}}
curves: {quake: {sine: {amplitude: 3, periods: 1}}}
steps:
  - {name: weight, loads: {weight: 1}}
  - {name: shake, dynamic: {duration: 0.1, step: 0.002, ground: {x: quake}}, increments: 10}
)",
                                                "wall.yaml");
  const Plan plan = plan_of(model, analysis::check(model));
  EXPECT_GT(plan.contact, 0.7);
  EXPECT_LT(plan.contact, 4.0);
  EXPECT_GT(plan.interior, 10.0 * plan.contact);
  EXPECT_NE(describe(plan).find("where contact takes interior points"), std::string::npos);
}

}  // namespace
}  // namespace scabo::run
