// Supports and springs on the side faces of one super-element: half and quarter models against
// whole ones, foundations against finite elements, Betti's theorem, global equilibrium, rings against the undivided
// super-element, twins in other units and turned, contact elsewhere.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

/// Coordinates times `length`, turned about the origin.
struct Placed {
  double angle = 0.0, length = 1.0;
  Vec2 direction(const Vec2& v) const {
    return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
  }
  std::string of(const Vec2& v) const {
    const Vec2 d = direction(v);
    return fmt::format("[{:.17g}, {:.17g}]", d.x(), d.y());
  }
  std::string operator()(double x, double y) const { return of(length * Vec2(x, y)); }
};

/// Displacement of the node of a body that is nearest to a point.
Vec2 displacement_at(const analysis::StaticSolution& solution, const Vec2& x, std::size_t body = 0) {
  const std::vector<Vec2>& nodes = solution.mesh.bodies[body].nodes;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if ((nodes[i] - x).norm() < (nodes[nearest] - x).norm()) nearest = i;
  return last(solution).fields.displacements[body].segment<2>(static_cast<Eigen::Index>(2 * nearest));
}

/// Sum of all reactions.
Vec2 total_reaction(const analysis::IncrementResult& increment) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& reaction : increment.reactions) sum += reaction;
  return sum;
}

/// Edge crack of length 1 in a plate of 2 x 4 under tension 1e6: the upper half, from y = 0, with the tip at (1, 0).
std::string half_of_a_cracked_plate(const Placed& at, const std::string& supports,
                                    const std::string& mesh = "order: 8") {
  return fmt::format(R"(scabo: 1
analysis: {{plane: strain, thickness: 0.5}}
materials: {{m: {{young: 2e9, poisson: 0.3}}}}
bodies:
  half:
    material: m
    shape: {{polygon: {{vertices: [{}, {}, {}, {}, {}], names: {{crack: edge_1, ligament: edge_2, right: edge_3, top: edge_4}}}}}}
    mesh: {{size: {}, {}, centre: {}}}
supports:
  - {}
  - {{on: half.vertex_4, fix: {{along: {}}}}}
loads: {{pull: {{on: half.top, traction: {}}}}}
)",
                     at(0, 0), at(1, 0), at(2, 0), at(2, 2), at(0, 2), 0.5 * at.length, mesh, at(1, 0), supports,
                     at.of(Vec2(1, 0)), at.of(Vec2(0, 1e6)));
}
std::string whole_cracked_plate() {
  return R"(scabo: 1
analysis: {plane: strain, thickness: 0.5}
materials: {m: {young: 2e9, poisson: 0.3}}
bodies:
  plate:
    material: m
    shape: {polygon: {vertices: [[0, -2], [2, -2], [2, 0], [2, 2], [0, 2], [0, 0]], names: {bottom: edge_1, top: edge_4}}}
    mesh: {size: 0.5, order: 8}
    cracks: [{tip: [1, 0], mouth: vertex_6, name: slit}]
supports: [{on: plate.vertex_2, fix: x}, {on: plate.vertex_4, fix: x}, {on: plate.vertex_3, fix: y}]
loads: {up: {on: plate.top, traction: [0, 1e6]}, down: {on: plate.bottom, traction: [0, -1e6]}}
)";
}

