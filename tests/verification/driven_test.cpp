// Moments on edges and rigid bodies; rigid bodies that are driven by the displacement of a point and a rotation.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

// Pure bending is exact: u_y = M x^2 / (2 E I) on the axis of a beam on rollers at its left end.
TEST(Moments, OnTheEndOfACantileverBendItExactly) {
  const double E = 30e9, h = 0.5, t = 0.2, L = 4.0, M = 25e3, I = t * h * h * h / 12.0;
  for (const double sign : {1.0, -1.0})
    for (const char* mesh : {"size: 0.5, order: 2", "kind: fem, size: 0.5", "kind: polygons, size: 0.3, order: 3"}) {
      const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stuff: {{young: {}, poisson: 0.3}}}}
bodies: {{beam: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {{{}}}}}}}
supports: [{{on: beam.left, fix: x}}, {{on: beam.bottom_left, fix: y}}]
loads: {{turn: {{on: beam.right, moment: {}}}}}
)",
                                            t, E, L, h, mesh, sign * M));
      const auto& nodes = solution.mesh.bodies[0].nodes;
      const Vector& u = last(solution).fields.displacements[0];
      const double c = sign * M / (E * I);  // curvature: counter-clockwise at the right end bends the beam upwards
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double x = nodes[i].x(), y = nodes[i].y() - 0.5 * h;
        const Vec2 exact(-c * x * y, 0.5 * c * (x * x + 0.3 * (y * y - 0.25 * h * h)));
        EXPECT_LT((u.segment<2>(static_cast<Eigen::Index>(2 * i)) - exact).norm(), 1e-9 * std::abs(c) * L * L) << mesh;
      }
      EXPECT_LT(last(solution).reactions[0].norm(), 1e-9 * M / h);
    }
}

// Displacements of all edges by formulas of a uniform strain give a uniform stress, of every kind of mesh; scaled by
// the factor of their step.
TEST(Formulas, OfAUniformStrainOnAllEdgesGiveAUniformStress) {
  const double E = 2e11, nu = 0.3, xx = 1e-3, xy = 4e-4, yy = -5e-4;
  for (const char* mesh : {"size: 0.5, order: 2", "kind: fem, size: 0.5", "kind: polygons, size: 0.4, order: 1"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
parameters: {{e: 1e-3}}
materials: {{stuff: {{young: {}, poisson: {}}}}}
bodies: {{plate: {{material: stuff, shape: {{rectangle: {{corner: [1, 2], size: [2, 1]}}}}, mesh: {{{}}}}}}}
supports:
  - {{on: plate.bottom, displacement: {{formula: ["${{e}} * x + 4e-4 * y", "4e-4 * x - 5e-4 * y"]}}, name: a}}
  - {{on: plate.top, displacement: {{formula: ["${{e}} * x + 4e-4 * y", "4e-4 * x - 5e-4 * y"]}}, name: b}}
  - {{on: plate.left, displacement: {{formula: ["${{e}} * x + 4e-4 * y", "4e-4 * x - 5e-4 * y"]}}, name: c}}
  - {{on: plate.right, displacement: {{formula: ["${{e}} * x + 4e-4 * y", "4e-4 * x - 5e-4 * y"]}}, name: d}}
steps: [{{name: half, loads: {{a: 0.5, b: 0.5, c: 0.5, d: 0.5}}}}]
)",
                                          E, nu, mesh));
    const double k = 0.5 * E / (1.0 - nu * nu);
    const Eigen::Vector3d exact(k * (xx + nu * yy), k * (yy + nu * xx), k * (1.0 - nu) * xy);
    for (const Vec2& at : {Vec2(1.3, 2.4), Vec2(2.1, 2.7), Vec2(2.9, 2.1)}) {
      const auto values = result::value_at(solution, last(solution).fields, 0, at);
      ASSERT_TRUE(values);
      EXPECT_LT((values->stress - exact).norm(), 1e-10 * exact.norm()) << mesh;
    }
    // Reaction of the right edge: stress times length, but for what its corners share with the other edges.
    Vec2 sum = Vec2::Zero();
    for (const Vec2& reaction : last(solution).reactions) sum += reaction;
    EXPECT_LT(sum.norm(), 1e-9 * exact.norm());
  }
}

