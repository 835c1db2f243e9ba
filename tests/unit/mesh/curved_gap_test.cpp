// Curved sides whose nodes are not exactly opposite: how far off they may be depends on the gap.
#include <gtest/gtest.h>

#include "unit/mesh/models.hpp"

namespace scabo::mesh {
namespace {

using test::pi;

/// Half a disc of radius 1 below, a half ring around it at the distance `gap`, its nodes turned by `turn` against
/// those of the disc; 30 elements of order 2 over the half circle.
model::Model disc_in_ring(double gap, double turn) {
  const double outer = 1.0 + gap, angle = 0.5 * pi * 0.8;
  const auto at = [&](double radius, double from_lowest) {
    return test::polar({0, 0}, radius, -0.5 * pi + from_lowest);
  };
  model::Body disc = test::elastic(
      "disc",
      test::outline({test::arc("rim", {0, 0}, 1.0, -0.5 * pi - angle, 2 * angle),
                     test::line("right", at(1.0, angle), {0, 0}), test::line("left", {0, 0}, at(1.0, -angle))}),
      pi / 30, 2);
  disc.mesh.centre = {0, -0.5};
  const Vec2 left = at(outer, turn - angle), right = at(outer, turn + angle);
  model::Body ring = test::elastic(
      "ring",
      test::outline({test::line("bottom", {left.x(), -3}, {right.x(), -3}), test::line("right", {right.x(), -3}, right),
                     test::arc("inner", {0, 0}, outer, -0.5 * pi + turn + angle, -2 * angle),
                     test::line("left", left, {left.x(), -3})}),
      pi / 30 * outer, 2);
  ring.mesh.centre = {0, -2.0};
  return test::pair_of(ring, "inner", disc, "rim");
}

// Spacing of the nodes pi / 60 = 0.052. Sides that touch must have their nodes opposite each other, however fine the
// mesh: an offset is only allowed up to half of the gap, and up to a fiftieth of the spacing (0.00105).
TEST(CurvedGap, NodesMayBeOffByHalfOfTheGapAtMost) {
  const double spacing = pi / 60.0;
  const auto matches = [](double gap, double offset) {
    return test::message_unmatched(disc_in_ring(gap, offset)).find("do not match") == std::string::npos;
  };
  EXPECT_TRUE(matches(0.0, 0.0));
  EXPECT_FALSE(matches(0.0, 0.01 * spacing));
  EXPECT_FALSE(matches(0.0, 1e-4 * spacing));
  const double offset = 0.01 * spacing;
  EXPECT_FALSE(matches(1.8 * offset, offset));
  EXPECT_TRUE(matches(2.2 * offset, offset));
  EXPECT_FALSE(matches(-1.8 * offset, offset));  // an interference counts as a gap of its size
  EXPECT_TRUE(matches(-2.2 * offset, offset));
  EXPECT_TRUE(matches(0.1, 0.018 * spacing));
  EXPECT_FALSE(matches(0.1, 0.025 * spacing));
}

}  // namespace
}  // namespace scabo::mesh
