// Resultants of stress over sections, totals of contacts, against statics.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "verification/history_columns.hpp"

namespace scabo::verification {
namespace {

/// A beam of length 6 and height 1, built in at the left, under a pressure of 1000 on its top, scaled and turned.
std::string beam(const std::string& mesh, double scale, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto at = [&](double x, double y) {
    return fmt::format("[{}, {}]", scale * (c * x - s * y), scale * (s * x + c * y));
  };
  return fmt::format(R"(scabo: 1
analysis: {{thickness: 0.5}}
materials: {{concrete: {{young: 10e9, poisson: 0.2}}}}
bodies:
  beam: {{material: concrete, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}, mesh: {{{}}}}}
supports: [{{on: beam.edge_4, fix: [x, y]}}]
loads: {{down: {{on: beam.edge_3, pressure: 1000}}}}
output:
  history:
    cut: {{section: {{from: {}, to: {}}}}}
    back: {{section: {{from: {}, to: {}}}}}
)",
                     at(0, 0), at(6, 0), at(6, 1), at(0, 1), mesh, at(3.1, -1), at(3.1, 3), at(3.1, 3), at(3.1, -1));
}

struct BeamCase {
  const char* mesh;
  double accuracy;
};
class SectionOfABeam : public testing::TestWithParam<BeamCase> {};

TEST_P(SectionOfABeam, CarriesTheLoadBeyondIt) {
  for (const double scale : {1.0, 1e-3, 1e3}) {
    for (const double angle : {0.0, 0.7}) {
      const std::string size = fmt::format("{}, size: {}", GetParam().mesh, 0.25 * scale);
      const auto values = history_of(run(beam(size, scale, angle)));
      const double q = 1000.0 * 0.5 * scale, a = 2.9, near = GetParam().accuracy;
      // The section runs upwards, n points to the support, which holds the end up.
      EXPECT_NEAR(values.at("cut.normal") / (q * a), 0.0, near);
      EXPECT_NEAR(values.at("cut.shear") / (q * a), 1.0, near);
      // About the middle of the line, at y = 1, of forces whose line of action is x = 3.1: no change.
      EXPECT_NEAR(values.at("cut.moment") / (0.5 * q * a * a * scale), 1.0, near);
      EXPECT_NEAR(values.at("back.shear"), values.at("cut.shear"), 1e-9 * q);
      EXPECT_NEAR(values.at("back.moment"), -values.at("cut.moment"), 1e-9 * q * scale);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, SectionOfABeam,
                         testing::Values(BeamCase{"order: 2", 4e-3}, BeamCase{"order: 4", 2e-4},
                                         BeamCase{"kind: polygons, order: 2", 4e-3},
                                         BeamCase{"kind: quadtree, order: 2", 1e-2}, BeamCase{"kind: fem", 4e-3}));

TEST(Section, ErrorFallsWithTheMesh) {
  const auto error = [](double size) {
    const auto values = history_of(run(beam(fmt::format("order: 2, size: {}", size), 1.0, 0.0)));
    return std::abs(values.at("cut.shear") / (500.0 * 2.9) - 1.0);
  };
  const double coarse = error(0.25), fine = error(0.125);
  RecordProperty("coarse", fmt::format("{}", coarse));
  EXPECT_LT(fine, 0.3 * coarse);  // second order or better
}

TEST(Section, OfUniformStressIsExact) {
  for (const char* mesh :
       {"size: 0.3", "kind: polygons, size: 0.3", "kind: quadtree, size: 0.25", "kind: fem, size: 0.3"}) {
    const auto values = history_of(run(fmt::format(R"(scabo: 1
analysis: {{thickness: 2}}
materials: {{m: {{young: 1e9, poisson: 0.25}}}}
bodies: {{block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}}}}}}}
supports: [{{on: block.left, fix: x}}, {{on: block.bottom_left, fix: y}}]
loads: {{pull: {{on: block.right, traction: [5, 0]}}}}
output:
  history:
    cut: {{section: {{from: [0.7, 0], to: [0.7, 1]}}}}
    slanted: {{section: {{from: [0.5, -0.5], to: [1.5, 1.5]}}}}
    part: {{section: {{from: [0.9, 0.2], to: [0.9, 0.6]}}}}
)",
                                                   mesh)));
    EXPECT_NEAR(values.at("cut.normal"), 10.0, 1e-8) << mesh;
    EXPECT_NEAR(values.at("cut.shear"), 0.0, 1e-8) << mesh;
    EXPECT_NEAR(values.at("cut.moment"), 0.0, 1e-8) << mesh;
    EXPECT_NEAR(values.at("part.normal"), 4.0, 1e-8) << mesh;
    // Force [-10, 0] on the right part; t = (1, 2) / sqrt(5), n = (-2, 1) / sqrt(5).
    EXPECT_NEAR(values.at("slanted.normal"), 20.0 / std::sqrt(5.0), 1e-8) << mesh;
    EXPECT_NEAR(values.at("slanted.shear"), -10.0 / std::sqrt(5.0), 1e-8) << mesh;
  }
}

