// Loads that vary along edges, and water, against closed forms: resultants, moments, deflections, buoyancy.
#include <fmt/format.h>

#include <numbers>

#include "run.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/system/loads.hpp"

namespace scabo::verification {
namespace {

constexpr double pi = std::numbers::pi;

/// Force, and moment about the origin, of the only load of a model on elastic bodies.
struct Resultant {
  Vec2 force = Vec2::Zero();
  double moment = 0.0;
};
Resultant resultant_of(const std::string& text) {
  const model::Model model = input::parse_model(text, "test.yaml", {});
  const mesh::Mesh mesh = mesh::make_mesh(model);
  Resultant sum;
  for (const model::Load& load : model.loads) {
    const auto body = static_cast<std::size_t>(load.on->body), edge = static_cast<std::size_t>(load.on->index);
    const system::VaryingTraction varying =
        std::holds_alternative<model::Water>(load.kind)
            ? system::varying_traction(std::get<model::Water>(load.kind))
            : system::varying_traction(std::get<model::EdgeTable>(load.kind), model.bodies[body].outline.edges[edge]);
    const auto& nodes = mesh.bodies[body].nodes;
    const Vector f = system::traction_forces(mesh.bodies[body].edges[edge], nodes, model.analysis.thickness,
                                             varying.traction, varying.breaks);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vec2 force = f.segment<2>(static_cast<Eigen::Index>(2 * i));
      sum.force += force;
      sum.moment += cross(nodes[i], force);
    }
  }
  return sum;
}

/// A triangle with the inclined edge_2 from (4, 0) to (0, 3), of length 5, its outward normal (0.6, 0.8).
std::string triangle(const std::string& load, double size, int order, const std::string& kind = "superelement") {
  return fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.5}}
materials: {{stuff: {{young: 10e9, poisson: 0.2}}}}
bodies:
  wedge:
    material: stuff
    shape: {{polygon: {{vertices: [[0, 0], [4, 0], [0, 3]]}}}}
    mesh: {{size: {}, order: {}, kind: {}}}
supports: [{{on: wedge.edge_1, fix: [x, y]}}]
loads: {{load: {{on: wedge.edge_2, {}}}}}
)",
                     size, order, kind, load);
}

// p = 100 s / 5 along the edge: resultant 250 at 10/3 from (4, 0), that is at (4/3, 2), against (0.6, 0.8).
TEST(EdgeLoads, LinearPressureHasItsResultantAndMomentOnAnyMesh) {
  const Vec2 force = 0.5 * -250.0 * Vec2(0.6, 0.8);
  const double moment = cross(Vec2(4.0 / 3.0, 2.0), force);
  for (const char* form :
       {"{at: [[4, 0], [0, 3]], values: [0, 100]}", "{at: [[0, 3], [4, 0]], values: [100, 0]}",
        "{over: y, at: [0, 3], values: [0, 100]}", "{over: x, at: [0, 4], values: [100, 0]}",
        "{over: length, at: [0, 5], values: [0, 100]}", "{over: length, at: [0, 2.3, 5], values: [0, 46, 100]}"})
    for (const int order : {1, 2, 5})
      for (const double size : {5.0, 0.7}) {
        const Resultant sum = resultant_of(triangle(fmt::format("pressure: {}", form), size, order));
        EXPECT_LT((sum.force - force).norm(), 1e-12 * force.norm()) << form << order;
        EXPECT_NEAR(sum.moment, moment, 1e-12 * std::abs(moment)) << form << order;
      }
}

// Over a part of the edge, with a jump inside: 10 for 1 < s < 2 and from 30 down to 0 for 2 < s < 3.5, whatever
// elements it begins and ends in. Force 10 + 22.5 = 32.5; about (4, 0): 10 * 1.5 + 22.5 * 2.5 = 71.25.
TEST(EdgeLoads, ActOnPartsOfElements) {
  for (const int order : {1, 2, 3})
    for (const double size : {5.0, 1.1}) {
      const Resultant sum = resultant_of(triangle(
          "traction: {over: length, at: [1, 2, 2, 3.5], values: [[0, -10], [0, -10], [0, -30], [0, 0]]}", size, order));
      EXPECT_NEAR(sum.force.y(), -0.5 * 32.5, 1e-12);
      EXPECT_NEAR(sum.moment, -0.5 * (4.0 * 32.5 - 0.8 * 71.25), 1e-11);
    }
}

