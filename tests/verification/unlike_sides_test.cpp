// Sides whose nodes coincide although their elements do not, and rigid sides that end within elements: uniform stress
// passes exactly, whatever kinds of mesh meet.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "support/mesh_text.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

// ---- orders ----------------------------------------------------------------------------------------------

struct Kind {
  const char* name;
  bool file;  // of the quadrilaterals of a file
};
constexpr std::array<Kind, 6> kinds{{{"superelement", false},
                                     {"polygons", false},
                                     {"quadtree", false},
                                     {"fem", false},
                                     {"superelement", true},
                                     {"fem", true}}};

/// A block of 2 x height at y: elements of length 1 and order 2, or of half the length and order 1, whose nodes
/// coincide.
std::string block(const Kind& kind, bool quadratic, double height, double y) {
  if (kind.file) {
    test::MeshText mesh = test::mesh_of_rectangle(quadratic ? 23 : 9, 2.0, height, quadratic ? 2 : 4, 3);
    for (Vec2& node : mesh.nodes) node.y() += y;
    return fmt::format("{{material: m, mesh: {{file: {}, elements: {}}}}}", mesh.file(), kind.name);
  }
  return fmt::format(
      "{{material: m, shape: {{rectangle: {{corner: [0, {}], size: [2, {}]}}}}, mesh: {{kind: {}, size: {}, order: "
      "{}}}}}",
      y, height, kind.name, quadratic ? 1.0 : 0.5, quadratic ? 2 : 1);
}

class CoincidentNodes : public testing::TestWithParam<int> {};

// Two blocks of one material under a uniform pressure of 1e6: displacements are those of one block. Before the orders
// were compared, displacements were wrong by 15 % in ties and pressures by 8 % in contacts.
TEST_P(CoincidentNodes, UniformStressWithOtherOrders) {
  const Kind& below = kinds[static_cast<std::size_t>(GetParam())];
  for (const Kind& above : kinds)
    for (const bool quadratic_below : {true, false})
      for (const char* joint : {"contacts: {c: {friction: 0.5, between:", "ties: {c: {between:"})
        for (const bool swapped : {false, true}) {
          const auto edge = [](const Kind& kind, const char* body, bool top) {
            return fmt::format("{}.{}", body, kind.file ? (top ? "edge_3" : "edge_1") : (top ? "top" : "bottom"));
          };
          const std::string a = edge(below, "lower", true), b = edge(above, "upper", false);
          const std::string text = fmt::format(
              R"(scabo: 1
materials: {{m: {{young: 30e9, poisson: 0.2}}}}
bodies:
  lower: {}
  upper: {}
supports:
  - {{on: {}, fix: [y]}}
  - {{on: lower.{}, fix: [x]}}
loads: {{weight: {{on: {}, pressure: 1e6}}}}
{} [{}, {}]}}}}
)",
              block(below, quadratic_below, 1.0, 0.0), block(above, !quadratic_below, 1.5, 1.0),
              edge(below, "lower", false), below.file ? "vertex_1" : "bottom_left", edge(above, "upper", true), joint,
              swapped ? b : a, swapped ? a : b);
          SCOPED_TRACE(text);
          const auto solution = run(text);
          const analysis::IncrementResult& increment = last(solution);
          for (const analysis::ContactResult& contact : increment.contacts)
            for (const analysis::PairResult& pair : contact.pairs) EXPECT_NEAR(pair.pressure, 1e6, 1e-9 * 1e6);
          const double longest = 2.5 * 1e6 / 30e9;
          for (std::size_t body = 0; body < 2; ++body)
            for (std::size_t i = 0; i < solution.mesh.bodies[body].nodes.size(); ++i) {
              const Vec2& x = solution.mesh.bodies[body].nodes[i];
              const auto k = static_cast<Eigen::Index>(2 * i);
              EXPECT_NEAR(increment.fields.displacements[body][k], 0.2 * x.x() * 1e6 / 30e9, 1e-9 * longest);
              EXPECT_NEAR(increment.fields.displacements[body][k + 1], -x.y() * 1e6 / 30e9, 1e-9 * longest);
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoincidentNodes, testing::Range(0, static_cast<int>(kinds.size())));

