// Sides of contacts along arcs that do not match are divided until they do.
#include <gtest/gtest.h>

#include <algorithm>

#include "matched_meshes.hpp"
#include "scabo/mesh/plane/many_cells.hpp"
#include "scabo/mesh/plane/match.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::breaks_of;
using test::edge_of;
using test::elastic;
using test::line;
using test::pair_of;
using test::pi;
using test::polar;
using test::rectangle;
using test::Similarity;
using test::sound_mesh;
using test::swapped;

/// A sector of a disc, `angle` to both sides of its lowest point.
model::Body disc(const Vec2& centre, double radius, double angle, double size, int order) {
  const double low = -pi / 2;
  model::Body body = elastic("disc",
                             test::outline({arc("rim", centre, radius, low - angle, 2 * angle),
                                            line("right", polar(centre, radius, low + angle), centre),
                                            line("left", centre, polar(centre, radius, low - angle))}),
                             size, order);
  body.mesh.centre = centre - Vec2(0, 0.5 * radius);
  return body;
}

/// A block with a round seat, `angle` to both sides of its lowest point.
model::Body seat(const Vec2& centre, double radius, double angle, double size, int order) {
  const double low = -pi / 2, bottom = centre.y() - 2 * radius;
  const Vec2 left = polar(centre, radius, low - angle), right = polar(centre, radius, low + angle);
  model::Body body = elastic(
      "seat",
      test::outline({line("bottom", {left.x(), bottom}, {right.x(), bottom}), line("right", {right.x(), bottom}, right),
                     arc("inner", centre, radius, low + angle, -2 * angle), line("left", left, {left.x(), bottom})}),
      size, order);
  body.mesh.centre = centre - Vec2(0, 1.6 * radius);
  return body;
}

TEST(Matching, ConcentricArcsOfSevenAndTenElements) {
  // 6 and 9 points between the ends; 10 k = 7 j for none of them, and the nearest are 1/70 apart, 1/7 of an element.
  for (const int order : {1, 2, 3}) {
    for (const double gap : {0.0, 0.05, -1e-3}) {
      const double outer = 1.0 + gap;
      const model::Model model = pair_of(seat({0, 0}, outer, 0.7, 1.4 * outer / 7, order), "inner",
                                         disc({0, 0}, 1.0, 0.7, 1.4 / 10, order), "rim");
      const Mesh mesh = sound_mesh(model);
      const Interface& joint = mesh.interfaces[0];
      ASSERT_EQ(joint.pairs.size(), 16u * order + 1u) << order << ' ' << gap;
      for (const ContactPair& pair : joint.pairs) {
        EXPECT_NEAR(pair.point_a.norm(), outer, 1e-14);  // on the exact arcs
        EXPECT_NEAR(pair.point_b.norm(), 1.0, 1e-14);
        EXPECT_LT(std::abs(cross(pair.point_a, pair.point_b)), 1e-14);
        EXPECT_NEAR(pair.gap, gap, 3e-3 * std::abs(gap) + 1e-15);
      }
      EXPECT_EQ(sound_mesh(swapped(model)).bodies[1].nodes, mesh.bodies[1].nodes);
    }
  }
}

TEST(Matching, ADiscOnAPlane) {
  // Seen from the top of the disc, a point at the angle theta lies above x = 2 R tan(theta / 2).
  const double radius = 5.0;
  const model::Model model = pair_of(elastic("floor", rectangle({-2, -3}, {4, 3}), 0.3, 1), "top",
                                     disc({0, radius}, radius, 0.35, 0.2, 2), "rim");
  const Mesh mesh = sound_mesh(model);
  EXPECT_GT(mesh.interfaces[0].pairs.size(), 40u);
  for (const ContactPair& pair : mesh.interfaces[0].pairs) {
    const double theta = std::asin(pair.point_b.x() / radius);
    EXPECT_NEAR(pair.point_a.x(), 2 * radius * std::tan(0.5 * theta), 1e-12);
    // The common normal is the bisector; the gap along it.
    EXPECT_NEAR(pair.gap, 2 * radius * std::tan(0.5 * theta) * std::sin(0.5 * theta), 2e-3 * pair.gap + 1e-12);
  }
}

TEST(Matching, ArcsOfAllKinds) {
  // Two discs, a disc in a larger seat, discs on planes, with all divisions. Pairs reach at least to half of the radius
  // of the smaller disc on both sides.
  int cases = 0;
  for (const double size_a : {0.05, 0.11, 0.4})
    for (const double size_b : {0.07, 0.23})
      for (const int order : {1, 2, 4})
        for (const double gap : {0.0, 0.02, 0.5}) {
          const model::Body punch = disc({0, 1 + gap}, 1.0, 1.2, size_b, order);
          model::Model model = pair_of(elastic("floor", rectangle({-2, -1}, {4, 1}), size_a, 2), "top", punch, "rim");
          sound_mesh(model);
          model = pair_of(seat({0, 2}, 2.0, 0.8, size_a, 2), "inner", punch, "rim");
          sound_mesh(model);
          model.bodies[0] = disc({0, 2}, 2.0, 1.1, size_a, 2);
          model = Similarity{pi, 1.0, {0, 0}}(model);
          model.bodies[0].name = "base";
          model = pair_of(model.bodies[0], "rim", punch, "rim");
          const Interface joint = sound_mesh(model).interfaces[0];
          EXPECT_LT(joint.pairs.front().point_b.x(), -0.45);
          EXPECT_GT(joint.pairs.back().point_b.x(), 0.45);
          ++cases;
        }
  EXPECT_EQ(cases, 54);
}

