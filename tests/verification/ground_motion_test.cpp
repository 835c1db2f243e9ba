// Ground that moves, by records and by supports, and water that moves with dams.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "dynamics.hpp"

namespace scabo::verification {
namespace {

using analysis::IncrementResult;
using analysis::StaticSolution;

// A column on a support that moves by a curve, and the same in the frame that moves with it: the motions differ by that
// of the support. At first it moves as its support does.
TEST(GroundMotion, AMovingSupportIsAMovingFrame) {
  const auto model = [](bool frame) {
    const double omega = 8.0 * std::numbers::pi, amplitude = 0.01;
    const std::string support = frame ? "fix: [x, y]" : "displacement: [1, 0]",
                      ground = frame ? ", ground: {x: push}" : "", loads = frame ? "" : ", loads: {base: shake}";
    return fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{stone: {{young: 1e8, poisson: 0.2, density: 2000}}}}
bodies:
  column: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 4]}}}}, mesh: {{kind: fem, size: 0.5, order: 2}}}}
supports: [{{name: base, on: column.bottom, {0}}}]
curves:
  shake: {{sine: {{amplitude: {1}, periods: 2}}}}
  push: {{sine: {{amplitude: {2}, periods: 2}}}}
steps: [{{name: shake, dynamic: {{duration: 0.5, step: 2.5e-4{3}}}, increments: 20{4}}}]
initial: [{{on: column, velocity: [{5}, 0]}}]
)",
                       support, amplitude, -amplitude * omega * omega, ground, loads, frame ? 0.0 : amplitude * omega);
  };
  const StaticSolution absolute = run(model(false)), relative = run(model(true));
  expect_balanced(absolute);
  expect_balanced(relative);
  const auto top = [](const IncrementResult& at) {
    const Vector& u = at.fields.displacements[0];
    return u[u.size() - 2];
  };
  double largest = 0.0;
  for (const IncrementResult& at : relative.increments) largest = std::max(largest, std::abs(top(at)));
  for (std::size_t i = 0; i < relative.increments.size(); ++i) {
    const double ground = 0.01 * std::sin(8.0 * std::numbers::pi * *relative.increments[i].time);
    EXPECT_NEAR(top(absolute.increments[i]) - ground, top(relative.increments[i]), 2e-3 * largest);
    EXPECT_NEAR(absolute.increments[i].reactions[0].x(), relative.increments[i].reactions[0].x(), 2e-2 * 8000.0 * 6.3);
  }
}

// The ground's acceleration as a step of 2 m/s2, as the velocity that it has, and as its displacement: columns of one
// file, of which the column shakes as under the table of the first.
TEST(GroundMotion, TheGroundByVelocityAndDisplacement) {
  const std::filesystem::path directory = std::filesystem::path(::testing::TempDir()) / "ground_motion";
  std::filesystem::create_directories(directory);
  {
    std::ofstream file(directory / "ground.csv");
    file << "t, a, v, u\n";
    for (int i = 0; i <= 250; ++i) {
      const double t = 0.002 * i, w = 8.0 * std::numbers::pi;  // two cycles; it begins and ends at rest
      file << fmt::format("{}, {}, {}, {}\n", t, 2.0 * std::sin(w * t), 2.0 / w * (1.0 - std::cos(w * t)),
                          2.0 / w * (t - std::sin(w * t) / w));
    }
  }
  const auto model = [&](const std::string& curve) {
    return fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{stone: {{young: 1e8, poisson: 0.2, density: 2000}}}}
bodies:
  column: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 4]}}}}, mesh: {{kind: fem, size: 1, order: 2}}}}
supports: [{{on: column.bottom, fix: [x, y]}}]
curves: {{quake: {{{}}}}}
steps: [{{dynamic: {{duration: 0.5, step: 1e-3, ground: {{x: quake}}}}, increments: 20}}]
)",
                       curve);
  };
  const StaticSolution exact = run(model("sine: {amplitude: 2, periods: 2}"));
  const auto force = [](const StaticSolution& of, std::size_t i) { return of.increments[i].reactions[0].x(); };
  double largest = 0.0;
  for (std::size_t i = 0; i < 20; ++i) largest = std::max(largest, std::abs(force(exact, i)));
  for (const char* of :
       {"unit: m/s2, column: 2", "unit: m/s, column: 3", "unit: m, column: 4", "unit: 1, of: velocity, column: 3"}) {
    const StaticSolution other =
        run(model(fmt::format("record: {{file: {}, {}}}", (directory / "ground.csv").string(), of)));
    expect_balanced(other);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(force(other, i), force(exact, i), 2e-3 * largest) << of;
  }
}