// A ring under internal pressure of two rings whose nodes coincide where they meet, Lame: u(b) = 2 p a^2 b / (E (b^2 -
// a^2)) and the pressure between them.
TEST(UnlikeSides, RingsWhoseNodesCoincide) {
  const auto ring = [](double inner, double outer, const char* mesh) {
    return fmt::format(
        "{{material: m, mesh: {{{2}}}, shape: {{outline: [{{line: {{from: [{0}, 0], to: [{1}, 0]}}, name: base}}, "
        "{{arc: {{to: [0, {1}], centre: [0, 0]}}, name: outer}}, {{line: {{to: [0, {0}]}}, name: side}}, "
        "{{arc: {{to: [{0}, 0], centre: [0, 0], direction: clockwise}}, name: inner}}]}}}}",
        inner, outer, mesh);
  };
  const char *quadratic = "size: 0.1, order: 2", *linear = "size: 0.05, order: 1";
  for (const bool quadratic_inside : {true, false})
    for (const char* joint : {"ties", "contacts"})
      for (const bool swapped : {false, true}) {
        const auto solution = run(fmt::format(
            R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.3}}}}
bodies:
  i: {}
  o: {}
supports: [{{on: i.base, fix: y}}, {{on: i.side, fix: x}}, {{on: o.base, fix: y}}, {{on: o.side, fix: x}}]
loads: {{p: {{on: i.inner, pressure: 1e6}}}}
{}: {{c: {{between: [{}]}}}}
)",
            ring(1.0, 1.5, quadratic_inside ? quadratic : linear),
            ring(1.5, 2.0, quadratic_inside ? linear : quadratic), joint,
            swapped ? "o.inner, i.outer" : "i.outer, o.inner"));
        const analysis::IncrementResult& increment = last(solution);
        for (const analysis::ContactResult& contact : increment.contacts) {
          const double pressure = 1e6 / 3.0 * (4.0 / 2.25 - 1.0);
          for (const analysis::PairResult& pair : contact.pairs) EXPECT_NEAR(pair.pressure, pressure, 0.02 * pressure);
        }
        const std::vector<Vec2>& nodes = solution.mesh.bodies[1].nodes;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          if (nodes[i].norm() < 2.0 - 1e-9) continue;
          const Vec2 u = increment.fields.displacements[1].segment<2>(static_cast<Eigen::Index>(2 * i));
          EXPECT_NEAR(u.dot(nodes[i].normalized()), 4e6 / 3e9, 3e-3 * 4e6 / 3e9);
        }
      }
}

// ---- ends of rigid edges ---------------------------------------------------------------------------------

struct OnFloors {
  std::vector<double> ends{-1.0, 0.35, 2.0};  // of the floors, one after the other
  std::string mesh = "order: 2";
  double size = 0.25, unit = 1.0, angle = 0.0;
  bool swapped = false, block_first = false;
};

/// A block of 1 x 1 on rigid floors, under a pressure of 1e6; turned and in other units.
std::string text_of(const OnFloors& model) {
  const auto at = [&](double x, double y) {
    const double c = std::cos(model.angle), s = std::sin(model.angle);
    return fmt::format("[{:.17g}, {:.17g}]", model.unit * (c * x - s * y), model.unit * (s * x + c * y));
  };
  const auto box = [&](double left, double right, double low, double high) {
    return fmt::format("shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}", at(left, low), at(right, low),
                       at(right, high), at(left, high));
  };
  const std::string block = fmt::format("  b: {{material: m, {}, mesh: {{{}, size: {:.17g}}}}}\n",
                                        box(0.0, 1.0, 0.0, 1.0), model.mesh, model.size * model.unit);
  std::string bodies = model.block_first ? block : "", supports, contacts;
  for (std::size_t k = 0; k + 1 < model.ends.size(); ++k) {
    bodies += fmt::format("  f{}: {{rigid: true, {}}}\n", k, box(model.ends[k], model.ends[k + 1], -1.0, 0.0));
    supports += fmt::format("  - {{on: f{}, fix: [x, y]}}\n", k);
    contacts +=
        fmt::format("  c{}: {{between: [{}]}}\n", k,
                    model.swapped ? fmt::format("b.edge_1, f{}.edge_3", k) : fmt::format("f{}.edge_3, b.edge_1", k));
  }
  if (!model.block_first) bodies += block;
  return fmt::format(
      "scabo: 1\nmaterials: {{m: {{young: {0:.17g}, poisson: 0.3}}}}\nbodies:\n{1}supports:\n{2}"
      "loads: {{p: {{on: b.edge_3, pressure: {3:.17g}}}}}\ncontacts:\n{4}",
      1e9 / (model.unit * model.unit), bodies, supports, 1e6 / (model.unit * model.unit), contacts);
}