// A cantilever under q (1 - x/L): tip deflection q L^4 / 30 E I by bending, q L^2 / 6 k G A by shear, k = 5/6; in
// metres, in millimetres, and turned by 37 degrees.
TEST(EdgeLoads, BendACantileverUnderATriangularLoad) {
  const auto tip = [](double unit, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), L = 10.0 * unit, h = unit;
    const auto at = [&](double x, double y) { return fmt::format("[{:.17g}, {:.17g}]", c * x - s * y, s * x + c * y); };
    const auto solution =
        run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {1:.17g}}}
materials: {{stuff: {{young: {2:.17g}, poisson: 0}}}}
bodies:
  beam:
    material: stuff
    shape: {{polygon: {{vertices: [{3}, {4}, {5}, {6}], names: {{bottom: edge_1, top: edge_3, left: edge_4}}}}}}
    mesh: {{size: {1:.17g}, order: 4}}
supports: [{{on: beam.left, fix: [x, y]}}]
loads: {{load: {{on: beam.top, pressure: {{at: [{6}, {5}], values: [{7:.17g}, 0]}}}}}}
)",
                        0, h, 1e9 / unit / unit, at(0, 0), at(L, 0), at(L, h), at(0, h), 1e3 / unit / unit));
    const Vector& u = last(solution).fields.displacements.front();
    const auto corner = static_cast<std::size_t>(solution.mesh.bodies.front().corners[2]);
    const Vec2 at_tip = u.segment<2>(static_cast<Eigen::Index>(2 * corner));
    return cross(Vec2(c, s), at_tip) / unit;
  };
  const double bending = 1e3 * 1e4 / 30.0 / (1e9 / 12.0), shear = 1e3 * 100.0 / 6.0 / (5.0 / 6.0 * 0.5e9);
  const double metres = tip(1.0, 0.0);
  EXPECT_NEAR(metres, -(bending + shear), 1e-3 * bending);
  EXPECT_NEAR(tip(1000.0, 0.0), metres, 1e-10 * std::abs(metres));
  EXPECT_NEAR(tip(1.0, 37.0 * pi / 180.0), metres, 1e-9 * std::abs(metres));
}

// Water 2.1 above the toe of the inclined face of a wedge: it presses on 3.5 of its length with 9810 * 2.1 at the foot.
TEST(Water, PressesOnADamFaceToItsLevelOnAnyMesh) {
  const double force = 0.5 * 0.5 * 9810.0 * 2.1 * 3.5;
  // At a third of 3.5 from (4, 0); about (4, 0), an arm of 3.5 / 3.
  const Vec2 along = -force * Vec2(0.6, 0.8), foot(4.0 - 0.8 * 3.5 / 3.0, 0.6 * 3.5 / 3.0);
  for (const char* kind : {"superelement", "polygons", "quadtree"})
    for (const double size : {5.0, 0.7}) {
      const int order = kind[0] == 's' ? 3 : 2;
      const Resultant sum = resultant_of(triangle("water: {level: 2.1, unit_weight: 9810}", size, order, kind));
      EXPECT_LT((sum.force - along).norm(), 1e-12 * force) << kind;
      EXPECT_NEAR(sum.moment, cross(foot, along), 1e-11 * force) << kind;
    }
  const auto solution = run(triangle("water: {level: 2.1, unit_weight: 9810}", 0.7, 2));
  EXPECT_LT((last(solution).reactions.front() + along).norm(), 1e-9 * force);
}

TEST(Water, TurnedWithItsModelIsTheSame) {
  const Vec2 e1(0.8, 0.6), e2(-0.6, 0.8);  // the triangle of above, turned by atan(3/4): vertices by hand
  std::string text = triangle("water: {level: 2.1, unit_weight: 9810, up: [-3, 4]}", 0.7, 2);
  text.replace(text.find("[[0, 0], [4, 0], [0, 3]]"), 24, "[[0, 0], [3.2, 2.4], [-1.8, 2.4]]");
  const Resultant turned = resultant_of(text);
  const Resultant upright = resultant_of(triangle("water: {level: 2.1, unit_weight: 9810}", 0.7, 2));
  EXPECT_LT((turned.force - (upright.force.x() * e1 + upright.force.y() * e2)).norm(), 1e-9);
  EXPECT_NEAR(turned.moment, upright.moment, 1e-9);
}