// What the ground has done by some time: of A sin(w t) in closed form, and of a table with a jump.
TEST(GroundMotion, WhatTheGroundHasDone) {
  const model::Curve sine{"sine", model::CurveSine{0.5, 3.0, 2.0, 0.0}, {}},
      table{"table", model::CurveTable{{{0.0, 2.0}, {0.5, 4.0}, {0.5, 0.0}, {1.0, -1.0}}, 0.0, 2.0}, {}};
  const double w = 4.0 * std::numbers::pi / 5.0, t = 3.0;  // two periods in 5 s
  const model::GroundMotion by_sine = model::ground_motion(sine, 5.0, t),
                            by_table = model::ground_motion(table, 9.0, 3.0);
  EXPECT_NEAR(by_sine.largest, 3.5, 2e-3);
  EXPECT_NEAR(by_sine.velocity, 0.5 * t + 3.0 / w * (1.0 - std::cos(w * t)), 1e-9);
  EXPECT_NEAR(by_sine.displacement, 0.25 * t * t + 3.0 / w * (t - std::sin(w * t) / w), 1e-5);
  EXPECT_NEAR(by_table.largest, 4.0, 1e-9);
  EXPECT_NEAR(by_table.velocity, 3.0 - 0.5 - 1.0, 1e-9);  // it stays at -1
  EXPECT_NEAR(by_table.displacement, (1.0 + 2.0 / 6.0) + (3.0 - 1.0 / 6.0) + (2.5 - 0.5), 1e-9);
}

// Westergaard's water at a wall of height H that the ground accelerates at once by a: in all 7/12 density H^2 a. The
// wall is stiff, so that it is in equilibrium with that in the mean of its vibrations.
TEST(GroundMotion, WaterThatMovesWithAWall) {
  const auto shear = [](const std::string& kind, double level, const std::string& bottom) {
    const StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: strain}}
materials: {{wall: {{young: 1e13, poisson: 0, density: 1e-3, damping: {{ratio: 0.5, between: [1000, 10000]}}}}}}
bodies:
  wall: {{material: wall, shape: {{rectangle: {{corner: [0, 0], size: [20, 40]}}}}, mesh: {{{}}}}}
supports: [{{name: base, on: wall.bottom, fix: [x, y]}}]
added_mass: [{{on: wall.left, level: {}, density: 1000{}}}]
curves: {{push: {{table: [[0, 2], [1, 2]]}}}}
steps: [{{dynamic: {{duration: 1, step: 1e-3, ground: {{x: push}}}}, increments: 2}}]
)",
                                                    kind, level, bottom));
    expect_balanced(solution);
    return solution.increments.back().reactions[0].x();
  };
  for (const char* kind : {"kind: fem, size: 5, order: 2", "kind: fem, size: 2.5, order: 1", "size: 10, order: 4"}) {
    EXPECT_NEAR(shear(kind, 40, ""), 7.0 / 12.0 * 1000.0 * 40.0 * 40.0 * 2.0, 2e-3 * 1.867e6) << kind;
    EXPECT_NEAR(shear(kind, 33, ""), 7.0 / 12.0 * 1000.0 * 33.0 * 33.0 * 2.0, 2e-3 * 1.271e6) << kind;
  }
  // A reservoir that is deeper than the wall is high: 7/8 density sqrt(H) 2/3 H_wall^1.5.
  EXPECT_NEAR(shear("kind: fem, size: 5, order: 2", 40, ", bottom: -20"),
              7.0 / 12.0 * 1000.0 * std::sqrt(60.0) * std::pow(40.0, 1.5) * 2.0, 2e-3 * 2.286e6);
}

}  // namespace
}  // namespace scabo::verification