void expect_uniform(const OnFloors& model) {
  const std::string text = text_of(model);
  SCOPED_TRACE(text);
  const auto solution = run(text);
  const analysis::IncrementResult& increment = last(solution);
  for (std::size_t c = 0; c < increment.contacts.size(); ++c) {
    const double share = std::min(model.ends[c + 1], 1.0) - std::max(model.ends[c], 0.0);
    EXPECT_NEAR(increment.contacts[c].normal_force * model.unit, share * 1e6, 1e-9 * 1e6);
    for (const analysis::PairResult& pair : increment.contacts[c].pairs)
      EXPECT_NEAR(pair.pressure * model.unit * model.unit, 1e6, 1e-8 * 1e6);
  }
}

// The pressure is 1 MPa everywhere and each floor carries its share, .35 MN the first: where the floors met within an
// element the pressure was 2 MPa at one node and the force .292 MN.
TEST(RigidEnds, FloorsThatMeetWithinAnElement) {
  for (const char* mesh : {"order: 1", "order: 2", "order: 3", "kind: polygons, order: 1", "kind: polygons, order: 2",
                           "kind: quadtree, order: 1", "kind: quadtree, order: 2", "kind: fem"}) {
    OnFloors model;
    model.mesh = mesh;
    expect_uniform(model);
    model.block_first = model.swapped = true;
    model.angle = 0.7;
    expect_uniform(model);
  }
  for (const double unit : {1e3, 1e-3})
    for (const double size : {0.25, 0.09}) {
      OnFloors model;
      model.unit = unit;
      model.size = size;
      expect_uniform(model);
    }
}

// Ends near nodes, which move there, at nodes, at middle nodes, and near a corner, which stays.
TEST(RigidEnds, AnywhereOnAnElement) {
  for (const double end : {0.5, 0.51, 0.49, 0.375, 0.01, 0.99, 0.2})
    for (const char* mesh : {"order: 1", "order: 2", "kind: polygons, order: 2"}) {
      OnFloors model;
      model.mesh = mesh;
      model.ends = {-1.0, end, 2.0};
      expect_uniform(model);
      model.ends = {-1.0, 0.13, 0.14, std::max(end, 0.16), 2.0};
      expect_uniform(model);
    }
}

// A block under its weight on a floor that ends at .95 of it: the pressure has no resultant moment about any point, so
// that its force is the weight, at the middle of the block. No node but the first was on the floor, a false mechanism.
TEST(RigidEnds, AFloorThatEndsBelowABlock) {
  for (const char* order : {"1", "2"})
    for (const double unit : {1.0, 1e3, 1e-3}) {
      const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.3, density: 2000}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{0}, {0}], size: [{1}, {2}]}}}}}}
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [{2}, {3}]}}}}, mesh: {{size: {2}, order: {4}}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -9.81]}}}}
contacts: {{c: {{between: [floor.top, block.bottom], friction: 0.5}}}}
)",
                                            -unit, 1.95 * unit, unit, 0.5 * unit, order));
      const analysis::ContactResult& contact = contact_of(last(solution));
      const double weight = 2000 * 9.81 * 0.5 * unit * unit;
      double moment = 0.0;
      for (const analysis::PairResult& pair : contact.pairs) moment += pair.normal_force * pair.position.x();
      EXPECT_NEAR(contact.normal_force, weight, 1e-9 * weight);
      EXPECT_NEAR(moment, 0.5 * unit * weight, 1e-9 * unit * weight);
      EXPECT_NEAR(contact.pairs.back().position.x(), 0.95 * unit, 1e-12 * unit);
    }
}

}  // namespace
}  // namespace scabo::verification
