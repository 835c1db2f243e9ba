// Supports that begin or end in a step: what they hold, what they exert, and what is left where they are taken away.
#include <fmt/format.h>

#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

std::size_t index_of(const analysis::StaticSolution& solution, const std::string& support) {
  for (std::size_t i = 0; i < solution.model.supports.size(); ++i)
    if (solution.model.supports[i].name == support) return i;
  throw std::runtime_error("there is no support " + support);
}

Vec2 reaction(const analysis::StaticSolution& solution, std::size_t increment, const std::string& support) {
  return increment_at(solution, increment).reactions[index_of(solution, support)];
}

Vec2 sum_of_reactions(const analysis::IncrementResult& increment) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& of : increment.reactions) sum += of;
  return sum;
}

/// Displacement of the node of a body next to a point.
Vec2 displacement_at(const analysis::StaticSolution& solution, std::size_t increment, const Vec2& point,
                     std::size_t body = 0) {
  const auto& nodes = solution.mesh.bodies[body].nodes;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if ((nodes[i] - point).norm() < (nodes[nearest] - point).norm()) nearest = i;
  return increment_at(solution, increment)
      .fields.displacements[body]
      .segment<2>(static_cast<Eigen::Index>(2 * nearest));
}

constexpr double E = 2e9, L = 2.0, h = 0.5, F = 3e3;  // of a bar, nu = 0: every stress is uniaxial

std::string bar(const std::string& hold, const std::string& steps, const char* mesh = "{size: 0.5}",
                const char* analysis = "{plane: stress}") {
  return fmt::format(R"(
scabo: 1
analysis: {}
materials: {{stuff: {{young: {}, poisson: 0}}}}
bodies: {{bar: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {}}}}}
supports: [{{on: bar.left, fix: x, name: wall}}, {{on: bar.bottom_left, fix: y}}, {}]
loads: {{pull: {{on: bar.right, traction: [{}, 0]}}}}
steps: [{}]
)",
                     analysis, E, L, h, mesh, hold, F / h, steps);
}

// A pulled bar is held at its end, where that is then: nothing changes. Without the pull it stays as long as it is, by
// the force of the pull, which the support has now. The force falls linearly to zero over the step in which it is taken
// away, and the bar is as short as before. The work of the pull comes back from nothing: the energy is that of the bar.
TEST(StagedSupports, HoldTheirPlaceAndLetGo) {
  const double u = F * L / (E * h), energy = 0.5 * F * u;
  for (const char* mesh : {"{size: 0.5}", "{kind: fem, size: 0.25}", "{kind: polygons, size: 0.3}"}) {
    const auto solution = run(bar("{on: bar.right, fix: x, name: hold, added: hold, removed: go}",
                                  "{name: pull}, {name: hold}, {name: let, increments: 2, loads: {pull: 0}}, "
                                  "{name: go, increments: 4}",
                                  mesh));
    last(solution);
    const double held[] = {0, 0, -0.5, -1, -0.75, -0.5, -0.25, 0}, wall[] = {-1, -1, -1, -1, -0.75, -0.5, -0.25, 0};
    ASSERT_EQ(solution.increments.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
      const double pulled = i < 2 ? 1.0 : i == 2 ? 0.5 : 0.0;
      EXPECT_NEAR(reaction(solution, i, "hold").x(), -held[i] * F, 1e-9 * F) << mesh << " " << i;
      EXPECT_NEAR(reaction(solution, i, "hold").y(), 0.0, 1e-9 * F);
      EXPECT_NEAR(reaction(solution, i, "wall").x(), wall[i] * F, 1e-9 * F) << mesh << " " << i;
      EXPECT_NEAR((sum_of_reactions(increment_at(solution, i)) + Vec2(pulled * F, 0)).norm(), 0.0, 1e-9 * F);
      EXPECT_NEAR(displacement_at(solution, i, Vec2(L, 0.5 * h)).x(), -wall[i] * u, 1e-9 * u);
      const analysis::Energy& of = increment_at(solution, i).energy;
      EXPECT_NEAR(of.elastic, energy * wall[i] * wall[i], 1e-9 * energy);
      EXPECT_NEAR(of.external, of.elastic, 1e-9 * energy);
    }
  }
}