TEST(Section, ThroughSeveralBodiesAndAHoleAddsTheirForces) {
  // Two columns of different stiffness under a stiff beam, the left one with a hole.
  const auto solution = run(R"(scabo: 1
materials: {soft: {young: 1e9, poisson: 0}, stiff: {young: 4e9, poisson: 0}}
bodies:
  left: {material: soft, shape: {rectangle: {corner: [0, 0], size: [1, 2]}}, holes: {bore: {circle: {centre: [0.5, 1], radius: 0.2}}}, mesh: {kind: polygons, size: 0.1}}
  right: {material: stiff, shape: {rectangle: {corner: [3, 0], size: [1, 2]}}, mesh: {size: 0.25}}
  cap: {rigid: true, shape: {rectangle: {corner: [-1, 2], size: [6, 1]}}}
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [6, 1]}}}
supports: [{on: floor, fix: [x, y]}, {on: cap, displacement: [0, -1e-3], name: press}]
contacts:
  a: {between: [floor.top, left.bottom], friction: 0.5}
  b: {between: [floor.top, right.bottom], friction: 0.5}
  c: {between: [left.top, cap.bottom], friction: 0.5}
  d: {between: [right.top, cap.bottom], friction: 0.5}
output:
  history:
    middle: {section: {from: [-1, 1], to: [5, 1]}}
    all: press.reaction_y
    one: {section: {from: [-1, 1], to: [5, 1], body: right}}
    other: b.normal_force
)");
  const auto values = history_of(solution);
  EXPECT_NEAR(values.at("middle.normal") / values.at("all"), 1.0, 2e-3);
  EXPECT_NEAR(values.at("one.normal") / -values.at("other"), 1.0, 1e-6);
  EXPECT_NEAR(values.at("other"), 4e9 * 0.5e-3, 1e-3);
}

TEST(ContactTotals, CentreAndMomentAreThoseOfTheLoad) {
  for (const double scale : {1.0, 1e-3, 1e3}) {
    // An inclined force at a corner of a block on a floor, and its weight as a force in the middle.
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.25}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{0}, {0}], size: [{1}, {2}]}}}}}}
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [{3}, {2}]}}}}, mesh: {{size: {4}}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  weight: {{on: block.top, force: [0, -1000]}}
  corner: {{on: block.top_left, force: [100, -300]}}
contacts: {{base: {{between: [floor.top, block.bottom], friction: 0.4, about: [{3}, 0]}}}}
)",
                                          -scale, 5 * scale, scale, 2 * scale, 0.1 * scale));
    const analysis::ContactResult& base = contact_of(last(solution));
    EXPECT_NEAR(base.force.x(), -100.0, 1e-6);
    EXPECT_NEAR(base.force.y(), 1300.0, 1e-6);
    // Moments about the origin: weight -1000 * 1, corner -100 * 1.
    ASSERT_TRUE(base.centre_of_pressure);
    EXPECT_NEAR(base.centre_of_pressure->x() / scale, 1100.0 / 1300.0, 1e-8);
    EXPECT_NEAR(base.centre_of_pressure->y() / scale, 0.0, 1e-12);
    EXPECT_NEAR(base.moment / scale, 1300.0 * (1100.0 / 1300.0 - 2.0), 1e-5);
  }
}

// A uniform pressure or traction on a rigid body once ended the run.
TEST(ContactTotals, OfARigidPunchAreThoseOfItsLoads) {
  const auto solution = run(R"(scabo: 1
analysis: {thickness: 0.5}
materials: {m: {young: 1e9, poisson: 0.2}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [8, 1]}}}
  block: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}
  punch: {rigid: true, shape: {rectangle: {corner: [0.5, 1], size: [1, 1]}}}
