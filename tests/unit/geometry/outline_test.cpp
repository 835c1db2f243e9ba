// Outlines: names, sense of rotation, arcs, area and centroid.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/input/models.hpp"

namespace scabo::geometry {
namespace {

using namespace input::testing_models;
using std::numbers::pi;

Edge quarter(double radius, const Vec2& centre, double start_angle, double sweep) {
  Edge edge;
  edge.arc = Arc{centre, radius, start_angle, sweep};
  edge.start = centre + radius * Vec2(std::cos(start_angle), std::sin(start_angle));
  edge.end = centre + radius * Vec2(std::cos(start_angle + sweep), std::sin(start_angle + sweep));
  return edge;
}

TEST(Edge, RunsAlongItsLine) {
  Edge edge;
  edge.start = {1.0, 2.0};
  edge.end = {4.0, 6.0};
  EXPECT_DOUBLE_EQ(edge.length(), 5.0);
  EXPECT_EQ(edge.at(0.0), edge.start);
  EXPECT_EQ(edge.at(1.0), edge.end);
  EXPECT_TRUE(edge.at(0.5).isApprox(Vec2(2.5, 4.0)));
}

TEST(Edge, RunsAlongItsArc) {
  const Edge edge = quarter(2.0, {1.0, 1.0}, 0.0, -pi / 2.0);
  EXPECT_DOUBLE_EQ(edge.length(), pi);
  EXPECT_EQ(edge.at(0.0), edge.start);
  EXPECT_EQ(edge.at(1.0), edge.end);
  EXPECT_TRUE(edge.at(0.5).isApprox(Vec2(1.0 + std::sqrt(2.0), 1.0 - std::sqrt(2.0))));
}

TEST(Outline, RectangleHasItsNames) {
  const Outline outline = parse(block()).bodies.front().outline;
  EXPECT_TRUE(outline.rectangle);
  ASSERT_EQ(outline.edges.size(), 4u);
  EXPECT_EQ(outline.edges[0].names.front(), "bottom");
  EXPECT_EQ(outline.edges[1].names.front(), "right");
  EXPECT_EQ(outline.edges[2].names.front(), "top");
  EXPECT_EQ(outline.edges[3].names.front(), "left");
  EXPECT_EQ(outline.corners[0].names.front(), "bottom_left");
  EXPECT_EQ(outline.corners[2].names.front(), "top_right");
  EXPECT_EQ(outline.corners[2].position, Vec2(2.0, 1.0));
  EXPECT_DOUBLE_EQ(outline.area(), 2.0);
  EXPECT_TRUE(outline.centroid().isApprox(Vec2(1.0, 0.5)));
}

TEST(Outline, EveryEdgeStartsWhereTheOneBeforeEnds) {
  const Outline outline = outline_of("{polygon: {vertices: [[0, 0], [0, 3], [4, 3], [4, 0]]}}");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(outline.edges[i].end, outline.edges[(i + 1) % 4].start);
    EXPECT_EQ(outline.edges[i].start, outline.corners[i].position);
  }
}

TEST(Outline, ClockwisePolygonIsTurnedAndKeepsItsNames) {
  const Outline outline =
      outline_of("{polygon: {vertices: [[0, 0], [0, 3], [4, 3], [5, 0]], names: {crest: edge_2, toe: vertex_4}}}");
  EXPECT_GT(outline.area(), 0.0);
  for (const Edge& edge : outline.edges) {
    if (edge.names.front() == "edge_1") {
      EXPECT_EQ(edge.start, Vec2(0.0, 3.0));
      EXPECT_EQ(edge.end, Vec2(0.0, 0.0));
    }
    if (edge.names.front() == "edge_2") {
      ASSERT_EQ(edge.names.size(), 2u);
      EXPECT_EQ(edge.names[1], "crest");
      EXPECT_EQ(edge.start, Vec2(4.0, 3.0));
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(outline.corners[i].position, outline.edges[i].start);
    if (outline.corners[i].names.front() == "vertex_4") {
      EXPECT_EQ(outline.corners[i].names.back(), "toe");
      EXPECT_EQ(outline.corners[i].position, Vec2(5.0, 0.0));
    }
  }
}

TEST(Outline, HalfDiscHasItsExactAreaAndCentroid) {
  const Outline outline =
      outline_of("{outline: [{line: {from: [-2, 1], to: [2, 1]}, name: base}, {arc: {to: [-2, 1], centre: [0, 1]}}]}");
  EXPECT_NEAR(outline.area(), 2.0 * pi, 1e-14);
  EXPECT_NEAR(outline.centroid().x(), 0.0, 1e-14);
  EXPECT_NEAR(outline.centroid().y(), 1.0 + 8.0 / (3.0 * pi), 1e-14);  // 4 R / (3 pi)
  EXPECT_EQ(outline.edges[0].names[1], "base");
}

TEST(Outline, CircleOfTwoArcs) {
  const Outline outline =
      outline_of("{outline: [{arc: {from: [4, 2], to: [2, 2], centre: [3, 2]}}, {arc: {to: [4, 2], centre: [3, 2]}}]}");
  EXPECT_NEAR(outline.area(), pi, 1e-14);
  EXPECT_TRUE(outline.centroid().isApprox(Vec2(3.0, 2.0), 1e-14));
}

TEST(Outline, ArcOfMoreThanHalfACircle) {
  // Three quarters of a unit disc: the sector from 45 to 315 degrees and the triangle of its chord and
  // centre.
  const double h = std::sqrt(0.5);
  const std::string corner = "[0.7071067811865476, 0.7071067811865476]";
  const std::string other = "[0.7071067811865476, -0.7071067811865476]";
  const Outline outline = outline_of("{outline: [{line: {from: " + other + ", to: " + corner +
                                     "}}, {arc: {to: " + other + ", centre: [0, 0]}}]}");
  EXPECT_NEAR(outline.area(), 0.75 * pi + h * h, 1e-14);
  EXPECT_NEAR(outline.edges[1].arc->sweep, 1.5 * pi, 1e-14);
}

TEST(Outline, ClockwiseArcCutsOut) {
  const Outline outline = outline_of(
      "{outline: [{line: {from: [-2, 0], to: [2, 0]}}, {line: {to: [2, 2]}}, {line: {to: [1, 2]}},"
      " {arc: {to: [-1, 2], centre: [0, 3], direction: clockwise}}, {line: {to: [-2, 2]}}, {line: {to: [-2, "
      "0]}}]}",
      "{size: 0.5, centre: [0, 0.4]}");
  EXPECT_NEAR(outline.area(), 8.0 - (0.5 * pi - 1.0), 1e-14);
  EXPECT_LT(outline.edges[3].arc->sweep, 0.0);
}

TEST(Outline, ClockwiseOutlineWithArcIsTurned) {
  const std::string forth =
      "{outline: [{line: {from: [0, 0], to: [2, 0]}}, {arc: {to: [0, 0], centre: [1, 0]}, name: crown}]}";
  const std::string back =
      "{outline: [{arc: {from: [0, 0], to: [2, 0], centre: [1, 0], direction: clockwise}, name: crown},"
      " {line: {to: [0, 0]}}]}";
  const Outline a = outline_of(forth);
  const Outline b = outline_of(back);
  EXPECT_NEAR(a.area(), b.area(), 1e-15);
  EXPECT_TRUE(a.centroid().isApprox(b.centroid(), 1e-14));
  for (const Outline& outline : {a, b}) {
    for (const Edge& edge : outline.edges) {
      if (!edge.arc) continue;
      EXPECT_EQ(edge.names[1], "crown");
      EXPECT_NEAR(edge.arc->sweep, pi, 1e-14);
      EXPECT_TRUE(edge.at(0.5).isApprox(Vec2(1.0, 1.0), 1e-14));
      EXPECT_TRUE(edge.at(1e-9).isApprox(edge.start, 1e-8) || edge.start.norm() < 1e-8);
    }
  }
}

TEST(Outline, CentroidKeepsItsDigitsFarFromTheOrigin) {
  const Outline outline =
      outline_of("{polygon: {vertices: [[1e6, 1e6], [1000003, 1e6], [1000003, 1000001], [1e6, 1000001]]}}");
  EXPECT_NEAR(outline.centroid().x(), 1000001.5, 1e-9);
  EXPECT_NEAR(outline.area(), 3.0, 1e-9);
}

}  // namespace
}  // namespace scabo::geometry