// K_I = 2.82546 sigma sqrt(pi a) (a / W = 1 / 2, h / W = 1), and everything as in the whole plate; in other units,
// turned, and in other words.
TEST(SideFaces, HalfOfACrackedPlateIsTheWholeOne) {
  const auto whole = run(whole_cracked_plate());
  const analysis::IncrementResult& of_whole = last(whole);
  const double K_I = of_whole.cracks.at(0).factors.K_I, energy = 0.5 * of_whole.energy.elastic;
  EXPECT_NEAR(K_I, 2.82546 * 1e6 * std::sqrt(pi), 1e-5 * K_I);
  const Vec2 mouth = displacement_at(whole, {0, 2});
  for (const Placed& at : {Placed{}, Placed{0.0, 1e-3}, Placed{0.0, 1e3}, Placed{0.5, 1.0}, Placed{-2.0, 1e3}}) {
    const bool turned = at.angle != 0.0;
    const auto half =
        run(half_of_a_cracked_plate(at, turned ? "{on: half.ligament, fix: normal}" : "{on: half.ligament, fix: y}"));
    const analysis::IncrementResult& of_half = last(half);
    ASSERT_EQ(of_half.cracks.size(), 1u);
    const element::StressIntensity& factors = of_half.cracks[0].factors;
    EXPECT_NEAR(factors.K_I / std::sqrt(at.length), K_I, 2e-6 * K_I) << at.angle << " " << at.length;
    EXPECT_LT(std::abs(factors.K_II), 1e-9 * factors.K_I);
    EXPECT_NEAR(*factors.G / at.length, *of_whole.cracks[0].factors.G, 5e-6 * *of_whole.cracks[0].factors.G);
    EXPECT_NEAR(of_half.energy.elastic / (at.length * at.length), energy, 1e-7 * energy);
    const Vec2 u = displacement_at(half, at.direction(at.length * Vec2(0, 2)));
    EXPECT_LT((u / at.length - at.direction(mouth)).norm(), 1e-5 * mouth.norm());  // a point has no order 2p
    EXPECT_LT((of_half.reactions[0] / at.length - at.direction(Vec2(0, -1e6))).norm(), 1e-8 * 1e6);
    EXPECT_TRUE(half.warnings.empty());
  }
  const auto near = run(half_of_a_cracked_plate({}, "{on: half.ligament, displacement: {normal: 0}}", "order: 4"));
  EXPECT_NEAR(last(near).cracks.at(0).factors.K_I, K_I, 1e-3 * K_I);
}

// Pressure on the face of the half is pressure on both faces of the whole: the image of the load opens the crack too.
TEST(SideFaces, PressureInHalfOfACrackIsThatInTheWholeOne) {
  const auto whole = run(whole_cracked_plate(), {"loads.left={on: plate.slit.left, pressure: 1e6}",
                                                 "loads.right={on: plate.slit.right, pressure: 1e6}"});
  const auto half =
      run(half_of_a_cracked_plate({}, "{on: half.ligament, fix: y}"), {"loads.press={on: half.crack, pressure: 1e6}"});
  ASSERT_EQ(last(whole).cracks.size(), 1u);
  ASSERT_EQ(last(half).cracks.size(), 1u);
  const element::StressIntensity &of_whole = last(whole).cracks[0].factors, &of_half = last(half).cracks[0].factors;
  EXPECT_GT(of_whole.K_I, 1.5 * 2.82546 * 1e6 * std::sqrt(pi));  // the pull alone has this
  EXPECT_NEAR(of_half.K_I, of_whole.K_I, 1e-5 * of_whole.K_I);
  EXPECT_LT(std::abs(of_half.K_II), 1e-8 * of_half.K_I);
  EXPECT_LT((displacement_at(half, {0, 2}) - displacement_at(whole, {0, 2})).norm(),
            1e-5 * displacement_at(whole, {0, 2}).norm());
}