TEST(Matching, AWholeCylinderInUnboundedGround) {
  for (const double clearance : {0.0, 0.01}) {
    const double outer = 1.0 + clearance;
    model::Model model = pair_of(
        elastic("cylinder", test::outline({arc("rim", {0, 0}, 1.0, 0.5, 2 * pi)}), 2 * pi / 10, 2), "rim",
        elastic("ground", test::outline({arc("hole", {0, 0}, outer, 0.7, -2 * pi)}), 2 * pi * outer / 13, 2), "hole");
    for (model::Body& body : model.bodies) body.mesh.centre = {0, 0};
    model.bodies[1].outside = true;
    const Mesh mesh = sound_mesh(model);
    // Starts at 0.5 and 0.7; elements of 36 and 27.7 degrees: 10 + 13 points, of which those nearer than 2.77 degrees
    // join.
    int joined = 0;
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 13; ++j) {
        const double apart = std::remainder(0.5 + 2 * pi * i / 10 - (0.7 - 2 * pi * j / 13), 2 * pi);
        joined += std::abs(apart) < 0.1 * 2 * pi / 13 ? 1 : 0;
      }
    EXPECT_GT(joined, 0);
    ASSERT_EQ(mesh.interfaces[0].pairs.size(), 2u * (23u - static_cast<unsigned>(joined)));
    for (const ContactPair& pair : mesh.interfaces[0].pairs) EXPECT_NEAR(pair.gap, clearance, 1e-4 * clearance + 1e-14);
    EXPECT_EQ(sound_mesh(swapped(model)).bodies[1].nodes, mesh.bodies[1].nodes);
  }
}

/// A half disc of radius r on a plane, both of squares: the row of nodes at a height of 3 r / 4 lies where the normals
/// of the sides have the angle at which sight ends, and is seen or not by rounding.
TEST(Match, NodesWhereSightEndsAreNotDoubled) {
  for (int k = 0; k < 100; ++k) {
    const double r = 0.05 * (1.0 + 0.37 * k), x = k % 3 == 0 ? 0.0 : 0.1 * k;
    model::Model model =
        pair_of(elastic("block", rectangle({x - 4.0 * r, -4.0 * r}, {8.0 * r, 4.0 * r}), r, 2), "top",
                elastic("roller", test::outline({line("top", {x + r, r}, {x - r, r}), arc("rim", {x, r}, r, pi, pi)}),
                        0.25 * r, 2),
                "rim");
    std::vector<BodyMesh> bodies;
    for (model::Body& body : model.bodies) {
      body.mesh.kind = model::MeshKind::quadtree;
      bodies.push_back(std::get<BodyMesh>(divide_into_cells(body, {}, 1e6)));
    }
    const auto matched = match_sides(model, bodies);
    ASSERT_TRUE(matched.has_value());
    for (std::size_t b = 0; b < 2; ++b) {
      const int edge = edge_of(model, b == 0 ? "block" : "roller", b == 0 ? "top" : "rim").index;
      const std::vector<double> breaks = breaks_of((*matched)[b], edge);
      for (std::size_t i = 1; i < breaks.size(); ++i)
        EXPECT_GT(breaks[i] - breaks[i - 1], 0.02 * r) << k << ", body " << b;
    }
  }
}

/// The forces on a disc that nothing but a plane holds must not turn it about the point that all rays have in common,
/// however its sides are divided: (0, 2 r).
TEST(Match, NormalsOfADiscOnAPlanePassThroughOnePoint) {
  const double r = 0.05;
  model::Model model = pair_of(
      elastic("block", rectangle({-4.0 * r, -4.0 * r}, {8.0 * r, 4.0 * r}), r, 2), "top",
      elastic("roller", test::outline({line("top", {r, r}, {-r, r}), arc("rim", {0, r}, r, pi, pi)}), 0.25 * r, 2),
      "rim");
  std::vector<BodyMesh> bodies;
  for (model::Body& body : model.bodies) {
    body.mesh.kind = model::MeshKind::quadtree;
    bodies.push_back(std::get<BodyMesh>(divide_into_cells(body, {}, 1e6)));
  }
  const auto matched = match_sides(model, bodies);
  ASSERT_TRUE(matched.has_value());
  const Interface joint = std::get<Interface>(match_interface(model, 0, *matched));
  ASSERT_GT(joint.pairs.size(), 20u);
  double longest = 0.0, shortest = 1.0;
  for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
    if (joint.pairs[k].point_b.y() < 0.4 * r)  // beyond 60 degrees partners need not lie on one ray
      for (const Vec2& x : {joint.pairs[k].point_a, joint.pairs[k].point_b})
        EXPECT_NEAR(cross(x - Vec2(0.0, 2.0 * r), joint.pairs[k].normal), 0.0, 1e-15) << k;
    if (k == 0) continue;
    const double step = joint.pairs[k].point_a.x() - joint.pairs[k - 1].point_a.x();
    longest = std::max(longest, step), shortest = std::min(shortest, step);
  }
  EXPECT_GT(longest, 2.0 * shortest);  // unequal elements
}

}  // namespace
}  // namespace scabo::mesh
