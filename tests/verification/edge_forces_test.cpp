// Resultants over edges against statics: they are in balance with everything else to rounding, on coarse meshes, where
// the body is tied or in contact, and with loads on the edges beside them. Displacements along axes of their own.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "verification/history_columns.hpp"

namespace scabo::verification {
namespace {

class EdgeForcesOnMeshes : public testing::TestWithParam<const char*> {};

// Two halves of a cantilever 6 x 1, tied at x = 3, under pressure on top, its weight and a force at the tip; the turned
// one has the same forces along its edges.
TEST_P(EdgeForcesOnMeshes, OfATiedCantileverBalanceItsLoads) {
  const double q = 1000.0, thickness = 0.5, weight = 300.0, tip = 700.0;  // pressure, body force, force
  for (const double scale : {1.0, 1e-3, 1e3}) {
    for (const double angle : {0.0, 0.7}) {
      const double c = std::cos(angle), s = std::sin(angle);
      const auto at = [&](double x, double y) {
        return fmt::format("[{:.17g}, {:.17g}]", scale * (c * x - s * y), scale * (s * x + c * y));
      };
      const auto half = [&](const char* name, double from, double to) {
        return fmt::format(
            "  {}:\n    material: concrete\n    shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}\n    mesh: {{{}, "
            "size: {}}}\n",
            name, at(from, 0), at(to, 0), at(to, 1), at(from, 1), GetParam(), 0.5 * scale);
      };
      const auto values = history_of(run(fmt::format(
          R"(scabo: 1
analysis: {{thickness: {}}}
materials: {{concrete: {{young: 10e9, poisson: 0.2, expansion: 1e-5}}}}
bodies:
{}{}
ties: {{joint: {{between: [near.edge_2, far.edge_4]}}}}
supports: [{{on: near.edge_4, fix: [x, y]}}]
loads:
  near: {{on: near.edge_3, pressure: {}}}
  far: {{on: far.edge_3, pressure: {}}}
  weight_near: {{on: near, body_force: [{}, {}]}}
  weight_far: {{on: far, body_force: [{}, {}]}}
  warm: {{temperature: {{constant: 10, y: {}}}}}
  tip: {{on: far.vertex_3, force: [{}, {}]}}
output:
  history:
    wall: {{edge: near.edge_4, about: {}, axes: near.edge_4}}
    joint: {{edge: far.edge_4, about: {}, axes: {}}}
    other_side: {{edge: near.edge_2, about: {}}}
    top: {{edge: near.edge_3}}
    end: {{edge: far.edge_2, about: {}, axes: far.edge_2}}
    tip_moves: {{displacement: far.vertex_3, axes: {}}}
    tip_x: far.vertex_3.ux
    tip_y: far.vertex_3.uy
)",
          thickness, half("near", 0, 3), half("far", 3, 6), q, q, s * weight / scale, -c * weight / scale,
          s * weight / scale, -c * weight / scale, 3.0 / scale, s * tip * scale, -c * tip * scale, at(0, 0.5),
          at(3, 0.5), angle * 180.0 / std::numbers::pi, at(3, 0.5), at(6, 0.5), angle * 180.0 / std::numbers::pi)));
      const double f = scale, m = scale * scale, line = thickness * (q + weight);  // force for each metre of length
      const double near = 1e-8 * line * 6.0 * f;
      const std::string where = fmt::format("{}, scale {}, angle {}", GetParam(), scale, angle);
      // Axes of the wall: its normal points against x, its tangent against y.
      EXPECT_NEAR(values.at("wall.normal"), 0.0, near) << where;
      EXPECT_NEAR(values.at("wall.tangential"), -(6.0 * line + tip) * f, near) << where;
      EXPECT_NEAR(values.at("wall.moment"), (18.0 * line + 6.0 * tip) * m, near * scale) << where;
      EXPECT_NEAR(values.at("joint.force_1"), 0.0, near) << where;
      EXPECT_NEAR(values.at("joint.force_2"), (3.0 * line + tip) * f, near) << where;
      EXPECT_NEAR(values.at("joint.moment"), (4.5 * line + 3.0 * tip) * m, near * scale) << where;
      EXPECT_NEAR(values.at("other_side.force_x"), s * (3.0 * line + tip) * f, near) << where;
      EXPECT_NEAR(values.at("other_side.force_y"), -c * (3.0 * line + tip) * f, near) << where;
      EXPECT_NEAR(values.at("other_side.moment"), -values.at("joint.moment"), near * scale) << where;
      // The pressure on top, without what the wall and the tie do at its ends.
      EXPECT_NEAR(values.at("top.force_x"), s * 3.0 * thickness * q * f, near) << where;
      EXPECT_NEAR(values.at("top.force_y"), -c * 3.0 * thickness * q * f, near) << where;
      EXPECT_NEAR(values.at("end.tangential"), -tip * f, near) << where;  // of its corner; the tangent is y
      EXPECT_NEAR(values.at("end.moment"), 0.0, near * scale) << where;
      const double x = values.at("tip_x"), y = values.at("tip_y");
      EXPECT_NEAR(values.at("tip_moves.u1"), c * x + s * y, 1e-12 * std::hypot(x, y));
      EXPECT_NEAR(values.at("tip_moves.u2"), c * y - s * x, 1e-12 * std::hypot(x, y));
    }
  }
}

// A block on a floor with water in the joint, pressed from both sides and from above: every edge has its own load.
TEST_P(EdgeForcesOnMeshes, OfABlockInContactAreThoseOfItsLoadsAndContacts) {
  for (const bool block_is_b : {true, false}) {
    const auto values =
        history_of(run(fmt::format(R"(scabo: 1
materials: {{stone: {{young: 10e9, poisson: 0.2, density: 2500}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
  block: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}, size: 0.5}}}}
supports: [{{on: floor, fix: [x, y]}}]
springs: [{{on: block.right, k_n: 1e9, k_t: 2e9}}]
loads:
  weight: {{gravity: [0, -10]}}
  press: {{on: block.top, pressure: 50e3}}
  push: {{on: block.left, pressure: 20e3}}
  water: {{in: joint, pressure: {{over: x, at: [0, 2], values: [30e3, 0]}}}}
contacts: {{joint: {{between: [{}], friction: 0.4}}}}
output:
  history:
    bottom: {{edge: block.bottom, about: [1, 0], axes: block.bottom}}
    left: {{edge: block.left, about: [0, 0.5]}}
    right: {{edge: block.right}}
    top: {{edge: block.top, about: [1, 1]}}
    n: joint.force_y
    t: joint.force_x
    m: joint.moment
)",
                                   GetParam(), block_is_b ? "floor.top, block.bottom" : "block.bottom, floor.top")));
    const double weight = 2.0 * 2500.0 * 10.0, near = 1e-9 * weight;
    const double on_block = block_is_b ? 1.0 : -1.0;  // `force` and `moment` are those on B
    const double n = on_block * values.at("n"), tangential = on_block * values.at("t"), m = on_block * values.at("m");
    // The normal of the bottom points down, its tangent along x. The contact has effective forces; the water is apart.
    EXPECT_NEAR(values.at("bottom.normal"), -(n + 30e3), near);
    EXPECT_NEAR(values.at("bottom.tangential"), tangential, near);
    EXPECT_NEAR(values.at("bottom.moment"), m - n + 30e3 * (2.0 / 3.0 - 1.0), near);
    EXPECT_NEAR(values.at("left.force_x"), 20e3, near);
    EXPECT_NEAR(values.at("left.force_y"), 0.0, near);
    EXPECT_NEAR(values.at("left.moment"), 0.0, near);
    EXPECT_NEAR(values.at("top.force_y"), -100e3, near);
    EXPECT_NEAR(values.at("top.moment"), 0.0, near);
    EXPECT_NEAR(values.at("left.force_x") + values.at("bottom.tangential") + values.at("right.force_x"), 0.0, near);
    EXPECT_NEAR(-values.at("bottom.normal") + values.at("right.force_y") - 100e3 - weight, 0.0, near);
    EXPECT_LT(values.at("right.force_x"), -1e3);  // the spring, which pushes back
  }
}