/// A disc of radius 2 about (1, 3) in water on all its edges; its rim as four arcs.
std::string disc(double level, int order, double size) {
  std::string loads;
  for (int k = 1; k <= 4; ++k)
    loads += fmt::format("  w{0}: {{on: disc.edge_{0}, water: {{level: {1}, unit_weight: 10}}}}\n", k, level);
  return fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 10e9, poisson: 0.2}}}}
bodies:
  disc:
    material: stuff
    shape:
      outline:
        - arc: {{to: [1, 5], centre: [1, 3]}}
        - arc: {{to: [-1, 3], centre: [1, 3]}}
        - arc: {{to: [1, 1], centre: [1, 3]}}
        - arc: {{to: [3, 3], centre: [1, 3]}}
    mesh: {{size: {}, order: {}}}
supports: [{{on: disc.edge_4, fix: [x, y]}}]
loads:
{}
)",
                     size, order, loads);
}

// Archimedes: the weight of the water displaced, through its centroid, for the polygon of straight elements exactly,
// for curved ones as fast as they approach the circle; half submerged, half the disc: centroid does not matter on x
// = 1.
TEST(Water, LiftsASubmergedBodyByTheWeightOfTheWater) {
  for (const double size : {0.9, 0.3}) {
    const mesh::Mesh mesh = mesh::make_mesh(input::parse_model(disc(7.0, 1, size), "test.yaml", {}));
    double area = 0.0;
    for (const auto& edge : mesh.bodies.front().edges)
      for (const mesh::LineElement& element : edge)
        area += 0.5 * cross(mesh.bodies.front().nodes[static_cast<std::size_t>(element.nodes[0])],
                            mesh.bodies.front().nodes[static_cast<std::size_t>(element.nodes[1])]);
    const Resultant sum = resultant_of(disc(7.0, 1, size));
    EXPECT_LT((sum.force - Vec2(0.0, 10.0 * area)).norm(), 1e-11 * area);
    EXPECT_NEAR(sum.moment, 10.0 * area, 1e-11 * area);
  }
  const Resultant all = resultant_of(disc(7.0, 6, 0.6)), half = resultant_of(disc(3.0, 6, 0.6));
  EXPECT_LT((all.force - Vec2(0.0, 40.0 * pi)).norm(), 1e-8);
  EXPECT_NEAR(all.moment, 40.0 * pi, 1e-8);
  EXPECT_LT((half.force - Vec2(0.0, 20.0 * pi)).norm(), 1e-8);
  EXPECT_LT(resultant_of(disc(0.9, 2, 0.6)).force.norm(), 1e-14);
}

// A rigid box 2 x 1 of thickness 0.5 whose bottom is 0.6 deep, held at two corners: 10 * 0.6 * 2 * 0.5 = 6 upwards,
// half at each; a pressure of 8 y / 1 on its left side, 2 in total at 2/3 of the height, changes them by 2 * (2/3) / 2.
TEST(EdgeLoads, ActOnRigidBodiesByForceAndMoment) {
  const std::string text = R"(
scabo: 1
analysis: {thickness: 0.5}
materials: {stuff: {young: 10, poisson: 0}}
bodies:
  box: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}}
  block: {material: stuff, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 2}}
supports:
  - {on: box.bottom_left, fix: [x, y], name: a}
  - {on: box.bottom_right, fix: y, name: b}
  - {on: block.top, fix: [x, y]}
loads:
  water: {on: box.bottom, water: {level: 0.6, unit_weight: 10}}
  side: {on: box.left, pressure: {over: y, at: [0, 1], values: [0, 8]}}
contacts: {c: {between: [box.top, block.bottom]}}
)";
  const auto solution = run(text);
  const auto& increment = last(solution);
  const double moved = 2.0 * (2.0 / 3.0) / 2.0;
  EXPECT_LT((increment.reactions[0] - Vec2(-2.0, -3.0 - moved)).norm(), 1e-12);
  EXPECT_NEAR(increment.reactions[1].y(), -3.0 + moved, 1e-12);
}

}  // namespace
}  // namespace scabo::verification
