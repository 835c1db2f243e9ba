// Bars between two points: bolts with preload, anchors in the ground, inclined springs, bars on rigid bodies and within
// one body; twins in other units, turned, mirrored and in another order.
#include <fmt/format.h>

#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Coordinates in another unit of length, mirrored in x, then turned about the origin; forces in another unit.
struct BarFrame {
  double angle = 0.0, length = 1.0, force = 1.0;
  bool mirrored = false;
  Vec2 turned(const Vec2& given) const {
    const Vec2 x(mirrored ? -given.x() : given.x(), given.y());
    return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
  }
  std::string vector(const Vec2& v) const {
    const Vec2 d = turned(v);
    return fmt::format("[{:.17g}, {:.17g}]", d.x(), d.y());
  }
  std::string point(double x, double y) const { return vector(length * Vec2(x, y)); }
  std::string of_force(double x, double y) const { return vector(force * Vec2(x, y)); }
  std::string box(double x, double y, double width, double height) const {
    return fmt::format(
        "{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
        "edge_4}}}}}}",
        point(x, y), point(x + width, y), point(x + width, y + height), point(x, y + height));
  }
  double pascal() const { return force / (length * length); }
  double per_length() const { return force / length; }
};

constexpr double width = 0.2, height = 0.3, thickness = 0.1, young = 70e9;
constexpr double stiffness_of_block = young * width * thickness / height;
constexpr double below = 0.15, area = 8e-4, young_of_bolt = 210e9, preload = 150e3;
constexpr double stiffness_of_bolt = young_of_bolt * area / (height + below);
constexpr double pull = 100e3;  // less than separates the joint

/// A block on a rigid floor, with a bolt from its top through it into the ground, tightened and then pulled.
std::string bolted_joint(const BarFrame& at, bool other_order = false) {
  const std::string floor = fmt::format("  floor: {{rigid: true, shape: {}}}\n", at.box(-0.5, -0.1, 1.0, 0.1)),
                    block = fmt::format("  block: {{material: stuff, shape: {}, mesh: {{size: {}}}}}\n",
                                        at.box(-0.5 * width, 0.0, width, height), 0.1 * at.length);
  const std::string ground = at.point(0.0, -below);
  return fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stuff: {{young: {}, poisson: 0}}}}
bodies:
{}supports: [{{on: floor, fix: [x, y]}}, {{on: block.vertex_1, fix: {{along: {}}}}}]
bars:
  bolt: {{between: [{}], area: {}, young: {}, preload: {}}}
loads: {{pull: {{on: block.top, force: {}}}}}
contacts: {{joint: {{between: [{}]}}}}
steps: [{{name: tighten, loads: {{pull: 0}}}}, {{name: pull, increments: 2, loads: {{pull: 1}}}}, {{name: apart, loads: {{pull: 3}}}}]
)",
                     thickness * at.length, young * at.pascal(), other_order ? block + floor : floor + block,
                     at.vector(Vec2(1.0, 0.0)), other_order ? ground + ", block.top" : "block.top, " + ground,
                     area * at.length * at.length, young_of_bolt * at.pascal(), preload * at.force,
                     at.of_force(0.0, pull), other_order ? "block.bottom, floor.top" : "floor.top, block.bottom");
}

// The diagram of a bolted joint: after tightening bolt and joint have the preload F; a pull P goes to the bolt in the
// part k_b / (k_b + k_c), and once the joint is open to the bolt alone.
TEST(Bars, ABoltSharesThePullWithTheJoint) {
  const double share = stiffness_of_bolt / (stiffness_of_bolt + stiffness_of_block);
  for (const auto& [frame, other_order] :
       {std::pair(BarFrame{}, false), std::pair(BarFrame{.length = 1e3, .force = 1e-3}, false),
        std::pair(BarFrame{.angle = 0.7, .mirrored = true}, false), std::pair(BarFrame{.angle = 2.9}, true)}) {
    const auto solution = run(bolted_joint(frame, other_order));
    last(solution);
    const double at[4] = {0.0, 0.5 * pull, pull, 3.0 * pull};
    for (std::size_t i = 0; i < 4; ++i) {
      const analysis::IncrementResult& increment = increment_at(solution, i);
      const bool open = i == 3;
      EXPECT_NEAR(increment.bars[0] / frame.force, open ? at[i] : preload + share * at[i], 1e-9 * preload);
      EXPECT_NEAR(contact_of(increment).normal_force / frame.force, open ? 0.0 : preload - (1.0 - share) * at[i],
                  1e-9 * preload);
      if (open) continue;
      EXPECT_NEAR(increment.energy.external, increment.energy.elastic, 1e-10 * increment.energy.elastic);
    }
    // Stored after tightening: in the block alone; with the pull also what the bolt adds to its preload.
    const double units = frame.force * frame.length;
    EXPECT_NEAR(increment_at(solution, 0).energy.elastic / units, 0.5 * preload * preload / stiffness_of_block,
                1e-9 * preload);
    const double pressed = preload - (1.0 - share) * pull, more = share * pull;
    EXPECT_NEAR(increment_at(solution, 2).energy.elastic / units,
                0.5 * pressed * pressed / stiffness_of_block + 0.5 * more * more / stiffness_of_bolt, 1e-9 * preload);
  }
}

