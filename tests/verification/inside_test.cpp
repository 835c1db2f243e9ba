// Bodies that are one super-element, in time: inertia of their inside (docs/methods/16_mass.md, one internal level).
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

using analysis::IncrementResult;
using analysis::StaticSolution;

element::PointValues values_at(const StaticSolution& solution, const IncrementResult& at, const Vec2& x) {
  return result::Probe(solution, at.fields, 0).at(x).value();
}

// A square plate on shaking ground: with finite elements, and as one super-element. Its first frequency is 543.8 Hz,
// the ground has 800 Hz.
std::string plate_on_shaking_ground(const std::string& mesh, double unit = 1.0, double angle = 0.0) {
  const auto at = [&](double x, double y) {
    return fmt::format("[{}, {}]", unit * (x * std::cos(angle) - y * std::sin(angle)),
                       unit * (x * std::sin(angle) + y * std::cos(angle)));
  };
  return fmt::format(
      R"(
scabo: 1
analysis: {{plane: stress, thickness: {0}}}
materials: {{steel: {{young: {1}, poisson: 0.3, density: {2}, damping: {{ratio: 0.02, between: [300, 3000]}}}}}}
bodies:
  plate: {{material: steel, shape: {{polygon: {{vertices: [{3}, {4}, {5}, {6}]}}}}, mesh: {7}}}
supports: [{{on: plate.edge_1, fix: [x, y]}}]
loads: {{weight: {{gravity: {8}}}}}
curves: {{x: {{sine: {{amplitude: {9}, periods: 4}}}}, y: {{sine: {{amplitude: {10}, periods: 4}}}}}}
steps:
  - {{name: rest}}
  - {{name: shake, dynamic: {{duration: 5e-3, step: 1e-5, ground: {{x: x, y: y}}}}, increments: 50}}
)",
      unit, 210e9 / unit, 7800.0 / unit / unit / unit, at(0, 0), at(1, 0), at(1, 1), at(0, 1), mesh, at(0, -1000.0),
      unit * 1000.0 * std::cos(angle), unit * 1000.0 * std::sin(angle));
}

TEST(Inside, OfAPlateOnShakingGroundMovesAsWithFiniteElements) {
  const StaticSolution fine = run(plate_on_shaking_ground("{kind: fem, size: 0.0625}")),
                       one = run(plate_on_shaking_ground("{size: 0.125}"));
  expect_balanced(one);
  const Vec2 centre(0.5, 0.5), corner(1.0, 1.0);
  double largest = 0.0, largest_stress = 0.0, error = 0.0, error_of_stress = 0.0, error_inside = 0.0;
  for (std::size_t i = 0; i < fine.increments.size(); ++i) {
    const IncrementResult &a = fine.increments[i], &b = one.increments[i];
    const element::PointValues of_a = values_at(fine, a, centre), of_b = values_at(one, b, centre);
    largest = std::max(largest, values_at(fine, a, corner).displacement.norm());
    largest_stress = std::max(largest_stress, of_a.stress.norm());
    error = std::max(error, (values_at(one, b, corner).displacement - values_at(fine, a, corner).displacement).norm());
    error_inside = std::max(error_inside, (of_b.displacement - of_a.displacement).norm());
    error_of_stress = std::max(error_of_stress, (of_b.stress - of_a.stress).norm());
  }
  EXPECT_LT(error, 0.003 * largest);  // 0.11, 0.17 and 0.30 without the level
  EXPECT_LT(error_inside, 0.003 * largest);
  EXPECT_LT(error_of_stress, 0.01 * largest_stress);
}

// The same with a crack, as one super-element around its tip and as cells of a quadtree: factors and T-stress of the
// tip.
TEST(Inside, OfACrackedPlateGivesTheFactorsOfManyCells) {
  const auto cracked = [](const std::string& mesh, const std::string& crack) {
    return run(fmt::format(
        R"(
scabo: 1
analysis: {{plane: stress}}
materials: {{steel: {{young: 210e9, poisson: 0.3, density: 7800, damping: {{ratio: 0.02, between: [300, 3000]}}}}}}
bodies:
  plate: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {}, cracks: [{}]}}
supports: [{{on: plate.bottom, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -1000]}}}}
curves: {{x: {{sine: {{amplitude: 500, periods: 4}}}}, y: {{sine: {{amplitude: 1000, periods: 4}}}}}}
steps:
  - {{name: rest}}
  - {{name: shake, dynamic: {{duration: 5e-3, step: 1e-5, ground: {{x: x, y: y}}}}, increments: 50}}
output: {{fields: []}}
)",
        mesh, crack));
  };
  const StaticSolution fine = cracked("{kind: quadtree, size: 0.0625}", "{name: flaw, path: [[0, 0.5], [0.5, 0.5]]}"),
                       one = cracked("{size: 0.125}", "{tip: [0.5, 0.5], mouth: [0, 0.5], name: flaw}");
  double largest[3] = {}, error[3] = {};
  for (std::size_t i = 0; i < fine.increments.size(); ++i) {
    const element::StressIntensity &a = fine.increments[i].cracks.at(0).factors,
                                   &b = one.increments[i].cracks.at(0).factors;
    const double of_a[] = {a.K_I, a.K_II, a.T_left.value()}, of_b[] = {b.K_I, b.K_II, b.T_left.value()};
    for (std::size_t k = 0; k < 3; ++k) {
      largest[k] = std::max(largest[k], std::abs(of_a[k]));
      error[k] = std::max(error[k], std::abs(of_b[k] - of_a[k]));
    }
  }
  // Without the level in the factors 0.022, 0.072 and 0.066.
  EXPECT_LT(error[0], 0.002 * largest[0]);
  EXPECT_LT(error[1], 0.005 * largest[1]);
  EXPECT_LT(error[2], 0.01 * largest[2]);
}

