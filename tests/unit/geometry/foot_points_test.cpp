#include "scabo/geometry/plane/foot_points.hpp"

#include <gtest/gtest.h>

#include <random>

#include "scabo/mesh/plane/contact_side.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::line;
using test::pi;
using test::polar;

TEST(Foot, OnALineIsExactAndRunsBeyondItsEnds) {
  const model::Edge edge = line("bottom", {1, 1}, {5, 1});
  const geometry::Foot foot = geometry::foot_on(edge, {2, 7}).value();
  EXPECT_EQ(foot.t, 0.25);
  EXPECT_EQ(foot.point, Vec2(2, 1));
  EXPECT_EQ(foot.normal, Vec2(0, -1));  // material on the left
  EXPECT_EQ(geometry::foot_on(edge, {-3, 0})->t, -1.0);
  EXPECT_EQ(geometry::foot_on(edge, {9, 0})->t, 2.0);
}

TEST(Foot, OnAnArcIsRadialWithTheNormalOutOfTheMaterial) {
  for (const double sweep : {1.2, -1.2}) {
    for (const double start : {-3.0, 0.4, 3.1, 9.0}) {
      const model::Edge edge = arc("arc", {2, 3}, 1.5, start, sweep);
      for (const double t : {-0.5, -1e-12, 0.0, 0.3, 1.0, 1.2}) {
        for (const double radius : {0.2, 1.5, 4.0}) {
          const geometry::Foot foot = geometry::foot_on(edge, polar({2, 3}, radius, start + t * sweep)).value();
          EXPECT_NEAR(foot.t, t, 1e-14);
          EXPECT_LT((foot.point - polar({2, 3}, 1.5, start + t * sweep)).norm(), 2e-14);
          EXPECT_LT((foot.normal - polar({0, 0}, sweep > 0 ? 1.0 : -1.0, start + t * sweep)).norm(), 2e-14);
        }
      }
    }
  }
}

TEST(Foot, IsNothingAtTheCentreOfAnArc) {
  EXPECT_FALSE(geometry::foot_on(arc("arc", {2, 3}, 1.5, 0.0, 1.0), {2, 3}).has_value());
}

TEST(Encloses, TakesArcsExactly) {
  // A unit square with a round bulge on the right and a round bite in the top.
  const model::Outline shape = test::outline(
      {line("bottom", {0, 0}, {1, 0}), arc("bulge", {1, 0.5}, 0.5, -pi / 2, pi), line("top right", {1, 1}, {0.75, 1}),
       arc("bite", {0.5, 1}, 0.25, 0.0, -pi), line("top left", {0.25, 1}, {0, 1}), line("left", {0, 1}, {0, 0})});
  const auto inside = [](const Vec2& x) {
    const bool square = x.x() > 0 && x.x() < 1 && x.y() > 0 && x.y() < 1;
    const bool bulge = x.x() >= 1 && (x - Vec2(1, 0.5)).norm() < 0.5;
    return (square && (x - Vec2(0.5, 1)).norm() > 0.25) || bulge;
  };
  for (double x = -0.1013; x < 1.7; x += 0.0137) {
    for (double y = -0.1017; y < 1.2; y += 0.0139) {
      EXPECT_EQ(geometry::encloses(shape, {x, y}), inside({x, y})) << x << ' ' << y;
    }
  }
}

TEST(Encloses, CountsLoopsSoThatHolesAreOutside) {
  // A square with a square hole and a round one, which run clockwise; within the square hole lies an island.
  model::Outline shape = test::outline({line("bottom", {0, 0}, {4, 0}), line("right", {4, 0}, {4, 3}),
                                        line("top", {4, 3}, {0, 3}), line("left", {0, 3}, {0, 0})});
  const auto add = [&](const model::Outline& loop) {
    shape.edges.insert(shape.edges.end(), loop.edges.begin(), loop.edges.end());
  };
  add(test::outline({line("a", {0.5, 0.5}, {0.5, 2}), line("b", {0.5, 2}, {2, 2}), line("c", {2, 2}, {2, 0.5}),
                     line("d", {2, 0.5}, {0.5, 0.5})}));
  add(test::outline({arc("e", {3, 1}, 0.5, 0.0, -pi), arc("f", {3, 1}, 0.5, -pi, -pi)}));
  add(test::outline({line("g", {1, 1}, {1.5, 1}), line("h", {1.5, 1}, {1.5, 1.5}), line("i", {1.5, 1.5}, {1, 1})}));
  const auto within = [](const Vec2& x, double x0, double x1, double y0, double y1) {
    return x.x() > x0 && x.x() < x1 && x.y() > y0 && x.y() < y1;
  };
  for (double x = -0.1013; x < 4.2; x += 0.0337) {
    for (double y = -0.1021; y < 3.2; y += 0.0339) {
      const Vec2 at(x, y);
      const bool island = within(at, 1, 1.5, 1, 1.5) && x > y;
      const bool hole = within(at, 0.5, 2, 0.5, 2) || (at - Vec2(3, 1)).norm() < 0.5;
      const bool body = island || (within(at, 0, 4, 0, 3) && !hole);
      EXPECT_EQ(geometry::encloses(shape, at), body) << x << ' ' << y;
      EXPECT_EQ(geometry::winding_number(shape, at), body ? 1 : 0) << x << ' ' << y;
    }
  }
}

TEST(ClosestPoint, LiesOnTheEdge) {
  const model::Edge straight = line("line", {0, 0}, {4, 3});
  EXPECT_NEAR(geometry::closest_position(straight, {4, -3}), 0.28, 1e-15);  // (16 - 9) / 25
  EXPECT_NEAR(geometry::distance_to(straight, {8, 6}), 5.0, 1e-15);
  const model::Edge half = arc("half", {0, 0}, 1.0, pi, pi);  // from (-1, 0) below to (1, 0)
  EXPECT_NEAR(geometry::closest_position(half, {0, -3}), 0.5, 1e-15);
  EXPECT_EQ(geometry::closest_position(half, {3, 1}), 1.0);
  EXPECT_NEAR(geometry::distance_to(half, {0, 1}), std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(geometry::distance_to(half, {0, 0}), 1.0, 1e-15);
}

TEST(NearestPoint, IsTheNearestOfAll) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  for (const int count : {1, 2, 8, 9, 100, 1001}) {
    for (const bool curved : {false, true}) {
      std::vector<Vec2> points;
      for (int i = 0; i < count; ++i) {
        points.push_back(curved ? polar({0, 0}, 1.0, 6.0 * i / count) : Vec2(Vec2(1, 2) + Vec2(0.7, -0.4) * i / count));
      }
      const NearestPoint nearest(points);
      for (int k = 0; k < 200; ++k) {
        const Vec2 to(number(random), number(random));
        double shortest = 1e300;
        for (const Vec2& point : points) shortest = std::min(shortest, (point - to).norm());
        EXPECT_NEAR((points[nearest(to)] - to).norm(), shortest, 1e-14);
      }
    }
  }
}

}  // namespace
}  // namespace scabo::mesh