// A rigid lid on a hinge at the origin, held by an inclined bar from a corner to the ground: N = F a / b with the arms
// a of the force and b of the bar, and the lid turns by N / (k b). Pull and push alike.
TEST(Bars, OnARigidBodyHaveTheirArm) {
  const double k = 4e6, a = 1.2, F = 5e3;
  const Vec2 corner(1.2, 0.2), ground(0.5, 2.0), e = (ground - corner).normalized();
  const double arm = cross(corner, e);
  for (const double side : {1.0, -1.0})
    for (const BarFrame& frame : {BarFrame{}, BarFrame{.angle = -0.4}, BarFrame{.length = 1e3, .mirrored = true}}) {
      const double turn = frame.mirrored ? -1.0 : 1.0;
      const auto solution =
          run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
  aside: {{material: stuff, shape: {}, mesh: {{size: {}}}}}
  lid: {{rigid: true, shape: {}}}
supports: [{{on: aside, fix: [x, y]}}, {{on: lid.vertex_1, fix: [x, y]}}]
bars: {{rod: {{between: [lid.vertex_3, {}], k: {}}}}}
loads: {{down: {{on: lid.vertex_2, force: {}}}}}
)",
                          frame.box(9, 0, 1, 1), frame.length, frame.box(0, 0, 1.2, 0.2),
                          frame.point(ground.x(), ground.y()), k * frame.per_length(), frame.of_force(0.0, -side * F)));
      const double tension = side * F * a / arm;
      EXPECT_NEAR(last(solution).bars[0], tension, 1e-9 * F);
      EXPECT_NEAR(last(solution).fields.displacements[1][2], -turn * tension / (k * arm), 1e-9);
      EXPECT_NEAR(last(solution).energy.elastic / frame.length, 0.5 * tension * tension / k, 1e-9 * F * F / k);
    }
}

// Two blocks, of which a bar alone holds the upper one, up and down: all of the force passes through the bar. Then the
// block below is rigid, on springs.
TEST(Bars, HoldABodyThatNothingElseHolds) {
  const double k = 2e7, F = 8e4;
  const auto model = [&](const std::string& lower, const std::string& spring) {
    return fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0}}}}
bodies:
  lower: {{{}shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}}}
  upper: {{material: stuff, shape: {{rectangle: {{corner: [0, 3], size: [1, 1]}}}}, mesh: {{size: 0.5}}}}
supports: [{}{{on: upper.left, fix: x}}]
{}
bars: {{hanger: {{between: [lower.top, upper.bottom], k: {}}}}}
loads: {{up: {{on: upper.top, force: [0, {}]}}}}
)",
                       lower, spring.empty() ? "{on: lower.bottom, fix: [x, y]}, " : "", spring, k, F);
  };
  const auto elastic = run(model("material: stuff, mesh: {size: 0.25}, ", ""));
  EXPECT_NEAR(last(elastic).bars[0], F, 1e-9 * F);
  EXPECT_NEAR(last(elastic).energy.elastic, 0.5 * F * F * (2.0 / 1e9 + 1.0 / k), 1e-9 * F);
  EXPECT_NEAR(last(elastic).energy.external, last(elastic).energy.elastic, 1e-9 * F);
  const auto rigid = run(model("rigid: true, ", "springs: [{on: lower.bottom, k_n: 5e7, k_t: 5e7}]"));
  EXPECT_NEAR(last(rigid).bars[0], F, 1e-9 * F);
  EXPECT_NEAR(last(rigid).energy.elastic, 0.5 * F * F * (1.0 / 1e9 + 1.0 / k + 1.0 / 5e7), 1e-9 * F);
}

// Both ends on one body: of a force on opposite edges the bar between them takes k / (k + E A / L).
TEST(Bars, WithinOneBodyTakeTheirShare) {
  const double k = 3e8, L = 2.0, A = 0.5, F = 1e6, stiffness = 1e9 * A / L;
  const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0}}}}
bodies: {{beam: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {{size: 0.25}}}}}}
supports: [{{on: beam.bottom_left, fix: [x, y]}}, {{on: beam.bottom_right, fix: y}}]
bars: {{tendon: {{between: [beam.left, beam.right], k: {}}}}}
loads: {{left: {{on: beam.left, force: [-{}, 0]}}, right: {{on: beam.right, force: [{}, 0]}}}}
output: {{history: {{tendon: tendon.tension, end: {{edge: beam.right}}}}}}
)",
                                        L, A, k, F, F));
  EXPECT_NEAR(last(solution).bars[0], F * k / (k + stiffness), 1e-9 * F);
  EXPECT_NEAR(last(solution).energy.elastic, 0.5 * F * F / (k + stiffness), 1e-9 * F);
  EXPECT_NEAR(last(solution).edges[0].force.x(), F - last(solution).bars[0], 1e-9 * F);  // of all on the edge
}

// Of a prop that is put in later with the body that it stands on, only what moves from then on counts.
TEST(Bars, OfBodiesThatAreAddedCountFromThere) {
  const auto solution = run(R"(
scabo: 1
materials: {stuff: {young: 1e9, poisson: 0}}
bodies:
  deck: {material: stuff, shape: {rectangle: {corner: [0, 3], size: [1, 1]}}, mesh: {size: 0.5}}
  foot: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, added: prop}
supports: [{on: deck.left, fix: x}, {on: foot, fix: [x, y]}]
springs: [{on: deck.top, k_n: 2e7}]
bars: {prop: {between: [foot.top, deck.bottom], k: 3e7}}
loads: {first: {on: deck.bottom, force: [0, -4e4]}, second: {on: deck.bottom, force: [0, -1e5]}}
steps: [{name: first, loads: {first: 1, second: 0}}, {name: prop}, {name: second, loads: {second: 1}}]
)");
  last(solution);
  EXPECT_EQ(increment_at(solution, 0).bars[0], 0.0);
  EXPECT_NEAR(increment_at(solution, 1).bars[0], 0.0, 1e-6);
  const double above = 1.0 / (1.0 / 2e7 + 1.0 / 1e9);
  EXPECT_NEAR(increment_at(solution, 2).bars[0], -1e5 * 3e7 / (3e7 + above), 1e-4);
}

}  // namespace
}  // namespace scabo::verification