// The image of a material has its axes on the other side: half of a cracked plate whose upper half is of fibres at 30
// degrees and whose lower half at -30 degrees, which is a crack between two materials.
TEST(SideFaces, HalfOfACrackedPlateIsThatOfMirroredFibres) {
  const auto fibres = [](const char* name, int angle) {
    return fmt::format("{}: {{orthotropic: {{E1: 9e9, E2: 2e9, nu12: 0.3, G12: 1.5e9, angle: {}}}}}", name, angle);
  };
  const auto whole = run(fmt::format(R"(scabo: 1
materials: {{{}, {}}}
bodies:
  plate:
    material: below
    shape: {{polygon: {{vertices: [[0, -2], [2, -2], [2, 0], [2, 2], [0, 2], [0, 0]], names: {{bottom: edge_1, top: edge_4}}}}}}
    mesh: {{size: 0.5, order: 8}}
    cracks: [{{tip: [1, 0], mouth: vertex_6, name: slit}}]
    sectors: {{edge_3: above, top: above, edge_5: above}}
supports: [{{on: plate.vertex_2, fix: x}}, {{on: plate.vertex_4, fix: x}}, {{on: plate.vertex_3, fix: y}}]
loads: {{up: {{on: plate.top, traction: [0, 1e6]}}, down: {{on: plate.bottom, traction: [0, -1e6]}}}}
)",
                                     fibres("above", 30), fibres("below", -30)));
  const auto half = run(fmt::format(R"(scabo: 1
materials: {{{}}}
bodies:
  half:
    material: above
    shape: {{polygon: {{vertices: [[0, 0], [1, 0], [2, 0], [2, 2], [0, 2]], names: {{ligament: edge_2, top: edge_4}}}}}}
    mesh: {{size: 0.5, order: 8, centre: [1, 0]}}
supports: [{{on: half.ligament, fix: y}}, {{on: half.vertex_4, fix: x}}]
loads: {{pull: {{on: half.top, traction: [0, 1e6]}}}}
)",
                                    fibres("above", 30)));
  const double energy = last(whole).energy.elastic;
  EXPECT_NEAR(2.0 * last(half).energy.elastic, energy, 1e-6 * energy);
  ASSERT_EQ(last(whole).cracks.size(), 1u);
  ASSERT_EQ(last(half).cracks.size(), 1u);
  const element::StressIntensity &of_whole = last(whole).cracks[0].factors, &of_half = last(half).cracks[0].factors;
  EXPECT_NEAR(of_half.K_I, of_whole.K_I, 1e-5 * of_whole.K_I);
  EXPECT_NEAR(of_half.K_II, of_whole.K_II, 1e-5 * of_whole.K_I);
  EXPECT_NEAR(*of_half.G, *of_whole.G, 1e-5 * *of_whole.G);
}

// A quarter of a plate whose scaling centre is where both lines of symmetry meet, under a pressure that varies.
TEST(SideFaces, QuarterOfAPlateIsTheWholeOne) {
  const char* table = "pressure: {over: x, at: [-2, 0, 2], values: [0, 1e6, 0]}";
  const auto whole = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 2e9, poisson: 0.3}}}}
bodies:
  plate: {{material: m, shape: {{polygon: {{vertices: [[-2, -1], [0, -1], [2, -1], [2, 0], [2, 1], [0, 1], [-2, 1], [-2, 0]]}}}}, mesh: {{size: 1, order: 10}}}}
supports: [{{on: plate.vertex_2, fix: x}}, {{on: plate.vertex_6, fix: x}}, {{on: plate.vertex_4, fix: y}}]
loads:
  a: {{on: plate.edge_1, {0}}}
  b: {{on: plate.edge_2, {0}}}
  c: {{on: plate.edge_5, {0}}}
  d: {{on: plate.edge_6, {0}}}
)",
                                     table));
  const auto quarter = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 2e9, poisson: 0.3}}}}
bodies:
  part: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 1, order: 10, centre: [0, 0]}}}}
supports: [{{symmetry: {{x: 0}}}}, {{symmetry: {{y: 0}}}}]
loads: {{press: {{on: part.top, {}}}}}
)",
                                       table));
  const double energy = last(whole).energy.elastic;
  EXPECT_NEAR(4.0 * last(quarter).energy.elastic, energy, 1e-7 * energy);
  const Vec2 corner = displacement_at(whole, {2, 1});
  EXPECT_LT((displacement_at(quarter, {2, 1}) - corner).norm(), 1e-5 * corner.norm());
  EXPECT_NEAR(last(quarter).reactions[1].y(), 1e6, 1e-2);  // the pressure on the top
  EXPECT_NEAR(last(quarter).reactions[1].x(), 0.0, 1e-2);
}