TEST(Inside, IsTheSameInOtherUnitsAndTurned) {
  const StaticSolution one = run(plate_on_shaking_ground("{size: 0.25}")),
                       other = run(plate_on_shaking_ground("{size: 250}", 1000.0, 0.6));
  const double c = std::cos(0.6), s = std::sin(0.6);
  double largest = 0.0, error = 0.0;
  for (std::size_t i = 0; i < one.increments.size(); ++i) {
    const element::PointValues a = values_at(one, one.increments[i], {0.4, 0.6}),
                               b = values_at(other, other.increments[i],
                                             1000.0 * Vec2(0.4 * c - 0.6 * s, 0.4 * s + 0.6 * c));
    const double turned = b.stress[0] * s * s + b.stress[1] * c * c - 2.0 * b.stress[2] * s * c;
    largest = std::max(largest, std::abs(a.stress[1]));
    error = std::max(error, std::abs(1000.0 * turned - a.stress[1]));
    EXPECT_NEAR(other.increments[i].energy.external / 1e6, one.increments[i].energy.external,
                1e-8 * one.increments.back().energy.external);
  }
  EXPECT_LT(error, 1e-8 * largest);
}

// A body that falls freely has no stress.
TEST(Inside, OfAFallingBodyIsAtRest) {
  const StaticSolution solution = run(R"(
scabo: 1
analysis: {type: dynamic, plane: strain}
materials: {rubber: {young: 1e6, poisson: 0.4, density: 1000}}
bodies: {block: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [1, 2]}}, mesh: {size: 0.5}}}
loads: {weight: {gravity: [2, -10]}}
steps: [{dynamic: {duration: 0.2, step: 0.01}, increments: 4}]
)");
  expect_balanced(solution);
  const IncrementResult& end = last(solution);
  const element::PointValues at = values_at(solution, end, {0.4, 0.7});
  EXPECT_NEAR(at.displacement.x(), 0.04, 1e-12);
  EXPECT_NEAR(at.displacement.y(), -0.2, 1e-12);
  EXPECT_LT(at.stress.norm(), 1e-7);                        // weight over area: 2e4
  EXPECT_NEAR(end.energy.kinetic, 4160.0, 1e-11 * 4160.0);  // of 2 m/s2 and 10 m/s2 for 0.2 s
}

// Weight that comes slowly is that of statics, inside as well.
TEST(Inside, UnderWeightThatComesSlowlyIsStatic) {
  const auto model = [](const std::string& steps) {
    return R"(
scabo: 1
analysis: {plane: strain}
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
bodies: {block: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}}
supports: [{on: block.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0, -10]}}
curves: {slow: {table: [[0, 0], [0.5, 0.02], [4.5, 0.98], [5, 1]]}}
)" + steps;
  };
  const StaticSolution in_time = run(model("steps: [{dynamic: {duration: 5, step: 5e-3}, loads: {weight: slow}}]")),
                       at_rest = run(model("steps: [{}]"));
  const Vec2 x(0.4, 0.5);
  const element::PointValues a = values_at(in_time, last(in_time), x), b = values_at(at_rest, last(at_rest), x);
  EXPECT_LT((a.stress - b.stress).norm(), 1e-2 * b.stress.norm());
  EXPECT_LT((a.displacement - b.displacement).norm(), 1e-2 * b.displacement.norm());
}

// On a support that moves, and in the frame that moves with it.
TEST(Inside, OfAMovingSupportIsThatOfAMovingFrame) {
  const auto model = [](bool frame) {
    const double omega = 8.0 * std::numbers::pi, amplitude = 0.01;
    return fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{rubber: {{young: 1e6, poisson: 0.3, density: 1000}}}}
bodies: {{block: {{material: rubber, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {{size: 0.25}}}}}}
supports: [{{name: base, on: block.bottom, {}}}]
curves:
  shake: {{sine: {{amplitude: {}, periods: 2}}}}
  push: {{sine: {{amplitude: {}, periods: 2}}}}
steps: [{{name: shake, dynamic: {{duration: 0.5, step: 2e-4{}}}, increments: 20{}}}]
initial: [{{on: block, velocity: [{}, 0]}}]
)",
                       frame ? "fix: [x, y]" : "displacement: [1, 0]", amplitude, -amplitude * omega * omega,
                       frame ? ", ground: {x: push}" : "", frame ? "" : ", loads: {base: shake}",
                       frame ? 0.0 : amplitude * omega);
  };
  const StaticSolution absolute = run(model(false)), relative = run(model(true));
  expect_balanced(absolute);
  expect_balanced(relative);
  double largest = 0.0, error = 0.0;
  for (std::size_t i = 0; i < relative.increments.size(); ++i) {
    const element::PointValues a = values_at(absolute, absolute.increments[i], {0.5, 0.6}),
                               b = values_at(relative, relative.increments[i], {0.5, 0.6});
    largest = std::max(largest, b.stress.norm());
    error = std::max(error, (a.stress - b.stress).norm());
  }
  EXPECT_LT(error, 5e-3 * largest);
}

}  // namespace
}  // namespace scabo::verification
