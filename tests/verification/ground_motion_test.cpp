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

// A record in g that is said to be in m/s2 is warned of: it may be a weak one.
TEST(GroundMotion, AWeakRecordMayHaveAnotherUnit) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "in_g.csv";
  std::ofstream(file) << "0, 0\n0.01, 0.3\n0.02, -0.2\n0.03, 0\n";
  const model::Model model = input::parse_model(fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{stone: {{young: 1e8, poisson: 0.2, density: 2000}}}}
bodies: {{column: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 4]}}}}, mesh: {{kind: fem, size: 1}}}}}}
supports: [{{on: column.bottom, fix: [x, y]}}]
curves: {{quake: {{record: {{file: {}, unit: m/s2}}}}}}
steps: [{{dynamic: {{duration: 0.03, step: 1e-3, ground: {{x: quake}}}}, increments: 1}}]
)",
                                                            file.string()),
                                                "test.yaml");
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(
      model.warnings[0].text,
      "the largest acceleration of record 'quake' is 0.0306 g, which is little for an earthquake: are its values in "
      "m/s2 and not in g?");
}

// A bar between two supports, of which a record moves one: until the wave comes back from the other, the force on the
// moved end is E A/c times its velocity.
TEST(GroundMotion, ARecordMovesOneSupport) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "one_support.csv";
  const double w = 10.0 * std::numbers::pi, amplitude = 4.0;  // one cycle, in which the velocity rises and falls
  {
    std::ofstream stream(file);
    for (int i = 0; i <= 100; ++i) stream << fmt::format("{}, {}\n", 0.002 * i, amplitude * std::sin(w * 0.002 * i));
  }
  const double E = 900.0, c = 30.0, length = 10.0;
  const StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{bar: {{young: {}, poisson: 0, density: 1}}}}
bodies:
  bar: {{material: bar, shape: {{rectangle: {{corner: [0, 0], size: [{}, 1]}}}}, mesh: {{kind: fem, size: 0.25, order: 2}}}}
supports:
  - {{name: far, on: bar.left, fix: [x, y]}}
  - {{name: moved, on: bar.right, displacement: [1, 0]}}
curves: {{quake: {{record: {{file: {}, unit: m/s2}}}}}}
steps: [{{dynamic: {{duration: 0.6, step: 2e-3}}, loads: {{moved: quake}}, increments: 60}}]
)",
                                                  E, length, file.string()));
  expect_balanced(solution);
  const double largest = E / c * 2.0 * amplitude / w;
  for (const IncrementResult& at : solution.increments) {
    const double t = *at.time - 1e-3;  // forces are means of their time step
    const double v = t < 0.2 ? amplitude / w * (1.0 - std::cos(w * t)) : 0.0;
    EXPECT_NEAR(at.reactions[1].x(), E / c * v, 0.01 * largest) << *at.time;
  }
  // The end has gone 2 amplitude/w 0.1 s, and stays there; of a record that is linear between its times 3e-4 less.
  const Vector& u = last(solution).fields.displacements[0];
  double farthest = 0.0;
  for (Eigen::Index i = 0; i < u.size(); i += 2) farthest = std::max(farthest, u[i]);
  EXPECT_NEAR(farthest, 0.2 * amplitude / w, 5e-4 * farthest);
}

// A rigid beam on springs under a load that drives over it: heave w = F/K (1 - cos a t), and rotation
// F/R ((v t - L/2) + L/2 cos b t - v/b sin b t), R = K L^2/12.
TEST(GroundMotion, ALoadDrivesOverABeamOnSprings) {
  const double L = 4.0, height = 0.5, v = 8.0, F = 3.0, k = 500.0;
  for (const std::string load : {"force: [0, -3]", "pressure: {over: length, at: [-0.01, 0.01], values: [150, 150]}"}) {
    const StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{type: dynamic, plane: stress}}
bodies:
  beam: {{rigid: true, density: 1, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}}}
springs: [{{on: beam.bottom, k_n: {}}}]
loads: {{axle: {{on: beam.top, {}, moving: {{velocity: {}, from: {}}}}}}}
steps: [{{dynamic: {{duration: 0.4, step: 5e-4}}, increments: 20}}]
)",
                                                    L, height, k, load, -v, L));
    expect_balanced(solution);
    const double mass = L * height, inertia = mass * (L * L + height * height) / 12.0, K = k * L,
                 R = k * L * L * L / 12.0, a = std::sqrt(K / mass), b = std::sqrt(R / inertia);
    for (const IncrementResult& at : solution.increments) {
      const double t = *at.time;
      // The top runs from right to left; the load against it, from left to right.
      const double heave = F / K * (1.0 - std::cos(a * t)),
                   turn = F / R * ((v * t - 0.5 * L) + 0.5 * L * std::cos(b * t) - v / b * std::sin(b * t));
      const Vector& u = at.fields.displacements[0];
      EXPECT_NEAR(u[1], -heave, 5e-3 * 2.0 * F / K) << load << t;
      EXPECT_NEAR(u[2], -turn, 5e-3 * F / R * L) << load << t;
    }
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
  model::Curve record = table;
  record.record.emplace();
  model::integrate_record(record);
  for (const double at : {0.3, 1.0, 1.7, 2.0})
    EXPECT_NEAR(model::displacement_at(record, at, 9.0), model::ground_motion(table, 9.0, at).displacement, 1e-9);
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