// Ground at rest: nothing moves, and the edges carry what the field has there.
TEST_P(EdgeForcesOnMeshes, OfGroundAtRestAreThoseOfItsField) {
  const auto values = history_of(run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{soil: {{young: 50e6, poisson: 0.3}}}}
bodies: {{soil: {{material: soil, shape: {{rectangle: {{corner: [0, -4], size: [6, 4]}}}}, mesh: {{{}, size: 2}}}}}}
supports: [{{on: soil.bottom, fix: y}}, {{on: soil.left, fix: x}}, {{on: soil.right, fix: x}}]
loads: {{at_rest: {{field: {{vertical: {{unit_weight: 20e3, surface: 0}}, K0: 0.5}}}}}}
output:
  history:
    bottom: {{edge: soil.bottom, about: [3, -4]}}
    left: {{edge: soil.left, about: [0, -4]}}
    top: {{edge: soil.top}}
)",
                                                 GetParam())));
  const double near = 1e-8 * 480e3;
  EXPECT_NEAR(values.at("bottom.force_x"), 0.0, near);
  EXPECT_NEAR(values.at("bottom.force_y"), 20e3 * 4.0 * 6.0, near);
  EXPECT_NEAR(values.at("bottom.moment"), 0.0, near);
  EXPECT_NEAR(values.at("left.force_x"), 0.5 * 20e3 * 8.0, near);
  EXPECT_NEAR(values.at("left.moment"), -0.5 * 20e3 * 8.0 * 4.0 / 3.0, near);
  EXPECT_NEAR(values.at("top.force_y"), 0.0, near);
}

