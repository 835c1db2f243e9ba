// Point masses: in modes, in time and under gravity.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics.hpp"
#include "scabo/analysis/modal/modal_analysis.hpp"
#include "support/decompositions.hpp"

namespace scabo::verification {
namespace {

using analysis::IncrementResult;
using analysis::StaticSolution;

/// A bar of mass 1 fixed at its left end (E A = length = 1, nu = 0) with `mass` at its right end, on half of its two
/// corners each; `mesh`: one element over its height.
std::string loaded_bar(const std::string& analysis, const std::string& mesh, double mass, const std::string& rest) {
  return fmt::format(R"(
scabo: 1
analysis: {{{0}plane: stress, thickness: 5}}
materials: {{rubber: {{young: 10, poisson: 0, density: 10}}}}
bodies: {{bar: {{material: rubber, shape: {{rectangle: {{corner: [0, 0], size: [1, 0.02]}}}}, mesh: {{{1}}}}}}}
supports:
  - {{on: bar.left, fix: [x, y]}}
  - {{on: bar.top, fix: [y]}}
  - {{on: bar.bottom, fix: [y]}}
point_masses: [{{on: bar.top_right, mass: {2}}}, {{on: bar.bottom_right, mass: {2}}}]
{3})",
                     analysis, mesh, 0.5 * mass, rest);
}

/// w of x tan x = (mass of the bar)/(mass at its end), c = length = 1.
double exact_frequency(double mass) {
  double low = 1e-9, high = 0.5 * std::numbers::pi - 1e-9;
  while (high - low > 1e-15)
    (0.5 * (low + high) * std::tan(0.5 * (low + high)) < 1.0 / mass ? low : high) = 0.5 * (low + high);
  return low;
}

TEST(PointMasses, AtTheEndOfABarLowerItsFrequency) {
  for (const char* mesh : {"kind: fem, size: 0.02, order: 1", "kind: quadtree, size: 0.02, order: 1"})
    for (const double mass : {0.5, 2.0, 20.0}) {
      const auto modes =
          analysis::solve_modal(input::parse_model(loaded_bar("type: modal, modes: 1, ", mesh, mass, ""), "modes.yaml"))
              .modes;
      const double exact = exact_frequency(mass);
      EXPECT_NEAR(2.0 * std::numbers::pi * modes.at(0).frequency / exact, 1.0, 1e-4) << mesh << mass;
    }
}

// Let go from the displacement of a force at its end, the end is back after a period: nearly a spring, as the bar is
// light.
TEST(PointMasses, AtTheEndOfABarSwingWithItsPeriod) {
  const double mass = 20.0, period = 2.0 * std::numbers::pi / exact_frequency(mass);
  const StaticSolution solution = run(loaded_bar("", "kind: fem, size: 0.02, order: 1", mass,
                                                 fmt::format(R"(
loads: {{pull: {{on: bar.right, traction: [1, 0]}}}}
steps:
  - {{name: pull}}
  - {{name: go, dynamic: {{duration: {}, step: {}}}, loads: {{pull: 0}}, increments: 4}}
)",
                                                             period, period / 2000)));
  expect_balanced(solution);
  const auto end = [&](std::size_t i) {
    return increment_at(solution, i).fields.displacements[0].maxCoeff() +
           increment_at(solution, i).fields.displacements[0].minCoeff();
  };
  EXPECT_NEAR(end(0), 0.1, 1e-9);
  EXPECT_NEAR(end(4), 0.1, 0.01 * 0.1);
  EXPECT_NEAR(end(2), -0.1, 0.01 * 0.1);
}

// A rigid block with a mass at a corner, under a force on its centroid: u = 1/2 t^2 A^-1 f, A with the arms of the
// mass.
TEST(PointMasses, OnARigidBodyTurnIt) {
  const StaticSolution solution = run(R"(
scabo: 1
analysis: {type: dynamic, plane: stress}
bodies:
  block: {rigid: true, density: 100, shape: {rectangle: {corner: [1, 2], size: [2, 1]}}}
  far: {rigid: true, shape: {rectangle: {corner: [1, 9], size: [2, 1]}}}
supports: [{on: far, fix: [x, y]}]
contacts: {never: {between: [far.bottom, block.top], friction: 0, gap: 9}}
point_masses: [{on: block.top_right, mass: 50}]
loads: {push: {on: block, force: [3, 0]}}
steps: [{dynamic: {duration: 1, step: 0.05}, increments: 2}]
)");
  expect_balanced(solution);
  const double m = 200.0, M = 50.0, I = m * (4.0 + 1.0) / 12.0, x = 1.0, y = 0.5;
  Matrix A(3, 3);
  A << m + M, 0.0, -M * y, 0.0, m + M, M * x, -M * y, M * x, I + M * (x * x + y * y);
  const Vector expected = 0.5 * test::solve_lu(A, Vector(Vector::Unit(3, 0) * 3.0));
  const Vector& u = last(solution).fields.displacements[0];
  for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(u[k], expected[k], 1e-12) << k;
}

// At rest they weigh, on rigid bodies and on elastic ones.
TEST(PointMasses, Weigh) {
  for (const char* body : {"rigid: true, density: 1000", "material: stone, mesh: {kind: fem, size: 0.5}"}) {
    const StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: stress}}
materials: {{stone: {{young: 1e9, poisson: 0.2, density: 1000}}}}
bodies:
  ground: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
  block: {{{}, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}}}
supports: [{{on: ground, fix: [x, y]}}]
point_masses: [{{on: block.top_left, mass: 500}}]
loads: {{weight: {{on: block, gravity: [0, -9.81]}}}}
contacts: {{base: {{between: [ground.top, block.bottom], friction: 0.5}}}}
)",
                                                    body));
    const auto& base = last(solution).contacts[0];
    EXPECT_NEAR(base.normal_force, 2500.0 * 9.81, 1e-6);
    EXPECT_NEAR(base.centre_of_pressure->x(), (2000.0 * 1.0) / 2500.0, 1e-9) << body;
  }
}

}  // namespace
}  // namespace scabo::verification