// A triangle with rollers on both faces that meet in its scaling centre, at any angle and turned: pressed on its third
// edge it has the stress -p in all directions, u = -p (1 - nu) / E x.
TEST(SideFaces, BothOnRollersLeaveAUniformPressureUniform) {
  const double p = 3e6, E = 2e9, nu = 0.3;
  for (const double degrees : {60.0, 90.0, 130.0})
    for (const double turn : {0.0, 0.4, -2.0}) {
      const double end = turn + degrees * pi / 180.0;
      const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: {}, poisson: {}}}}}
bodies:
  part: {{material: m, shape: {{polygon: {{vertices: [[0, 0], [{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]}}}}, mesh: {{size: 0.5, order: 3, centre: [0, 0]}}}}
supports: [{{on: part.edge_1, fix: normal}}, {{on: part.edge_3, fix: normal}}]
loads: {{press: {{on: part.edge_2, pressure: {}}}}}
)",
                                            E, nu, std::cos(turn), std::sin(turn), std::cos(end), std::sin(end), p));
      const Vector& u = last(solution).fields.displacements[0];
      const std::vector<Vec2>& nodes = solution.mesh.bodies[0].nodes;
      const double shortening = p * (1.0 - nu) / E;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        EXPECT_LT((u.segment<2>(static_cast<Eigen::Index>(2 * i)) + shortening * nodes[i]).norm(), 1e-9 * shortening)
            << degrees << " " << turn;
      const double area = 0.5 * std::sin(end - turn);
      EXPECT_NEAR(last(solution).energy.elastic, p * shortening * area, 1e-9 * p * shortening);
    }
}

/// A block of 2 x 1 with its scaling centre at the lower left corner.
std::string block(const Placed& at, const std::string& conditions, const std::string& mesh, bool centre = true) {
  return fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.25}}}}
bodies:
  block:
    material: m
    shape: {{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: edge_4}}}}}}
    mesh: {{{}{}}}
{}
loads:
  push: {{on: block.right, traction: {}}}
  press: {{on: block.top, pressure: 2e6}}
)",
                     at(0, 0), at(2, 0), at(2, 1), at(0, 1), mesh, centre ? ", centre: " + at(0, 0) : "", conditions,
                     at.of(Vec2(-1e6, 0)));
}

// An elastic foundation below and a fixed wall beside: against finite elements of a sixteenth, which are compliant to
// 2e-4. The forces are in equilibrium with the loads to rounding.
TEST(SideFaces, FoundationAsInFiniteElements) {
  const std::string springs =
      "supports: [{on: block.top, fix: tangent}]\nsprings: [{on: block.bottom, k_n: 3e8, k_t: 1e8, name: bed}]";
  const auto fem = run(block({}, springs, "kind: fem, size: 0.0625", false));
  for (const Placed& at : {Placed{}, Placed{0.7, 1.0}, Placed{0.0, 1e3}}) {
    std::string scaled = springs;
    if (at.length != 1.0)
      scaled =
          "supports: [{on: block.top, fix: tangent}]\nsprings: [{on: block.bottom, k_n: 3e5, k_t: 1e5, name: bed}]";
    const auto one = run(block(at, scaled, fmt::format("size: {}, order: 6", 0.5 * at.length)));
    const Vec2 bed = last(fem).springs[0], corner = displacement_at(fem, {2, 1});
    EXPECT_LT((last(one).springs[0] / at.length - at.direction(bed)).norm(), 2e-4 * bed.norm());
    const Vec2 u = displacement_at(one, at.direction(at.length * Vec2(2, 1))) / at.length;
    EXPECT_LT((u - at.direction(corner)).norm(), 1e-3 * corner.norm());
    EXPECT_NEAR(last(one).energy.elastic / (at.length * at.length), last(fem).energy.elastic,
                1e-3 * last(fem).energy.elastic);
    const Vec2 sum = (last(one).springs[0] + total_reaction(last(one))) / at.length + at.direction(Vec2(-1e6, -4e6));
    EXPECT_LT(sum.norm(), 1e-8 * 4e6);
  }
}