// Blocks placed one by one: the load of a block grows over its step, and the edge below carries what acts of it then;
// an absent body transmits nothing.
TEST(EdgeForces, OfABodyThatIsPlacedGrowWithItsLoads) {
  const analysis::StaticSolution solution = run(R"(scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
  low: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
  high: {material: stone, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {kind: quadtree, size: 0.5}, added: second}
supports: [{on: floor, fix: [x, y]}]
loads: {weight: {gravity: [0, -10]}}
contacts: {joints: {between: all, friction: 0.6}}
steps: [{name: first, loads: {weight: 1}}, {name: second, increments: 4}]
output: {history: {base: {edge: low.bottom}, joint: {edge: high.bottom}, sides: {edge: high.left}}}
)");
  ASSERT_EQ(solution.increments.size(), 5u);
  const double weight = 2000.0 * 10.0 * 2.0;
  for (std::size_t k = 0; k < 5; ++k) {
    const std::vector<analysis::EdgeForces>& edges = increment_at(solution, k).edges;
    const double placed = 0.25 * static_cast<double>(k);
    EXPECT_NEAR(edges[0].force.y(), weight * (1.0 + placed), 1e-8 * weight) << k;
    EXPECT_NEAR(edges[1].force.y(), weight * placed, 1e-8 * weight) << k;
    EXPECT_NEAR(edges[2].force.norm(), 0.0, 1e-8 * weight) << k;
  }
}