// A rigid plate on an elastic block turns by M over the stiffness that a prescribed rotation finds.
analysis::StaticSolution plate_on_block(const std::string& support, const std::string& load,
                                        const std::string& steps = {}) {
  return run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.3}}}}
bodies:
  block: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.25, order: 3}}}}
  plate: {{rigid: true, shape: {{rectangle: {{corner: [-0.5, 1], size: [3, 0.2]}}}}}}
supports:
  - {{on: block.bottom, fix: [x, y]}}
  {}
contacts: {{glue: {{between: [block.top, plate.bottom], bond: true}}}}
loads: {{{}}}
{}
)",
                         support, load, steps));
}

TEST(Rotations, OfARigidPlateNeedTheMomentThatTurnsIt) {
  const auto turned = plate_on_block("- {on: plate, rotation: 1e-3, name: drive}", "");
  ASSERT_TRUE(last(turned).moments[1].has_value());
  const double M = *last(turned).moments[1];
  EXPECT_GT(M, 0.0);
  EXPECT_FALSE(last(turned).moments[0].has_value());
  EXPECT_NEAR(last(turned).fields.displacements[1][2], 1e-3, 1e-17);
  EXPECT_LT(last(turned).reactions[1].norm(), 1e-9 * M);  // its translation is free
  EXPECT_NEAR(last(turned).energy.external, 0.5 * M * 1e-3, 1e-12 * M);
  EXPECT_NEAR(last(turned).energy.elastic, 0.5 * M * 1e-3, 1e-10 * M * 1e-3);
  const auto by_moment = plate_on_block("", fmt::format("turn: {{on: plate, moment: {:.17g}}}", M));
  EXPECT_NEAR(last(by_moment).fields.displacements[1][2], 1e-3, 1e-12);
  EXPECT_LT((last(by_moment).fields.displacements[1] - last(turned).fields.displacements[1]).norm(), 1e-12);
}

// About another point: the same motion has the same force, and a moment that differs by the arm of the force.
TEST(Rotations, AboutAPointMoveItsNeighbours) {
  const Vec2 at(-0.5, 1.0), centroid(1.0, 1.1), shift(2e-4, -3e-4);
  const double angle = 5e-4;
  const auto first =
      plate_on_block("- {on: plate, rotation: 5e-4, at: [-0.5, 1], displacement: [2e-4, -3e-4], name: drive}", "");
  const Vec2 arm = centroid - at, moved = shift + angle * Vec2(-arm.y(), arm.x());
  const Vec2 found = last(first).fields.displacements[1].head<2>();
  EXPECT_LT((found - moved).norm(), 1e-16);
  const auto second =
      plate_on_block(fmt::format("- {{on: plate, rotation: 5e-4, displacement: [{:.17g}, {:.17g}], name: drive}}",
                                 moved.x(), moved.y()),
                     "");
  const Vec2 F = last(first).reactions[1];
  EXPECT_LT((last(second).reactions[1] - F).norm(), 1e-10 * F.norm());
  EXPECT_NEAR(*last(first).moments[1], *last(second).moments[1] + arm.x() * F.y() - arm.y() * F.x(), 1e-10 * F.norm());
  EXPECT_NEAR(last(first).energy.external, last(first).energy.elastic, 1e-10 * last(first).energy.elastic);
}

TEST(Rotations, ScaleWithTheFactorOfTheirStep) {
  const auto solution = plate_on_block("- {on: plate, rotation: 1e-3, name: drive}", "", R"(
steps:
  - {name: there, loads: {drive: 1}}
  - {name: back, loads: {drive: -0.5}}
)");
  ASSERT_EQ(solution.increments.size(), 2u);
  EXPECT_NEAR(*increment_at(solution, 1).moments[1], -0.5 * *increment_at(solution, 0).moments[1],
              1e-10 * *increment_at(solution, 0).moments[1]);
}

std::string warning_of_large_displacements(const analysis::StaticSolution& solution) {
  std::string texts;
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::large_displacement) texts += warning.text + "; ";
  return texts;
}

