// Which edges of different bodies lie on each other.
#include "scabo/geometry/plane/touching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scabo::geometry {
namespace {

Outline rectangle(const Vec2& a, const Vec2& size) {
  const Vec2 corners[] = {a, a + Vec2(size.x(), 0), a + size, a + Vec2(0, size.y())};
  Outline outline;
  for (int i = 0; i < 4; ++i) {
    Edge edge;
    edge.start = corners[i];
    edge.end = corners[(i + 1) % 4];
    outline.edges.push_back(edge);
  }
  return outline;
}

Outline circle(double radius, bool hollow) {
  Edge edge;
  edge.start = edge.end = Vec2(radius, 0);
  edge.arc = Arc{Vec2::Zero(), radius, 0.0, (hollow ? -2.0 : 2.0) * std::numbers::pi};
  Outline outline;
  outline.edges = {edge};
  return outline;
}

std::vector<TouchingEdges> touching(const std::vector<Outline>& outlines, double reach = 0.0) {
  std::vector<const Outline*> pointers;
  for (const Outline& outline : outlines) pointers.push_back(&outline);
  return touching_edges(pointers, reach);
}

TEST(TouchingEdges, FourSquaresHaveFourJoints) {
  std::vector<Outline> squares;
  for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}) squares.push_back(rectangle(at, {1, 1}));
  const auto found = touching(squares);  // those that meet in the corner only do not count
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].body_a, 0);
  EXPECT_EQ(found[0].body_b, 1);
  EXPECT_EQ(found[0].edge_a, 1);
  EXPECT_EQ(found[0].edge_b, 3);
}

TEST(TouchingEdges, ABlockOnTwoHasTwo) {
  EXPECT_EQ(touching({rectangle({0, 0}, {1, 1}), rectangle({1, 0}, {1, 1}), rectangle({0.5, 1}, {1, 1})}).size(), 3u);
}

TEST(TouchingEdges, AShortEdgeOnALongOneIsSeen) {
  EXPECT_EQ(touching({rectangle({-50, -1}, {100, 1}), rectangle({3.01, 0}, {0.01, 1})}).size(), 1u);
}

TEST(TouchingEdges, WithinReach) {
  const std::vector<Outline> apart{rectangle({0, 0}, {1, 1}), rectangle({0, 1.01}, {1, 1})};
  EXPECT_TRUE(touching(apart).empty());
  EXPECT_EQ(touching(apart, 0.02).size(), 1u);
  EXPECT_TRUE(touching({rectangle({0, 0}, {1, 1}), rectangle({1.01, 1.01}, {1, 1})}, 0.02).empty());
}

TEST(TouchingEdges, AShortPartIsSeenAndRoundingIsNot) {
  for (const double part : {0.5, 0.1, 0.03, 0.01, 2e-3})
    for (const double turned : {0.0, 1.0}) {
      const double x = turned == 0.0 ? 1.0 - part : part - 1.0;
      EXPECT_EQ(touching({rectangle({0, 0}, {1, 1}), rectangle({x, 1}, {1, 1})}).size(), 1u) << part << ' ' << turned;
    }
  EXPECT_TRUE(touching({rectangle({0, 0}, {1, 1}), rectangle({0.9995, 1}, {1, 1})}).empty());
}

TEST(TouchingEdges, RoundEdgesWithinReach) {
  for (const double turn : {0.0, 0.1, 0.2, 0.3, 1.0, 2.0}) {
    const Vec2 direction(std::cos(turn), std::sin(turn));
    Outline other = circle(1.0, false);
    other.edges[0].start += 2.005 * direction, other.edges[0].end += 2.005 * direction;
    other.edges[0].arc->centre += 2.005 * direction;
    EXPECT_EQ(touching({circle(1.0, false), other}, 0.01).size(), 1u) << turn;
    EXPECT_TRUE(touching({circle(1.0, false), other}, 0.004).empty()) << turn;
    EXPECT_TRUE(touching({circle(1.0, false), other}).empty()) << turn;
  }
  for (const double x : {-0.7, 0.0, 0.013, 0.4})
    EXPECT_EQ(touching({circle(1.0, false), rectangle({x - 1.0, -2.001}, {2, 1})}, 0.002).size(), 1u) << x;
}

TEST(TouchingEdges, ADiscInAHole) {
  EXPECT_EQ(touching({circle(1.0, true), circle(1.0, false)}).size(), 1u);
  EXPECT_TRUE(touching({circle(1.0, true), circle(0.9, false)}).empty());
  EXPECT_EQ(touching({circle(1.0, true), circle(0.9, false)}, 0.11).size(), 1u);
}

TEST(TouchingEdges, OfBodiesThatTakePart) {
  const Outline a = rectangle({0, 0}, {1, 1}), b = rectangle({1, 0}, {1, 1});
  EXPECT_TRUE(touching_edges({&a, nullptr}, 0.0).empty());
  EXPECT_EQ(touching_edges({&a, nullptr, &b}, 0.0).size(), 1u);
}

}  // namespace
}  // namespace scabo::geometry
