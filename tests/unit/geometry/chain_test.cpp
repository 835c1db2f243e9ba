// Edges that are chains of straight lines, with numbers by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"

namespace scabo::geometry {
namespace {

Edge chain(std::vector<Vec2> points) {
  Edge edge;
  edge.names = {"chain"};
  edge.start = points.front();
  edge.end = points.back();
  edge.points.assign(points.begin() + 1, points.end() - 1);
  return edge;
}

/// A house: floor (0, 0)-(4, 0), walls of height 3, and the roof over (2, 4) as one chain with the right wall.
Outline house() {
  Outline outline;
  Edge floor, wall;
  floor.start = {0, 0}, floor.end = {4, 0}, floor.names = {"floor"};
  wall.start = {0, 3}, wall.end = {0, 0}, wall.names = {"wall"};
  outline.edges = {floor, chain({{4, 0}, {4, 3}, {2, 4}, {0, 3}}), wall};
  for (const Edge& edge : outline.edges) outline.corners.push_back({{"at_" + edge.names[0]}, edge.start});
  return outline;
}

/// 2 x 1 rectangle around the origin as one closed edge that starts in the middle of its bottom.
Outline closed() {
  Outline outline;
  outline.edges = {chain({{0, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}, {-1, -0.5}, {0, -0.5}})};
  outline.corners = {{{"vertex_1"}, {0, -0.5}}};
  return outline;
}

TEST(Chain, PointsLieAtFractionsOfItsLength) {
  const Edge edge = chain({{0, 0}, {3, 0}, {3, 1}, {7, 4}});  // 3 + 1 + 5
  EXPECT_EQ(edge.segments(), 3);
  EXPECT_DOUBLE_EQ(edge.length(), 9.0);
  EXPECT_EQ(edge.at(0.0), Vec2(0, 0));
  EXPECT_LT((edge.at(2.0 / 9.0) - Vec2(2, 0)).norm(), 1e-15);
  EXPECT_LT((edge.at(3.5 / 9.0) - Vec2(3, 0.5)).norm(), 1e-15);
  EXPECT_LT((edge.at(6.5 / 9.0) - Vec2(5, 2.5)).norm(), 1e-14);
  EXPECT_EQ(edge.at(1.0), Vec2(7, 4));
}

TEST(Chain, FootIsTheClosestPointAndRunsBeyondTheEnds) {
  const Edge edge = chain({{0, 0}, {3, 0}, {3, 1}, {7, 4}});
  const Foot below = foot_on(edge, {1, -2}).value();
  EXPECT_DOUBLE_EQ(below.t, 1.0 / 9.0);
  EXPECT_EQ(below.point, Vec2(1, 0));
  EXPECT_EQ(below.normal, Vec2(0, -1));  // material on the left
  const Foot before = foot_on(edge, {-4.5, 1}).value();
  EXPECT_DOUBLE_EQ(before.t, -0.5);
  EXPECT_EQ(before.point, Vec2(-4.5, 0));
  const Foot beyond = foot_on(edge, {11, 7}).value();  // (7, 4) + (4, 3), 5 beyond the end
  EXPECT_NEAR(beyond.t, 14.0 / 9.0, 1e-15);
  EXPECT_LT((beyond.normal - Vec2(0.6, -0.8)).norm(), 1e-15);
  const Foot corner = foot_on(edge, {4, -1}).value();  // nearest (3, 0), where the normals (0, -1) and (1, 0) meet
  EXPECT_DOUBLE_EQ(corner.t, 3.0 / 9.0);
  EXPECT_LT((corner.normal - Vec2(std::sqrt(0.5), -std::sqrt(0.5))).norm(), 1e-15);
}

TEST(Chain, DistancesAreThoseOfItsSegments) {
  const Edge edge = chain({{0, 0}, {3, 0}, {3, 1}, {7, 4}});
  EXPECT_DOUBLE_EQ(distance_to(edge, {1, 2}), 2.0);  // of the first segment, and of the second
  EXPECT_DOUBLE_EQ(distance_to(edge, {-3, 4}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to(edge, {10, 8}), 5.0);
  EXPECT_DOUBLE_EQ(closest_position(edge, {10, 8}), 1.0);
  EXPECT_DOUBLE_EQ(closest_position(edge, {3.5, 0.5}), 3.5 / 9.0);
}

TEST(Chain, EnclosesAreaAndCentroid) {
  const Outline outline = house();
  EXPECT_DOUBLE_EQ(outline.area(), 12.0 + 2.0);
  // Rectangle (2, 1.5) of 12 and gable (2, 3 + 1/3) of 2.
  EXPECT_LT((outline.centroid() - Vec2(2.0, (12.0 * 1.5 + 2.0 * (3.0 + 1.0 / 3.0)) / 14.0)).norm(), 1e-14);
  EXPECT_EQ(winding_number(outline, {2, 3.9}), 1);
  EXPECT_EQ(winding_number(outline, {1, 3.6}), 0);  // above the roof, which is at 3.5 there
  EXPECT_EQ(winding_number(outline, {1, 3.4}), 1);
  const Box box = box_of(outline);
  EXPECT_EQ(box.low, Vec2(0, 0));
  EXPECT_EQ(box.high, Vec2(4, 4));
  EXPECT_DOUBLE_EQ(distance_to(outline, {2, 5}), 1.0);
  EXPECT_FALSE(find_crossing(outline).has_value());
}

TEST(Chain, TurnsRound) {
  Outline outline = house();
  turn_round(outline);
  EXPECT_DOUBLE_EQ(outline.area(), -14.0);
  EXPECT_EQ(winding_number(outline, {2, 3.9}), -1);
  ASSERT_EQ(outline.edges[1].names.front(), "chain");
  EXPECT_EQ(outline.edges[1].start, Vec2(0, 3));
  EXPECT_EQ(outline.edges[1].points.front(), Vec2(2, 4));
  EXPECT_EQ(outline.corners[1].position, Vec2(0, 3));
}

TEST(Chain, MayBeClosed) {
  const Outline outline = closed();
  EXPECT_DOUBLE_EQ(outline.area(), 2.0);
  EXPECT_LT(outline.centroid().norm(), 1e-15);
  EXPECT_DOUBLE_EQ(outline.edges[0].length(), 6.0);
  EXPECT_TRUE(encloses(outline, {0.9, 0.4}));
  EXPECT_FALSE(encloses(outline, {1.1, 0.0}));
  EXPECT_EQ(outline.next(0), 0);
  // No line continues beyond the start of a closed chain: the foot of a point beside it lies on the chain.
  const Foot foot = foot_on(outline.edges[0], {-0.25, -1.0}).value();
  EXPECT_DOUBLE_EQ(foot.t, 5.75 / 6.0);
  EXPECT_EQ(foot.normal, Vec2(0, -1));
}

}  // namespace
}  // namespace scabo::geometry