// Rotations beyond those that may be prescribed are named, once: of rigid bodies, and of elastic ones that move by less
// than a tenth of their size.
TEST(Rotations, BeyondThoseOfTheTheoryAreNamed) {
  EXPECT_EQ(warning_of_large_displacements(plate_on_block("- {on: plate, rotation: 0.1}", "")), "");
  const double moment = *last(plate_on_block("- {on: plate, rotation: 0.1}", "")).moments[1];
  EXPECT_EQ(
      warning_of_large_displacements(plate_on_block("", fmt::format("m: {{on: plate, moment: {}}}", 0.99 * moment))),
      "");
  EXPECT_EQ(warning_of_large_displacements(plate_on_block(
                "", fmt::format("m: {{on: plate, moment: {}}}", -1.2 * moment), "steps: [{increments: 3}]")),
            "step step_1, increment 3: body 'plate' turns by -0.12 rad, held by contact alone: the theory is valid for "
            "rotations of up to 0.1 rad, and normals of contacts and directions of loads do not turn; ");

  const double k = 1e3, a = 2.0;  // a block on springs turns by M / (k a^3 / 12)
  for (const double rotation : {0.09, -0.11}) {
    const std::string text = warning_of_large_displacements(run(fmt::format(R"(scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.3}}}}
bodies: {{block: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [{}, 1]}}}}, mesh: {{size: 0.5}}}}}}
springs: [{{on: block.bottom, k_n: {}, k_t: {}}}]
loads: {{turn: {{on: block.top, moment: {}}}}}
)",
                                                                            a, k, k, rotation * k * a * a * a / 12.0)));
    EXPECT_EQ(text.find("'block' turns by -0.11 rad") != std::string::npos, rotation < 0.0) << text;
  }
}

// The tip of a wedge between a rigid floor and a rigid slope that comes down can only slide out. Friction at both
// prevents it where tan(beta / 2) < mu, beta the angle of the tip: no force is then large enough to make room.
TEST(Wedged, TheTipThatFrictionHoldsBetweenTwoDrivenBodiesIsNamed) {
  const double beta = std::atan2(1.0, 2.0), most = std::tan(0.5 * beta);
  const auto driven = [](double friction, const char* slope) {
    return run(fmt::format(R"(scabo: 1
materials: {{soft: {{young: 1e7, poisson: 0.3}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
  wall: {{rigid: true, shape: {{rectangle: {{corner: [-1, 0], size: [1, 3]}}}}}}
  toe: {{material: soft, shape: {{polygon: {{vertices: [[0, 0], [2, 0], [0, 1]]}}}}, mesh: {{size: 0.25}}}}
  slope: {{rigid: true, shape: {{polygon: {{vertices: {0}}}}}}}
supports:
  - {{on: floor, fix: [x, y]}}
  - {{on: wall, fix: [x, y]}}
  - {{on: slope, displacement: [0, -0.01], rotation: 0}}
contacts:
  on_floor: {{between: [floor.top, toe.edge_1], friction: {1}}}
  on_wall: {{between: [wall.right, toe.edge_3], friction: {1}}}
  on_slope: {{between: [toe.edge_2, slope.edge_4], friction: {1}}}
)",
                           slope, friction));
  };
  const char *to_the_tip = "[[2, 0], [3, 0.5], [1, 1.5], [0, 1]]",
             *short_of_it = "[[1.5, 0.25], [2.5, 0.75], [1.5, 1.25], [0.5, 0.75]]";
  EXPECT_EQ(driven(0.97 * most, to_the_tip).outcome, analysis::Outcome::solved);
  EXPECT_EQ(driven(4.0, short_of_it).outcome, analysis::Outcome::solved);
  for (const double friction : {1.03 * most, 1.5}) {
    const auto solution = driven(friction, to_the_tip);
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
    for (const char* part : {"body 'toe' is wedged at (2, 0) between P", " of contact 'on_floor' and P",
                             " of contact 'on_slope': the sides enclose 26.6 degrees"})
      EXPECT_NE(solution.reason.find(part), std::string::npos) << solution.reason;
  }
}

}  // namespace
}  // namespace scabo::verification
