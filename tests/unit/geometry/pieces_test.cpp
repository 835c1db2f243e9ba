// Edges that cross, touch or lie on each other, and outlines that overlap or share area.
#include "scabo/geometry/plane/pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scabo/geometry/plane/common_area.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::geometry {
namespace {

constexpr double half_turn = std::numbers::pi, tolerance = 1e-9;

Edge segment(const Vec2& a, const Vec2& b) {
  Edge edge;
  edge.start = a;
  edge.end = b;
  return edge;
}

Edge arc_of(const Vec2& centre, double radius, double from, double sweep) {
  const auto at = [&](double angle) { return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle))); };
  Edge edge = segment(at(from), at(from + sweep));
  edge.arc = Arc{centre, radius, from, sweep};
  return edge;
}

Outline box(double x, double y, double width, double height) {
  const std::vector<Vec2> p{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  Outline outline;
  for (std::size_t i = 0; i < 4; ++i) outline.edges.push_back(segment(p[i], p[(i + 1) % 4]));
  return outline;
}

TEST(MeetingPositions, OfCrossingLinesAndOfLinesOnEachOther) {
  const Edge a = segment({0, 0}, {4, 0}), b = segment({1, -1}, {1, 3}), c = segment({3, 0}, {2, 0}),
             d = segment({0, 5}, {4, 5});
  const auto positions = meeting_positions({&a, &b, &c, &d}, tolerance);
  EXPECT_EQ(positions[0], (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
  EXPECT_EQ(positions[1], (std::vector<double>{0.0, 0.25, 1.0}));
  EXPECT_EQ(positions[2], (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(positions[3], (std::vector<double>{0.0, 1.0}));
}

TEST(MeetingPositions, WhatCutsOneOfTwoLinesOnEachOtherCutsBoth) {
  const Edge a = segment({0, 0}, {4, 0}), b = segment({4, 1e-10}, {0, 1e-10}), c = segment({1, 0}, {1, 2});
  const auto positions = meeting_positions({&a, &b, &c}, tolerance);
  EXPECT_EQ(positions[0].size(), 3u);
  ASSERT_EQ(positions[1].size(), 3u);
  EXPECT_NEAR(positions[1][1], 0.75, 1e-12);
}

// A line that is tangent to an arc within rounding is within the tolerance of it over 1e-4 of its length.
TEST(MeetingPositions, TangentialCurvesHaveOneCommonPoint) {
  for (const double off : {0.0, 1e-11, -1e-11, 1e-10, -1e-10}) {
    const Edge line = segment({-1, 1 + off}, {0, 1}), round = arc_of({0, 0}, 1.0, 0.5 * half_turn, -0.5 * half_turn);
    const auto corner = meeting_positions({&line, &round}, tolerance);
    EXPECT_EQ(corner[0].size(), 2u) << off;
    EXPECT_EQ(corner[1].size(), 2u) << off;
    const Edge roof = segment({-1, 1 + off}, {1, 1 + off}), circle = arc_of({0, 0}, 1.0, 0.0, half_turn);
    const auto touching = meeting_positions({&roof, &circle}, tolerance);
    EXPECT_EQ(touching[0].size(), 3u) << off;
    EXPECT_EQ(touching[1].size(), 3u) << off;
  }
}

TEST(PartOf, AnArcHasItsEndsOnIt) {
  const Edge half = arc_of({1, 2}, 2.0, 0.0, half_turn), part = part_of(half, 0.25, 0.75);
  EXPECT_NEAR(part.length(), half_turn, 1e-14);
  EXPECT_LT((part.start - Vec2(1 + std::sqrt(2.0), 2 + std::sqrt(2.0))).norm(), 1e-14);
  EXPECT_LT((part.at(0.5) - Vec2(1, 4)).norm(), 1e-14);
}

struct Case {
  const char* name;
  Outline a, b;
  bool share, first_beyond, second_beyond;
};

TEST(Overlap, OfTwoOutlines) {
  Outline ring = box(0, 0, 4, 4), hole = box(1, 1, 2, 2), disc;
  hole.corners.resize(4);
  turn_round(hole);
  ring.edges.insert(ring.edges.end(), hole.edges.begin(), hole.edges.end());
  ring.holes = {4};
  disc.edges = {arc_of({2, 2}, 1.0, 0.0, half_turn), arc_of({2, 2}, 1.0, half_turn, half_turn)};
  const std::vector<Case> cases = {
      {"apart", box(0, 0, 1, 1), box(2, 0, 1, 1), false, true, true},
      {"side by side", box(0, 0, 1, 1), box(1, 0, 1, 1), false, true, true},
      {"side by side, one longer", box(0, 0, 1, 1), box(1, -1, 1, 3), false, true, true},
      {"at a corner", box(0, 0, 1, 1), box(1, 1, 1, 1), false, true, true},
      {"inside", box(0, 0, 4, 4), box(1, 1, 1, 1), true, true, false},
      {"inside, on a side", box(0, 0, 4, 4), box(0, 1, 1, 1), true, true, false},
      {"inside, on three sides", box(0, 0, 4, 4), box(0, 0, 4, 1), true, true, false},
      {"around", box(1, 1, 1, 1), box(0, 0, 4, 4), true, false, true},
      {"the same", box(0, 0, 4, 4), box(0, 0, 4, 4), true, false, false},
      {"across", box(0, 0, 4, 4), box(3, 1, 4, 1), true, true, true},
      {"a cross", box(0, 1, 3, 1), box(1, 0, 1, 3), true, true, true},
      {"disc in a square, tangential", box(1, 1, 2, 2), disc, true, true, false},
      {"the hole of a ring", ring, box(1, 1, 2, 2), false, true, true},
      {"in the hole of a ring", ring, disc, false, true, true},
      {"around the hole of a ring", ring, box(0.5, 0.5, 3, 3), true, true, true},
  };
  for (const Case& given : cases) {
    const Overlap found = overlap_of(given.a, given.b, tolerance);
    EXPECT_EQ(found.share_area, given.share) << given.name;
    EXPECT_EQ(found.first_beyond, given.first_beyond) << given.name;
    EXPECT_EQ(found.second_beyond, given.second_beyond) << given.name;
  }
}

Outline polygon_of(const std::vector<Vec2>& p) {
  Outline outline;
  for (std::size_t i = 0; i < p.size(); ++i) outline.edges.push_back(segment(p[i], p[(i + 1) % p.size()]));
  return outline;
}

Outline disc_at(const Vec2& centre, double radius, double sweep = 2.0 * half_turn) {
  Outline outline;
  outline.edges = {arc_of(centre, radius, 0.0, sweep)};
  outline.edges.front().end = outline.edges.front().start;
  return outline;
}

/// Both ways round.
bool share(const Outline& a, const Outline& b) {
  const bool found = common_area(a, b, tolerance).has_value();
  EXPECT_EQ(common_area(b, a, tolerance).has_value(), found);
  return found;
}

TEST(CommonArea, OfBodiesThatOverlapInPart) {
  EXPECT_TRUE(share(box(0, 0, 2, 1), box(1.5, 0.5, 2, 1)));
  EXPECT_TRUE(share(box(0, 0, 2, 1), box(1.5, 0, 2, 1)));            // along common lines
  EXPECT_TRUE(share(box(-10, 0, 20, 0.1), box(0.37, -9, 0.1, 20)));  // thin bars that cross
  EXPECT_TRUE(share(disc_at({0, 0}, 1), disc_at({1.9, 0}, 1)));
}

TEST(CommonArea, OfBodiesInTheSamePlaceOrInside) {
  EXPECT_TRUE(share(box(0, 0, 2, 1), box(0, 0, 2, 1)));
  EXPECT_TRUE(share(disc_at({0, 0}, 1), disc_at({0, 0}, 1)));
  EXPECT_TRUE(share(box(0, 0, 2, 1), box(0.5, 0.25, 0.1, 0.1)));
  EXPECT_TRUE(share(disc_at({0, 0}, 1), box(-0.1, -0.1, 0.2, 0.2)));
}

TEST(CommonArea, NoneOfBodiesThatTouchOrAreApart) {
  EXPECT_FALSE(share(box(0, 0, 2, 1), box(2, 0, 2, 1)));
  EXPECT_FALSE(share(box(0, 0, 2, 1), box(0.5, 1 - 1e-10, 2, 1)));  // rounding
  EXPECT_FALSE(share(box(0, 0, 2, 1), box(2, 1, 2, 1)));            // in a corner
  EXPECT_FALSE(share(disc_at({0, 0}, 1), box(-1, 1, 2, 1)));        // in a point
  EXPECT_FALSE(share(box(0, 0, 2, 1), box(9, 0, 2, 1)));
  const Outline angle = polygon_of({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  EXPECT_FALSE(share(angle, box(1.5, 1.5, 1, 1)));  // within its box
  EXPECT_FALSE(share(angle, box(1, 1, 1, 1)));
}

TEST(CommonArea, NoneOfAShaftInItsHub) {
  Outline hub = box(-2, -2, 4, 4);
  hub.holes = {4};
  hub.edges.push_back(disc_at({0, 0}, 1, -2.0 * half_turn).edges.front());
  EXPECT_FALSE(share(hub, disc_at({0, 0}, 1)));
  EXPECT_FALSE(share(hub, disc_at({0, 0}, 0.5)));
  EXPECT_TRUE(share(hub, disc_at({0, 0}, 1.1)));
}

TEST(CommonArea, OfBodiesFromMeshFiles) {
  Outline chain = polygon_of({{0, 0}, {4, 0}, {4, 1}});
  chain.edges[2].points = {{3, 2}, {1, 2}};  // from (4, 1) back to (0, 0)
  EXPECT_TRUE(share(chain, box(1.5, 1.9, 0.5, 1)));
  EXPECT_FALSE(share(chain, box(1.5, 2, 0.5, 1)));
}

TEST(CommonArea, IsShownByAPointOfIt) {
  const Outline a = box(0, 0, 2, 1), b = box(1.5, 0.5, 2, 1);
  const auto point = common_area(a, b, tolerance);
  ASSERT_TRUE(point);
  EXPECT_LE(std::min(distance_to(a, *point), distance_to(b, *point)), tolerance);
  EXPECT_TRUE(encloses(a, *point) || encloses(b, *point));
}

}  // namespace
}  // namespace scabo::geometry