// What a support prescribes counts from where its place was when it came: the pulled bar is drawn on by d, and its wall
// takes E h d / L more. The work of the support is that of its force.
TEST(StagedSupports, MoveFromWhereTheyBegan) {
  const double u = F * L / (E * h), d = 2.5 * u;
  const auto solution = run(bar(fmt::format("{{on: bar.right, displacement: [{}, null], name: draw, added: draw}}", d),
                                "{name: pull, loads: {pull: 1}}, {name: draw, increments: 2, loads: {draw: 1}}, "
                                "{name: back, loads: {draw: -1}}"));
  const double drawn[] = {0, 0.5, 1, -1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(reaction(solution, i, "draw").x(), 2.5 * drawn[i] * F, 1e-9 * F) << i;
    EXPECT_NEAR(reaction(solution, i, "wall").x(), -(1 + 2.5 * drawn[i]) * F, 1e-9 * F) << i;
    EXPECT_NEAR(displacement_at(solution, i, Vec2(L, h)).x(), u + drawn[i] * d, 1e-9 * u);
    const analysis::Energy& of = increment_at(solution, i).energy;
    EXPECT_NEAR(of.external, of.elastic, 1e-9 * F * u);
  }
}

/// A cantilever with a prop under its tip, in other units and mirrored in x. From the left end, or mirrored to it.
struct Frame {
  double length = 1.0, force = 1.0, side = 1.0;
};

constexpr double span = 4.0, depth = 0.2, load = 5e3, lift = 2e-3;

std::string cantilever(const Frame& at, const std::string& supports, const std::string& steps) {
  const double l = at.length, q = load * at.force / l;
  return fmt::format(R"(
scabo: 1
analysis: {{thickness: {0}}}
materials: {{steel: {{young: {1}, poisson: 0.3}}}}
bodies: {{beam: {{material: steel, shape: {{polygon: {{vertices: [{2}], names: {{{3}}}}}}}, mesh: {{kind: fem, size: {4}}}}}}}
supports: [{{on: beam.wall, fix: [x, y], name: wall}}{5}]
loads: {{q: {{on: beam.top, traction: [0, {6}]}}, tip: {{on: beam.{8}, force: [0, {7}]}}}}
steps: [{9}]
)",
                     l, 200e9 * at.force / (l * l),
                     at.side > 0 ? fmt::format("[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]", span * l, depth * l)
                                 : fmt::format("[{0}, 0], [0, 0], [0, {1}], [{0}, {1}]", -span * l, depth * l),
                     at.side > 0 ? "wall: edge_4, top: edge_3" : "wall: edge_2, top: edge_3", 0.1 * l, supports, -q / l,
                     at.force * load, at.side > 0 ? "vertex_2" : "vertex_1", steps);
}

