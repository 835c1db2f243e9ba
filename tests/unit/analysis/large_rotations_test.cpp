// Normals of contacts with large slip do not turn with the bodies.
#include "scabo/analysis/large_rotations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A sled with a round runner, pulled at its top, which rocks until the normal force is where friction tips it: 0.3
/// times the height of 0.6 m before its middle, 0.18 m / 2.525 m = 0.071 rad. In one increment of 0.3 m the parts into
/// which it is halved, and with them the rotation, depend on rounding.
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

TEST(RotationsAtLargeSlip, AreNamedWhereNormalsAreWrong) {
  const StaticSolution solution = sled(false, 0.3);
  ASSERT_EQ(solution.outcome, Outcome::solved) << solution.reason;
  EXPECT_GT(pull_over_weight(solution), 1.1 * 0.3);  // this is what it tells of
  EXPECT_THAT(of_rotation(solution), ElementsAre(HasSubstr("body 'sled' turns by -0.07 rad, and normals of contact "
                                                           "'runner' do not turn with it: the direction of the contact "
                                                           "forces is wrong by about 0.035 rad, 12 % of friction; ")));
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