// A fixed face, the other one free: the same block with its scaling centre inside and graded elements on the edge. Both
// have the singularity 0.71 at the lower left corner, which only the side face represents.
TEST(SideFaces, FixedFaceIsAFixedEdge) {
  const std::string fixed =
      "supports: [{on: block.bottom, fix: [x, y]}]\noutput: {history: {wall: {edge: block.bottom, about: [0, 0]}}}";
  const auto edge = run(block(
      {}, fixed,
      "size: 0.5, order: 6, refine: [{near: [0, 0], size: 1e-4, growth: 0.5}, {near: [2, 0], size: 1e-4, growth: 0.5}]",
      false));
  const auto face = run(block({}, fixed, "size: 0.5, order: 6, refine: [{near: [2, 0], size: 1e-4, growth: 0.5}]"));
  const double energy = last(edge).energy.elastic;
  EXPECT_NEAR(last(face).energy.elastic, energy, 1e-5 * energy);
  const Vec2 corner = displacement_at(edge, {2, 1});
  EXPECT_LT((displacement_at(face, {2, 1}) - corner).norm(), 1e-4 * corner.norm());
  EXPECT_LT((last(face).reactions[0] - Vec2(1e6, 4e6)).norm(), 1e-8 * 4e6);
  // Moments of the loads about the origin: push on the right edge, pressure on the top.
  for (const auto* solution : {&edge, &face}) {
    ASSERT_EQ(last(*solution).edges.size(), 1u);
    EXPECT_LT((last(*solution).edges[0].force - last(*solution).reactions[0]).norm(), 1e-8 * 4e6);
    EXPECT_NEAR(last(*solution).edges[0].moment, -(0.5 * 1e6 - 1.0 * 4e6), 1e-7 * 4e6);
  }
  ASSERT_EQ(last(face).cracks.size(), 1u);
  EXPECT_TRUE(last(face).cracks[0].held);
}

// Rollers on an inclined face of a triangle that slides up it: with a prescribed normal displacement and a tangent that
// is free, a rigid motion without any stress; and the reaction of the weight on an inclined plane.
TEST(SideFaces, RollersOnAnInclinedFace) {
  const std::string body = R"(scabo: 1
materials: {m: {young: 1e9, poisson: 0.25, density: 2000}}
bodies:
  ramp: {material: m, shape: {polygon: {vertices: [[0, 0], [4, 3], [0, 3]]}}, mesh: {size: 0.7, order: 5, centre: [0, 0]}}
supports:
  - {on: ramp.edge_1, displacement: {normal: 1e-3}}
  - {on: ramp.vertex_3, fix: {along: [4, 3]}}
)";
  const auto moved = run(body);
  const Vec2 n(0.6, -0.8);
  for (const Vec2& x : {Vec2(4, 3), Vec2(0, 3)}) EXPECT_LT((displacement_at(moved, x) - 1e-3 * n).norm(), 1e-12);
  EXPECT_LT(std::abs(last(moved).energy.elastic), 1e-9);
  const auto weight = run(body + "loads: {weight: {gravity: [0, -9.81]}}\n");
  const double W = 2000 * 9.81 * 6.0;
  EXPECT_LT((last(weight).reactions[0] + n * (n.dot(Vec2(0, W)) < 0 ? 1.0 : -1.0) * 0.8 * W).norm(), 1e-8 * W);
  EXPECT_LT((total_reaction(last(weight)) - Vec2(0, W)).norm(), 1e-8 * W);
}