// A propped cantilever loses its prop, and gets another one where its tip is then. By superposition with the
// deflections w of the tip under the load and f under a unit force there, from runs without props: the prop carries R =
// w / f, 3/8 of the load by the theory of slender beams; without it the tip is at -w; the other prop carries nothing
// until the load is doubled, and then R; lifted by d it carries d / f more.
TEST(StagedSupports, AProppedCantileverLosesItsPropAndGetsAnother) {
  for (const Frame& frame : {Frame{}, Frame{1e3, 1e-3, 1.0}, Frame{1.0, 1.0, -1.0}}) {
    const Vec2 tip(frame.side * span * frame.length, 0.0);
    const std::string end = frame.side > 0 ? "vertex_2" : "vertex_1";
    const auto free = run(cantilever(frame, "", "{loads: {q: 1, tip: 0}}, {loads: {q: 0, tip: 1}}"));
    const double unit = load * frame.force, w = -displacement_at(free, 0, tip).y(),
                 f = displacement_at(free, 1, tip).y() / unit;
    EXPECT_NEAR(w / f / (unit * span), 0.375, 0.005);
    const auto solution = run(cantilever(
        frame,
        fmt::format(", {{on: beam.{0}, fix: y, name: prop, removed: strike}}, "
                    "{{on: beam.{0}, displacement: [null, {1}], name: later, added: place}}",
                    end, lift * frame.length),
        "{name: load, loads: {q: 1, tip: 0}}, {name: strike, increments: 2}, {name: place}, "
        "{name: more, loads: {q: 2}}, {name: lift, increments: 2, loads: {later: 1}}, {name: tip, loads: {tip: 1}}"));
    last(solution);
    const double R = w / f, d = lift * frame.length;
    const double prop[] = {R, 0.5 * R, 0, 0, 0, 0, 0, 0},
                 later[] = {0, 0, 0, 0, R, R + 0.5 * d / f, R + d / f, R + d / f - unit},
                 tip_at[] = {0, -0.5 * w, -w, -w, -w, -w + 0.5 * d, -w + d, -w + d},
                 loaded[] = {1, 1, 1, 1, 2, 2, 2, 2};
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(reaction(solution, i, "prop").y(), prop[i], 1e-8 * R) << i;
      EXPECT_NEAR(reaction(solution, i, "later").y(), later[i], 1e-8 * R) << i;
      EXPECT_NEAR(displacement_at(solution, i, tip).y(), tip_at[i], 1e-8 * w) << i;
      const double applied = -loaded[i] * unit * span + (i == 7 ? unit : 0.0);
      EXPECT_NEAR(sum_of_reactions(increment_at(solution, i)).y(), -applied, 1e-8 * R) << i;
      const analysis::Energy& of = increment_at(solution, i).energy;
      EXPECT_NEAR(of.external, of.elastic, 1e-8 * R * w) << i;
    }
  }
}

// A rigid lid on two springs k at its corners, 2 a apart, is held as a whole, loaded beside its middle and let go: it
// goes down by F / (2 k) and turns by -F e / (2 k a^2). Then its rotation alone is driven back to zero, by a couple F
// e.
TEST(StagedSupports, HoldRigidBodiesWithTheirRotation) {
  const double k = 4e6, a = 1.5, e = 0.5, down = F / (2 * k), turned = -F * e / (2 * k * a * a);
  const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
  aside: {{material: stuff, shape: {{rectangle: {{corner: [9, 0], size: [1, 1]}}}}, mesh: {{size: 1}}}}
  lid: {{rigid: true, shape: {{polygon: {{vertices: [[-1.5, 0], [1.5, 0], [1.5, 1], [0.5, 1], [-1.5, 1]]}}}}}}
supports:
  - {{on: aside, fix: [x, y]}}
  - {{on: lid, fix: [x, y], name: held, removed: go}}
  - {{on: lid, rotation: {}, name: turn, added: turn}}
springs: [{{on: lid.vertex_1, k_x: {k}, k_y: {k}}}, {{on: lid.vertex_2, k_x: {k}, k_y: {k}}}]
loads: {{down: {{on: lid.vertex_4, force: [0, {}]}}}}
steps: [{{name: load, loads: {{down: 1}}}}, {{name: go, increments: 2}}, {{name: turn, increments: 2, loads: {{turn: 1}}}}]
)",
                                        -turned, -F, fmt::arg("k", k)));
  last(solution);
  const double held[] = {1, 0.5, 0, 0, 0}, rotation[] = {0, 0.5, 1, 0.5, 0}, couple[] = {0, 0, 0, 0.5, 1};
  for (std::size_t i = 0; i < 5; ++i) {
    const analysis::IncrementResult& increment = increment_at(solution, i);
    EXPECT_NEAR(reaction(solution, i, "held").y(), held[i] * F, 1e-9 * F) << i;
    EXPECT_NEAR(increment.fields.displacements[1][2], rotation[i] * turned, 1e-9 * std::abs(turned)) << i;
    EXPECT_NEAR(increment.moments[index_of(solution, "turn")].value_or(0.0), couple[i] * F * e, 1e-9 * F) << i;
    EXPECT_NEAR(increment.energy.external, increment.energy.elastic, 1e-9 * F * down) << i;
  }
  EXPECT_NEAR(increment_at(solution, 2).springs[0].y() + increment_at(solution, 2).springs[1].y(), F, 1e-9 * F);
}

