// Normals of contacts with large slip do not turn with the bodies.
#include "scabo/analysis/diagnostics/large_rotations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::analysis {
namespace {

using testing::IsEmpty;

/// A sled with a round runner, pulled at its top, which rocks until the normal force is where friction tips it.
/// In one increment of 0.3 m the parts into which it is halved, and with them the rotation, depend on rounding.
StaticSolution sled(bool rigid_track, double friction) {
  return solve_static(input::parse_model(
      R"(scabo: 1
materials: {stone: {young: 20e9, poisson: 0.25}}
bodies:
  track: {)" +
          std::string(rigid_track ? "rigid: true" : "material: stone, mesh: {size: 0.25}") +
          R"(, shape: {rectangle: {corner: [-2, -1], size: [6, 1]}}}
  sled:
    material: stone
    shape:
      outline:
        - {arc: {from: [0, 0.05], to: [1, 0.05], centre: [0.5, 2.525]}, name: under}
        - {line: {from: [1, 0.05], to: [1, 0.6]}, name: right}
        - {line: {from: [1, 0.6], to: [0, 0.6]}, name: top}
        - {line: {from: [0, 0.6], to: [0, 0.05]}, name: left}
    mesh: {size: 0.1}
supports:
  - {on: track)" +
          std::string(rigid_track ? "" : ".bottom") + R"(, fix: [x, y]}
  - {on: sled.top, displacement: [0.3, null], name: drive}
loads: {press: {on: sled.top, pressure: 1e5}}
contacts: {runner: {between: [track.top, sled.under], slip: large, friction: )" +
          std::to_string(friction) + R"(}}
steps: [{loads: {press: 1, drive: 0}}, {loads: {drive: 1}, increments: 3}]
)",
      "model.yaml"));
}

std::vector<std::string> of_rotation(const StaticSolution& solution) {
  std::vector<std::string> texts;
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::large_displacement) texts.push_back(warning.text);
  return texts;
}

double pull_over_weight(const StaticSolution& solution) {
  const IncrementResult& last = solution.increments.back();
  return last.reactions[1].x() / last.reactions[0].y();
}

// The sled of height h and weight W turns by t about its top until the force at x = r t of its runner balances it: W r
// t = H h. Normals halfway between those of track and runner are wrong by t / 2, H = W tan(arctan(mu) + t / 2). With r
// = 2.475, h = .6 and mu = .3: t = .084. Nodes of the runner are up to .05 apart, and x is known to that.
TEST(RotationsAtLargeSlip, AreNamedWhereNormalsAreWrong) {
  const StaticSolution solution = sled(false, 0.3);
  ASSERT_EQ(solution.outcome, Outcome::solved) << solution.reason;
  const std::vector<std::string> texts = of_rotation(solution);
  ASSERT_EQ(texts.size(), 1u);
  double turn = 0.0, wrong = 0.0, percent = 0.0;
  const std::string words =
      "step step_2, increment %*d: body 'sled' turns by %lf rad, and normals of contact 'runner' do not turn with it: "
      "the direction of the contact forces is wrong by about %lf rad, %lf %% of friction; ";
  ASSERT_EQ(std::sscanf(texts[0].c_str(), words.c_str(), &turn, &wrong, &percent), 3) << texts[0];
  EXPECT_NEAR(turn, -0.084, 0.05 / 2.475);
  EXPECT_NEAR(wrong, -turn / 2, 0.0011);  // both are rounded
  EXPECT_NEAR(percent, 100 * wrong / 0.3, 1.0);
  EXPECT_NEAR(pull_over_weight(solution), std::tan(std::atan(0.3) + wrong), 0.01);  // this is what it tells of
}

TEST(RotationsAtLargeSlip, AreNotNamedWhereTheyAreSmallOrNormalsAreThoseOfARigidTrack) {
  const StaticSolution flat = sled(false, 0.05), rigid = sled(true, 0.3);
  ASSERT_EQ(flat.outcome, Outcome::solved) << flat.reason;
  ASSERT_EQ(rigid.outcome, Outcome::solved) << rigid.reason;
  EXPECT_THAT(of_rotation(flat), IsEmpty());
  EXPECT_NEAR(pull_over_weight(rigid), 0.3, 1e-9);
  EXPECT_THAT(of_rotation(rigid), IsEmpty());
}

}  // namespace
}  // namespace scabo::analysis