// Betti's theorem, as between cells (face_supports_test.cpp): faces that move by c_1 (below) and c_2 (above).
TEST(SideFaces, OfACrackThatIsWedgedOpen) {
  const double E = 2e9, t = 0.3, below = 0.0, above = 2e-4;
  const auto solution = run(R"(scabo: 1
analysis: {thickness: 0.3}
materials: {m: {young: 2e9, poisson: 0.25}}
bodies:
  plate:
    material: m
    shape: {rectangle: {corner: [0, 0], size: [4, 4]}}
    mesh: {size: 1, order: 4}
    cracks: [{name: slit, tip: [2, 2], mouth: [0, 2]}]
supports:
  - {on: plate.bottom, fix: normal}
  - {on: plate.bottom_left, fix: x}
  - {on: plate.top, fix: normal}
  - {on: plate.slit.left, displacement: {normal: -2e-4}}
  - {on: plate.slit.right, displacement: {normal: 0}}
)");
  const analysis::IncrementResult& increment = last(solution);
  const double upper = increment.reactions[3].y(), lower = increment.reactions[4].y(), top = increment.reactions[2].y();
  const double size = std::abs(upper) + std::abs(lower);
  EXPECT_NEAR(upper + lower + 2.0 * top, E * t * (below - above), 1e-6 * size);
  EXPECT_NEAR(total_reaction(increment).y(), 0.0, 1e-9 * size);
  EXPECT_GT(upper, 0.0);
  EXPECT_TRUE(increment.cracks.at(0).held);
}

// Rings change nothing: with springs of no account on a face, loads inside and on the faces, the factors, displacements
// and reactions of the undivided super-element. Also two materials, an arc, and a body far finer than its rings.
TEST(SideFaces, RingsChangeNothing) {
  const auto cracked = [](const std::string& mesh, const std::string& springs) {
    return run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 2e9, poisson: 0.25, density: 3000, expansion: 1e-5}}, s: {{young: 2.2e9, poisson: 0.25, density: 1000, expansion: 1.1e-5}}}}
bodies:
  plate:
    material: m
    shape:
      outline:
        - {{line: {{from: [0, 0], to: [3, 0]}}, name: bottom}}
        - {{line: {{from: [3, 0], to: [3, 1.5]}}, name: right}}
        - {{arc: {{to: [0, 1.5], centre: [1.5, 0.5]}}, name: top}}
        - {{line: {{from: [0, 1.5], to: [0, 0]}}, name: left}}
    mesh: {{{}}}
    cracks: [{{name: slit, tip: [1.5, 1], mouth: [0, 1]}}]
    sectors: {{right: s}}
supports: [{{on: plate.bottom, fix: y}}, {{on: plate.vertex_1, fix: x}}]
{}
loads:
  weight: {{gravity: [0, -9.81]}}
  warm: {{temperature: {{constant: 3, x: 1, y: 0.5}}}}
  water: {{on: plate.slit.left, pressure: {{powers: {{0: 1e5, 1: -4e4, 2.5: 3e4}}}}}}
  drag: {{on: plate.slit.right, traction: {{points: [[0, 0, -2e4], [0.5, 0, 1e4], [1, 0, -1e5]]}}}}
)",
                           mesh, springs));
  };
  for (const char* mesh : {"size: 0.5, order: 6", "size: 0.05, order: 2"}) {
    const auto plain = cracked(mesh, ""), rings = cracked(mesh, "springs: [{on: plate.slit.left, k_n: 1e-3}]");
    const element::StressIntensity &a = last(plain).cracks.at(0).factors, &b = last(rings).cracks.at(0).factors;
    EXPECT_GT(rings.mesh.bodies[0].cells.size(), 50u);
    EXPECT_EQ(plain.mesh.bodies[0].cells.size(), 1u);
    const double size = std::hypot(a.K_I, a.K_II);
    const double tolerance = std::string(mesh).find("order: 6") != std::string::npos ? 1e-5 : 1e-4;
    EXPECT_NEAR(a.K_I, b.K_I, tolerance * size) << mesh;
    EXPECT_NEAR(a.K_II, b.K_II, tolerance * size) << mesh;
    EXPECT_NEAR(a.reference_length, b.reference_length, 1e-7);
    for (const Vec2& x : {Vec2(3, 1.5), Vec2(0, 1.5), Vec2(3, 0)}) {
      const Vec2 u = displacement_at(plain, x);
      EXPECT_LT((displacement_at(rings, x) - u).norm(), 1e-4 * u.norm()) << mesh;
    }
    EXPECT_LT((last(plain).reactions[0] - last(rings).reactions[0]).norm(), 1e-6 * last(plain).reactions[0].norm());
  }
}