// Two supports that share a corner and end one after the other, of an elastic body and of a rigid one whose edges hold
// it more often than needed: the sum of the reactions is the load, and what is left at the end is nothing.
TEST(StagedSupports, ShareACornerAndEndOneAfterTheOther) {
  for (const char* kind : {"material: stuff, mesh: {size: 0.5}", "rigid: true"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
  aside: {{material: stuff, shape: {{rectangle: {{corner: [9, 0], size: [1, 1]}}}}, mesh: {{size: 1}}}}
  plate: {{{}, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}}}
supports:
  - {{on: aside, fix: [x, y]}}
  - {{on: plate.left, fix: [x, y], name: left, removed: two}}
  - {{on: plate.bottom, fix: [x, y], name: bottom, removed: three}}
springs: [{{on: plate.bottom, k_n: 1e9, k_t: 1e9}}]
loads: {{push: {{on: plate.right, traction: [-3e3, -2e3]}}}}
steps: [{{name: one}}, {{name: two}}, {{name: three, increments: 2}}]
)",
                                          kind));
    last(solution);
    const Vec2 all(3e3, 2e3);
    for (std::size_t i = 0; i < 4; ++i) {
      Vec2 carried = reaction(solution, i, "left") + reaction(solution, i, "bottom");
      for (const Vec2& spring : increment_at(solution, i).springs) carried += spring;
      EXPECT_NEAR((carried - all).norm(), 0.0, 1e-9 * all.norm()) << kind << i;
    }
    EXPECT_NEAR(reaction(solution, 1, "left").norm(), 0.0, 1e-9 * all.norm());
    EXPECT_NEAR(reaction(solution, 3, "bottom").norm(), 0.0, 1e-9 * all.norm());
    EXPECT_NEAR((increment_at(solution, 3).springs[0] - all).norm(), 0.0, 1e-9 * all.norm());
  }
}

// A rigid lid slides up and down along a guide that lasts. Another support holds it as a whole, of which the guide
// leaves only the vertical force, and goes; then it stands on the plate below.
TEST(StagedSupports, LeaveToOthersWhatThoseHold) {
  const auto solution = run(R"(
scabo: 1
materials: {stuff: {young: 2e9, poisson: 0.2}}
bodies:
  plate: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.25}}
  lid: {rigid: true, shape: {rectangle: {corner: [0, 1], size: [2, 0.5]}}}
supports:
  - {on: plate.bottom, fix: [x, y], name: ground}
  - {on: lid.left, fix: x, name: guide}
  - {on: lid, fix: [x, y], name: whole, removed: two}
  - {on: lid.top, fix: [x, y], name: again, added: three}
contacts: {seat: {between: [plate.top, lid.bottom], friction: 0.3}}
loads: {q: {on: lid.top_right, force: [1e3, -2e4]}}
steps: [{name: one}, {name: two, increments: 2}, {name: three, loads: {q: 2}}]
)");
  last(solution);
  const double whole[] = {2e4, 1e4, 0, 0}, again[] = {0, 0, 0, 2e4};
  for (std::size_t i = 0; i < 4; ++i) {
    const double q = i == 3 ? 2.0 : 1.0;
    EXPECT_NEAR((reaction(solution, i, "whole") - Vec2(0, whole[i])).norm(), 0.0, 1e-8 * 2e4) << i;
    EXPECT_NEAR((reaction(solution, i, "again") - Vec2(0, again[i])).norm(), 0.0, 1e-8 * 2e4) << i;
    EXPECT_NEAR(reaction(solution, i, "guide").x(), -1e3 * q, 1e-8 * 2e4) << i;
    EXPECT_NEAR(sum_of_reactions(increment_at(solution, i)).y(), 2e4 * q, 1e-8 * 2e4) << i;
  }
}

