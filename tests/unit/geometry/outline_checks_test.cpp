// Crossing outlines and what a scaling centre sees.
#include "scabo/geometry/plane/outline_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scabo/geometry/plane/foot_points.hpp"
#include "unit/input/models.hpp"

namespace scabo::geometry {
namespace {

using namespace input::testing_models;
using testing::HasSubstr;
using testing::IsEmpty;

Outline polygon(const std::vector<Vec2>& vertices) {
  Outline outline;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Edge edge;
    edge.start = vertices[i];
    edge.end = vertices[(i + 1) % vertices.size()];
    outline.edges.push_back(edge);
    outline.corners.push_back({{}, vertices[i]});
  }
  return outline;
}

/// A star-shaped polygon around the origin.
Outline star(int corners, unsigned seed, double least_radius) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(least_radius, 1.0);
  std::vector<Vec2> vertices;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    vertices.push_back(radius(random) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon(vertices);
}

/// Whether two lines cross: the plain comparison of all pairs.
bool crosses_somewhere(const Outline& outline) {
  const std::size_t n = outline.edges.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Edge& a = outline.edges[i];
      const Edge& b = outline.edges[j];
      const Vec2 da = a.end - a.start;
      const Vec2 db = b.end - b.start;
      if (cross(da, b.start - a.start) * cross(da, b.end - a.start) < 0.0 &&
          cross(db, a.start - b.start) * cross(db, a.end - b.start) < 0.0) {
        return true;
      }
    }
  }
  return false;
}

TEST(Crossing, StarShapedPolygonsNeverCross) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    EXPECT_FALSE(find_crossing(star(3 + static_cast<int>(seed) % 40, seed, 0.2))) << seed;
  }
}

TEST(Crossing, AgreesWithTheComparisonOfAllPairs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  int crossing = 0;
  for (int k = 0; k < 500; ++k) {
    std::vector<Vec2> vertices;
    for (int i = 0; i < 3 + k % 4; ++i) vertices.emplace_back(coordinate(random), coordinate(random));
    const Outline outline = polygon(vertices);
    EXPECT_EQ(find_crossing(outline).has_value(), crosses_somewhere(outline)) << k;
    crossing += crosses_somewhere(outline) ? 1 : 0;
  }
  EXPECT_GT(crossing, 50);
  EXPECT_LT(crossing, 450);
}

TEST(Crossing, NoneAmongTenThousandEdges) {
  const Outline round = star(10'000, 1, 0.5);
  std::vector<Vec2> comb;  // long edges that overlap in one direction
  for (int i = 0; i < 5'000; ++i) {
    comb.emplace_back(i, 1e4 + i % 2);
    comb.emplace_back(i + 0.5, 0.0);
  }
  comb.emplace_back(5'000, -1.0);
  comb.emplace_back(0, -1.0);
  for (const Outline& outline : {round, polygon(comb)}) EXPECT_FALSE(find_crossing(outline));
}

TEST(Crossing, RoundedCornersTouchTheirTangentsByRight) {
  // Coordinates rounded to four digits, so that the arc meets its tangent again close to the corner.
  EXPECT_THAT(mistakes_in(shaped("{outline: [{line: {from: [0, 0], to: [3, 0]}}, {line: {to: [3, 1.2929]}},"
                                 " {arc: {to: [2.7071, 2], centre: [2.0000357, 1.2929357]}}, {line: {to: [0, 2]}},"
                                 " {line: {to: [0, 0]}}]}")),
              testing::Not(HasSubstr("meet at")));
  EXPECT_THAT(mistakes_in(shaped("{outline: [{line: {from: [0, 0], to: [3, 0]}}, {line: {to: [3, 1]}},"
                                 " {arc: {to: [2, 2], centre: [2, 1]}}, {line: {to: [0, 2]}}, {line: {to: [0, 0]}}]}")),
              IsEmpty());
}

TEST(Visibility, OriginSeesAStar) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Outline outline = star(8, seed, 0.3);
    EXPECT_THAT(unseen_edges(outline, Vec2::Zero()), IsEmpty()) << seed;
    const auto point = seeing_point(outline);
    ASSERT_TRUE(point) << seed;
    EXPECT_THAT(unseen_edges(outline, *point), IsEmpty()) << seed;
  }
}