// With contact on another edge and several increments: as with the same face given as an edge.
TEST(SideFaces, WithContactOnAnotherEdge) {
  const auto with = [](const std::string& mesh, const std::string& name) {
    return run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.25}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}}}}}
  lid: {{rigid: true, shape: {{rectangle: {{corner: [0.5, 1], size: [1, 0.5]}}}}}}
supports:
  - {{on: block.bottom, fix: [x, y]}}
  - {{on: lid, displacement: [5e-4, -1e-3], rotation: 0, name: push}}
contacts: {{c: {{between: [block.top, lid.bottom], friction: 0.2}}}}
steps: [{{name: {}, increments: 3}}]
)",
                           mesh, name));
  };
  const auto edge = with("size: 0.125, order: 4", "as_edge"),
             face = with("size: 0.125, order: 4, centre: [0, 0]", "as_face");
  ASSERT_EQ(face.increments.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const analysis::ContactResult &a = contact_of(increment_at(edge, i)), &b = contact_of(increment_at(face, i));
    EXPECT_NEAR(a.normal_force, b.normal_force, 1e-3 * a.normal_force);
    EXPECT_NEAR(a.tangential_force, b.tangential_force, 1e-3 * a.normal_force);
    EXPECT_LT((increment_at(face, i).reactions[0] + Vec2(increment_at(face, i).reactions[1])).norm(),
              1e-8 * a.normal_force);
  }
}

// A stop on a track, pushed against an elastic pad on its side face, which is one of the two that meet at the scaling
// centre (1, 1): pad = push - mu N as it goes forward; friction, more than the pad has, then keeps it there. Only
// contact holds the body across the pad, so that elements at the centre, whose normals rounding turns by 1e-9, must not
// make that motion seem to compress the pad.
TEST(SideFaces, OfABodyThatSlidesAgainstAPad) {
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain, thickness: 0.5}}
materials: {{m: {{young: 210e9, poisson: 0.3}}}}
bodies:
  track: {{rigid: true, shape: {{rectangle: {{corner: [-1, -0.5], size: [5, 0.5]}}}}}}
  stop:
    material: m
    shape:
      polygon: {{vertices: [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]], names: {{foot: edge_1, face: edge_4, head: edge_5, back: edge_6}}}}
    mesh: {{size: 0.5, order: 2, centre: [1, 1]}}
supports: [{{on: track, fix: [x, y]}}]
springs: [{{name: pad, on: stop.face, k_n: {}}}]
contacts: {{c: {{between: [track.top, stop.foot], friction: {{forward: 0.1, backward: 0.6}}}}}}
loads: {{weight: {{on: stop.head, pressure: 200e3}}, jack: {{on: stop.back, force: [25e3, 0]}}}}
steps: [{{name: push, increments: 2}}, {{name: let_go, loads: {{jack: 0}}}}]
)",
                                          stiffness));
    ASSERT_EQ(solution.increments.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const analysis::IncrementResult& increment = increment_at(solution, i);
      EXPECT_LT(increment.certificate.equilibrium, 1e-12) << stiffness;
      const double normal = i == 0 ? 50e3 : 100e3;
      EXPECT_NEAR(contact_of(increment).normal_force, normal, 1e-9 * normal);
      const double rebound = i == 2 ? 10e-6 * stiffness : 0.0;  // of the stop itself
      EXPECT_NEAR(increment.springs[0].x(), i == 0 ? -7.5e3 : -15e3, 1e-4 + rebound) << stiffness;
      EXPECT_NEAR(increment.springs[0].y(), 0.0, 1e-4);
    }
  }
}

}  // namespace
}  // namespace scabo::verification