supports: [{on: floor, fix: [x, y]}]
loads: {press: {on: punch.top, pressure: 500}, push: {on: punch.left, traction: [50, -100]}}
contacts:
  base: {between: [floor.top, block.bottom], friction: 0.5}
  top: {between: [block.top, punch.bottom], friction: 0.3}
output:
  history: {a: punch.top_left.uy, b: punch.top_right.uy, x: top.centre_x, base_x: base.centre_x, push: top.force_x, n: base.normal_force}
)");
  const auto values = history_of(solution);
  EXPECT_NEAR(values.at("n"), 300.0, 1e-7);
  EXPECT_NEAR(values.at("push"), -25.0, 1e-7);
  // 250 in the middle, 50 at the left side, 25 to the right in the middle of its height.
  EXPECT_NEAR(values.at("x"), (250.0 * 1.0 + 50.0 * 0.5 + 25.0 * 0.5) / 300.0, 1e-8);
  EXPECT_NEAR(values.at("base_x"), (250.0 * 1.0 + 50.0 * 0.5 + 25.0 * 1.5) / 300.0, 1e-8);
  EXPECT_LT(values.at("a"), 0.0);
  EXPECT_LT(values.at("b"), 0.0);
}

TEST(ContactTotals, AreThoseOfTheSharedProperty) {
  const std::string text = R"(scabo: 1
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [8, 1]}}}
  a: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}
  b: {material: m, shape: {rectangle: {corner: [3, 0], size: [1, 1]}}, mesh: {size: 0.25}}
supports: [{on: floor, fix: [x, y]}, {on: a.top, displacement: [1e-4, -1e-3]}, {on: b.top, displacement: [1e-4, -1e-3]}]
contact_properties: {smooth: {friction: 0.01}}
contacts:
  one: {between: [floor.top, a.bottom], property: smooth}
  two: {between: [floor.top, b.bottom], property: smooth, gap: 0.5e-3}
)";
  const auto solution = run(text);
  const auto changed = run(text, {"contact_properties.smooth.friction=0.02"});
  EXPECT_NEAR(contact_of(last(solution), 0).normal_force, 1e6, 1e-2);
  EXPECT_NEAR(contact_of(last(solution), 1).normal_force, 0.5e6, 1e-2);
  for (const std::size_t k : {0u, 1u}) {
    const auto &before = contact_of(last(solution), k), &after = contact_of(last(changed), k);
    EXPECT_NEAR(before.tangential_force / before.normal_force, -0.01, 1e-9);
    EXPECT_NEAR(after.tangential_force / after.normal_force, -0.02, 1e-9);
  }
}

TEST(History, RestoresItsExtremesFromItsTable) {
  const auto solution = run(R"(scabo: 1
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [8, 1]}}}
  a: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}
supports: [{on: floor, fix: [x, y]}, {on: a.top, displacement: [0, -1e-3], name: press}]
contacts: {base: {between: [floor.top, a.bottom], friction: 0.3}}
steps: [{name: down, increments: 3, loads: {press: 1}}, {name: up, increments: 3, loads: {press: -0.5}}]
output: {history: {force: base.normal_force, where: base.centre_x, low: a.bottom_left.uy}}
)");
  last(solution);  // all increments converged
  result::History history(solution.model);
  std::string table = history.header();
  EXPECT_EQ(table, "step,increment,time,force,where,low\n");
  for (const analysis::IncrementResult& increment : solution.increments) table += history.row(solution, increment);
  result::History again(solution.model);
  again.restore(table);
  for (std::size_t c = 0; c < 3; ++c) {
    const result::HistoryExtremes &one = history.extremes()[c], &other = again.extremes()[c];
    ASSERT_EQ(one.last.has_value(), other.last.has_value());
    if (one.last) EXPECT_EQ(one.last->value, other.last->value);
    EXPECT_EQ(one.least->value, other.least->value);
    EXPECT_EQ(one.greatest->step, other.greatest->step);
    EXPECT_EQ(one.greatest->increment, other.greatest->increment);
  }
  const result::HistoryExtremes& force = history.extremes()[0];
  EXPECT_NEAR(force.greatest->value, 1e6, 1e-3);
  EXPECT_EQ(force.greatest->step, 1);
  EXPECT_EQ(force.greatest->increment, 3);
  EXPECT_NEAR(force.last->value, 0.0, 1e-6);
  EXPECT_FALSE(history.extremes()[1].last);  // nothing presses at the end
  EXPECT_TRUE(table.ends_with("\n"));
}

}  // namespace
}  // namespace scabo::verification