// Blocks that are taken away: what they exerted falls to zero over the step and acts through the edges on which they
// stood and leaned, not through those that begin at their corners. `side` leaves before `high`, or both together.
TEST(EdgeForces, OfABodyWhoseNeighboursAreTakenAwayCarryWhatIsLeftOfThem) {
  for (const bool together : {false, true}) {
    const analysis::StaticSolution solution = run(fmt::format(R"(scabo: 1
materials: {{stone: {{young: 1e9, poisson: 0.2, density: 2000}}}}
bodies:
  low: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
  high: {{material: stone, shape: {{rectangle: {{corner: [0, 1], size: [2, 1]}}}}, mesh: {{size: 0.5}}, removed: {}}}
  side: {{material: stone, shape: {{rectangle: {{corner: [2, 0], size: [1, 1]}}}}, mesh: {{size: 0.5}}, removed: last}}
supports: [{{on: low.bottom, fix: [x, y]}}, {{on: side.bottom, fix: y}}]
loads: {{weight: {{gravity: [0, -10]}}, push: {{on: side.right, pressure: 3e4}}}}
contacts:
  joint: {{between: [low.top, high.bottom], friction: 0.6}}
  wall: {{between: [low.right, side.left]}}
steps: [{{name: first}}, {{name: last, increments: 4}}, {{name: end, increments: 4}}]
output:
  history: {{top: {{edge: low.top}}, right: {{edge: low.right}}, left: {{edge: low.left}}, base: {{edge: low.bottom}}}}
)",
                                                              together ? "last" : "end"));
    ASSERT_EQ(solution.increments.size(), 9u);
    const double weight = 2000.0 * 10.0 * 2.0, near = 1e-9 * weight;
    for (std::size_t k = 0; k < 9; ++k) {
      const std::vector<analysis::EdgeForces>& edges = increment_at(solution, k).edges;
      const double pushed = std::max(0.0, 1.0 - 0.25 * static_cast<double>(k)),
                   weighed = together ? pushed : std::min(1.0, 2.0 - 0.25 * static_cast<double>(k));
      Vec2 sum = Vec2(0.0, -weight);
      double moment = -weight;
      for (const analysis::EdgeForces& edge : edges) sum += edge.force, moment += edge.moment;
      EXPECT_NEAR(sum.norm(), 0.0, near) << k;
      EXPECT_NEAR(moment, 0.0, near) << k;
      EXPECT_NEAR((edges[3].force - Vec2(3e4 * pushed, weight * (1.0 + weighed))).norm(), 0.0, near) << k;
      EXPECT_NEAR(edges[2].force.norm(), 0.0, near) << k;
      // Together, both have half of what acts at their common corner.
      if (together && k > 0) continue;
      EXPECT_NEAR((edges[0].force - Vec2(0.0, -weight * weighed)).norm(), 0.0, near) << k;
      EXPECT_NEAR((edges[1].force - Vec2(-3e4 * pushed, 0.0)).norm(), 0.0, near) << k;
    }
  }
}

// Side faces: the load on them beyond the last node, next to the scaling centre, belongs to them. Pressure and linear
// traction by hand.
TEST(EdgeForces, OfSideFacesHaveTheWholeOfTheirLoads) {
  const auto values = history_of(run(R"(scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies: {block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5, centre: [2, 1]}}}
supports: [{on: block.bottom, fix: [x, y]}]
springs: [{on: block.right, k_n: 1e9}]
loads:
  top: {on: block.top, pressure: 1000}
  side: {on: block.right, traction: {points: [[0, 0, 100], [1, 0, 400]]}}
output: {history: {top: {edge: block.top}, right: {edge: block.right}, bottom: {edge: block.bottom}, left: {edge: block.left}}}
)"));
  const double near = 1e-12 * 2000.0;  // 2e-7 where the last part was left out
  EXPECT_NEAR(values.at("top.force_x"), 0.0, near);
  EXPECT_NEAR(values.at("top.force_y"), -2000.0, near);
  EXPECT_NEAR(values.at("top.moment"), -2000.0, near);
  EXPECT_NEAR(values.at("right.force_y"), 250.0, near);
  for (const char* of : {"force_x", "force_y", "moment"}) {
    double sum = 0.0;
    for (const char* edge : {"top.", "right.", "bottom.", "left."}) sum += values.at(std::string(edge) + of);
    EXPECT_NEAR(sum, 0.0, 10.0 * near) << of;
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, EdgeForcesOnMeshes,
                         testing::Values("order: 2", "order: 1", "kind: polygons", "kind: quadtree, order: 3",
                                         "kind: fem"));

}  // namespace
}  // namespace scabo::verification