// A block on a rigid floor is held against a push P beside friction mu N. Let go, the joint carries P where mu N is
// more, and else the block begins to slide, on the way, at what the friction carries.
TEST(StagedSupports, LetGoWhatFrictionCarriesOrNot) {
  const auto model = [](double mu) {
    return fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2, density: 1000}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [3, 1]}}}}}}
  block: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {{size: 0.25}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.bottom_left, fix: x, name: stop, removed: go}}]
loads: {{weight: {{gravity: [0, -10]}}, push: {{on: block.bottom_right, force: [4e3, 0]}}}}
contacts: {{joint: {{between: [floor.top, block.bottom], friction: {}}}}}
steps: [{{name: weight, loads: {{weight: 1}}}}, {{name: push, loads: {{push: 1}}}}, {{name: go, increments: 10}}]
)",
                       mu);
  };
  const auto stays = run(model(0.5));
  EXPECT_NEAR(std::abs(contact_of(last(stays)).tangential_force), 4e3, 1e-6);
  EXPECT_NEAR(last(stays).reactions[1].norm(), 0.0, 1e-6);
  const auto slides = run(model(0.3));
  EXPECT_NE(slides.outcome, analysis::Outcome::solved);
  EXPECT_NE(slides.reason.find("block"), std::string::npos) << slides.reason;
}

// A body that only this support held is told as a mechanism, by its name.
TEST(StagedSupports, WhatOneAloneHeldIsAMechanismWithoutIt) {
  const auto solution = run(R"(
scabo: 1
materials: {stuff: {young: 1e9, poisson: 0.2}}
bodies: {plate: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.5}}}
supports: [{on: plate.left, fix: [x, y], removed: go}]
loads: {push: {on: plate.right, traction: [3e3, 0]}}
steps: [{name: load}, {name: go}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(solution.reason.find("plate"), std::string::npos) << solution.reason;
}

// Of a body of revolution: a tube that is pulled along its axis, held, let go.
TEST(StagedSupports, OfABodyOfRevolution) {
  const double area = M_PI * (L * L + 2 * L), force = 1e3 * area;  // of radii 1 and 1 + L
  const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: axisymmetric}}
materials: {{stuff: {{young: {}, poisson: 0}}}}
bodies: {{tube: {{material: stuff, shape: {{rectangle: {{corner: [1, 0], size: [{}, {}]}}}}, mesh: {{kind: fem, size: 0.5}}}}}}
supports: [{{on: tube.bottom, fix: y, name: ground}}, {{on: tube.top, fix: y, name: hold, added: hold, removed: go}}]
loads: {{pull: {{on: tube.top, traction: [0, 1e3]}}}}
steps: [{{name: pull}}, {{name: hold, loads: {{pull: 0}}}}, {{name: go, increments: 2}}]
)",
                                        E, L, h));
  last(solution);
  const double held[] = {0, 1, 0.5, 0}, ground[] = {-1, -1, -0.5, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(reaction(solution, i, "hold").y(), held[i] * force, 1e-9 * force) << i;
    EXPECT_NEAR(reaction(solution, i, "ground").y(), ground[i] * force, 1e-9 * force) << i;
  }
}

// The resultants of a section and of the edge of a support that ends are those of its reaction, also on the way.
TEST(StagedSupports, TheirForcesThroughTheirEdge) {
  const std::string history = "output: {history: {through: {edge: bar.right}}}\n";
  const auto solution = run(bar("{on: bar.right, fix: x, name: hold, added: hold, removed: go}",
                                "{name: pull}, {name: hold, loads: {pull: 0}}, {name: go, increments: 2}") +
                            history);
  last(solution);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_NEAR(std::abs(increment_at(solution, i).edges.front().force.x()),
                std::abs(reaction(solution, i, "hold").x()), 1e-8 * F);
}

}  // namespace
}  // namespace scabo::verification