TEST(Visibility, GrazingIsNotSeen) {
  const Outline step = polygon({{0, 0}, {6, 0}, {6, 1}, {3, 1}, {3, 3}, {0, 3}});
  EXPECT_THAT(unseen_edges(step, {1.5, 0.5}), IsEmpty());
  EXPECT_THAT(unseen_edges(step, {3.0, 0.5}), testing::ElementsAre(3));  // in the line of edge 3
  EXPECT_THAT(unseen_edges(step, {3.0 - 1e-7, 0.5}), testing::ElementsAre(3));
  EXPECT_THAT(unseen_edges(step, {4.0, 2.0}), testing::ElementsAre(2, 3));
}

TEST(Visibility, ArcsAreSeenExactly) {
  // A shallow round notch with the tangents y = 1 + x and y = 1 - x at its ends: below both it is seen.
  const Outline outline = outline_of(
      "{outline: [{line: {from: [-2, 0], to: [2, 0]}}, {line: {to: [2, 2]}}, {line: {to: [1, 2]}},"
      " {arc: {to: [-1, 2], centre: [0, 3], direction: clockwise}}, {line: {to: [-2, 2]}}, {line: {to: [-2, "
      "0]}}]}",
      "{size: 0.5, centre: [0, 0.4]}");
  EXPECT_THAT(unseen_edges(outline, {0.599, 0.4}), IsEmpty());
  EXPECT_THAT(unseen_edges(outline, {0.601, 0.4}), testing::ElementsAre(3));
  EXPECT_THAT(unseen_edges(outline, {-0.601, 0.4}), testing::ElementsAre(3));
  EXPECT_THAT(unseen_edges(outline, {0.0, 1.001}), testing::ElementsAre(3));
}

TEST(Visibility, TheMiddleOfAnArcMayBeUnseenWhereItsEndsAreSeen) {
  // A flat-topped lens whose lower arc bulges out less than its upper: seen from inside, not from below.
  const Outline lens = outline_of(
      "{outline: [{arc: {from: [-1, 0], to: [1, 0], centre: [0, 1], direction: counter_clockwise}},"
      " {arc: {to: [-1, 0], centre: [0, -1]}}]}");
  EXPECT_THAT(unseen_edges(lens, {0.0, 0.0}), IsEmpty());
  EXPECT_THAT(unseen_edges(lens, {0.0, std::sqrt(2.0) - 1.0}), testing::ElementsAre(1));
}

TEST(Visibility, NoPointSeesAU) {
  const Outline u = polygon({{0, 0}, {10, 0}, {10, 5}, {8, 5}, {8, 2}, {2, 2}, {2, 5}, {0, 5}});
  EXPECT_FALSE(seeing_point(u));
}

TEST(Visibility, SuggestedCentreIsAccepted) {
  const std::string shape = "{polygon: {vertices: [[0, 0], [6, 0], [6, 1], [3, 1], [3, 3], [0, 3]]}}";
  EXPECT_THAT(mistakes_in(shaped(shape, "{size: 0.5, centre: [4, 0.5]}")), HasSubstr("use mesh.centre: [1.5, 0.5]"));
  EXPECT_THAT(mistakes_in(shaped(shape, "{size: 0.5, centre: [1.5, 0.5]}")), IsEmpty());
  const auto body = parse(shaped(shape)).bodies.front();  // taken without being told
  EXPECT_EQ(body.mesh.kind, model::MeshKind::superelement);
  EXPECT_LT((body.mesh.centre - Vec2(1.5, 0.5)).norm(), 1e-9);
}

TEST(Inside, ConcaveOutline) {
  const Outline u = polygon({{0, 0}, {10, 0}, {10, 5}, {8, 5}, {8, 2}, {2, 2}, {2, 5}, {0, 5}});
  EXPECT_TRUE(encloses(u, {1, 4}));
  EXPECT_FALSE(encloses(u, {5, 4}));
  EXPECT_FALSE(encloses(u, {11, 1}));
}

}  // namespace
}  // namespace scabo::geometry
