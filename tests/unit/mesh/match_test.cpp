// Straight sides of contacts that do not match are divided until they do.
#include "scabo/mesh/plane/match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "matched_meshes.hpp"

namespace scabo::mesh {
namespace {

using test::area_of;
using test::blocks;
using test::breaks_of;
using test::edge_of;
using test::elastic;
using test::pair_of;
using test::pi;
using test::rectangle;
using test::Similarity;
using test::sound_mesh;
using test::swapped;
using test::x_of;
using testing::HasSubstr;

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance = 1e-13) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance) << k;
}

TEST(Matching, ThreeAgainstFourElements) {
  const Mesh mesh = sound_mesh(blocks(3, 4));
  expect_near(x_of(mesh.interfaces[0]), {0, 3, 4, 6, 8, 9, 12});
  expect_near(breaks_of(mesh.bodies[0], 2), {0, 3, 4, 6, 8, 9, 12});  // from the right
  expect_near(breaks_of(mesh.bodies[1], 0), {0, 3, 4, 6, 8, 9, 12});
  for (const ContactPair& pair : mesh.interfaces[0].pairs) EXPECT_EQ(pair.gap, 0.0);
  const Mesh quadratic = sound_mesh(blocks(3, 4, 2, 2));
  expect_near(x_of(quadratic.interfaces[0]), {0, 1.5, 3, 3.5, 4, 5, 6, 7, 8, 8.5, 9, 10.5, 12});
  EXPECT_EQ(quadratic.bodies[0].edges[1].size(), 1u);  // other edges stay as they are
  EXPECT_NEAR(area_of(quadratic.bodies[0]), 24.0, 1e-13);
}

TEST(Matching, TwentyAgainstTwentyNineElements) {
  // 12 |29 k - 20 j| / 580 is less than a tenth of 12 / 29 where |29 k - 20 j| = 1: k = 9, j = 13 and k = 11, j = 16.
  // These move to the middle; 19 + 28 - 2 points remain within the edge.
  const Mesh mesh = sound_mesh(blocks(20, 29));
  std::vector<double> expected{0.0, 12.0};
  for (int k = 1; k < 20; ++k)
    if (k != 9 && k != 11) expected.push_back(12.0 * k / 20);
  for (int j = 1; j < 29; ++j)
    if (j != 13 && j != 16) expected.push_back(12.0 * j / 29);
  expected.push_back(12.0 * 521 / 1160);
  expected.push_back(12.0 * 639 / 1160);
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(expected.size(), 47u);
  expect_near(x_of(mesh.interfaces[0]), expected);
  EXPECT_EQ(mesh.bodies[0].edges[2].size(), 46u);
  EXPECT_EQ(mesh.bodies[1].edges[0].size(), 46u);
}

TEST(Matching, RaisesTheLowerOrder) {
  for (const auto& [a, b] : {std::array{1, 3}, {3, 1}, {2, 5}, {1, 2}}) {
    const Mesh equal = sound_mesh(blocks(4, 4, a, b));
    EXPECT_EQ(equal.interfaces[0].pairs.size(), 4u * std::max(a, b) + 1u);
    EXPECT_EQ(equal.bodies[0].edges[1].front().nodes.size(), a + 1u);
    const Mesh unlike = sound_mesh(blocks(3, 4, a, b));
    EXPECT_EQ(unlike.interfaces[0].pairs.size(), 6u * std::max(a, b) + 1u);
  }
}

TEST(Matching, DividesWhereNodesCoincideButElementsDoNot) {
  // Two elements of order 1 have the nodes of one of order 2; all become elements of half the length and order 2.
  const std::vector<double> breaks{0, 1.5, 3, 4.5, 6, 7.5, 9, 10.5, 12};
  const model::Model coarse_below = blocks(4, 8, 2, 1), coarse_above = blocks(8, 4, 1, 2);
  for (const model::Model& model : {coarse_below, coarse_above, swapped(coarse_below), swapped(coarse_above)}) {
    const Mesh mesh = sound_mesh(model);
    ASSERT_EQ(mesh.interfaces[0].pairs.size(), 17u);
    expect_near(breaks_of(mesh.bodies[0], 2), breaks);
    expect_near(breaks_of(mesh.bodies[1], 0), breaks);
    for (const int body : {0, 1})
      for (const LineElement& element : mesh.bodies[body].edges[body == 0 ? 2 : 0]) EXPECT_EQ(element.nodes.size(), 3u);
  }
  // Elements of order 2 of half a length aside, and one that ends at the middle node of another.
  model::Model aside = pair_of(elastic("floor", rectangle({0, -1}, {6, 1}), 1.0, 2), "top",
                               elastic("block", rectangle({1.5, 0}, {3, 1}), 1.0, 2), "bottom");
  expect_near(breaks_of(sound_mesh(aside).bodies[1], 0), {0, 0.5, 1, 1.5, 2, 2.5, 3});
  aside.bodies[1] = elastic("block", rectangle({1, 0}, {2.5, 1}), 0.5, 1);
  expect_near(breaks_of(sound_mesh(aside).bodies[0], 2), {0, 1, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6});
}

TEST(Matching, KeepsWhatMatches) {
  // The left halves match; the right ones do not. Order 2: no node of the left halves moves, by not one bit.
  model::Model model = blocks(4, 4, 2, 2);
  const Mesh before = make_mesh(model);
  EXPECT_EQ(match_sides(model, before.bodies), std::nullopt);
  model.bodies.push_back(elastic("third", rectangle({12, 0}, {6, 2}), 1.7, 2));
  model.bodies.push_back(elastic("floor", rectangle({12, -2}, {6, 2}), 2.0, 2));
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].a = edge_of(model, "third", "bottom");
  model.contacts[1].b = edge_of(model, "floor", "top");
  const Mesh after = sound_mesh(model);
  for (const int b : {0, 1}) EXPECT_EQ(after.bodies[b].nodes, before.bodies[b].nodes);
  EXPECT_GT(after.interfaces[1].pairs.size(), 9u);
}

TEST(Matching, DividesOnlyWithinTheOverlap) {
  const auto model_at = [](double x) {
    return pair_of(elastic("floor", rectangle({0, -1}, {6, 1}), 0.5), "top",
                   elastic("block", rectangle({x, 0}, {1.5, 1}), 0.5), "bottom");
  };
  const Mesh mesh = sound_mesh(model_at(2.1));
  std::vector<double> x;
  for (std::size_t k = 0; k < mesh.interfaces[0].pairs.size(); k += 2)
    x.push_back(mesh.interfaces[0].pairs[k].point_a.x());
  expect_near(x, {2.1, 2.5, 2.6, 3.0, 3.1, 3.5, 3.6});
  EXPECT_EQ(mesh.bodies[0].edges[2].size(), 16u);
  EXPECT_EQ(mesh.bodies[1].edges[0].size(), 6u);
  // Nearer than a tenth of 0.5: points of the floor go to the ends of the block, those between to the middle.
  const Mesh near = sound_mesh(model_at(2.03));
  expect_near(breaks_of(near.bodies[0], 2),
              {0, 0.5, 1.0, 1.5, 2.0, 6 - 3.53, 6 - 3.015, 6 - 2.515, 6 - 2.03, 4.5, 5.0, 5.5, 6.0});
  expect_near(breaks_of(near.bodies[1], 0), {0, 0.485, 0.985, 1.5});
  EXPECT_EQ(near.interfaces[0].pairs.size(), 7u);
}

TEST(Matching, KeepsEndsThatNearlyCoincide) {
  // Corners do not move: 0 and 0.001 are two points, and so are 12 and 12.001, each within one of the edges.
  model::Model model = blocks(4, 4);
  model.bodies[1] = elastic("upper", rectangle({0.001, 0}, {12, 2}), 3.0, 1);
  const Mesh mesh = sound_mesh(model);
  expect_near(x_of(mesh.interfaces[0]), {0.001, 3.0005, 6.0005, 9.0005, 12});
  EXPECT_EQ(mesh.bodies[0].edges[2].size(), 5u);
}

TEST(Matching, OneEdgeAgainstTwoBodies) {
  model::Model model = pair_of(elastic("floor", rectangle({0, -1}, {6, 1}), 6.0 / 7, 1), "top",
                               elastic("left", rectangle({0, 0}, {3, 1}), 3.0 / 4, 1), "bottom");
  model.bodies.push_back(elastic("right", rectangle({3, 0}, {3, 1}), 3.0 / 5, 1));
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].a = edge_of(model, "right", "bottom");
  model.contacts[1].b = edge_of(model, "floor", "top");
  const Mesh mesh = sound_mesh(model);
  expect_near(x_of(mesh.interfaces[0]), {0, 0.75, 6.0 / 7, 1.5, 12.0 / 7, 2.25, 18.0 / 7, 3});
  expect_near(x_of(mesh.interfaces[1]), {3, 24.0 / 7, 3.6, 4.2, 30.0 / 7, 4.8, 36.0 / 7, 5.4, 6});
  EXPECT_EQ(mesh.bodies[0].edges[2].size(), 15u);
}

TEST(Matching, ThreeBodiesAtOnePlace) {
  // The floor faces `near` from 0 to 3 and `far` from 2 to 6: points of `far` reach `near` through the floor.
  model::Model model = pair_of(elastic("floor", rectangle({0, -1}, {6, 1}), 6.0 / 7, 1), "top",
                               elastic("near", rectangle({0, 0}, {3, 1}), 0.75, 1), "bottom");
  model.bodies.push_back(elastic("far", rectangle({2, 4}, {4, 1}), 0.8, 1));
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].b = edge_of(model, "far", "bottom");
  const Mesh mesh = sound_mesh(model);
  expect_near(x_of(mesh.interfaces[0]), {0, 0.75, 6.0 / 7, 1.5, 12.0 / 7, 2, 2.25, 18.0 / 7, 2.8, 3});
  const double joined = 0.5 * (36.0 / 7 + 5.2);
  expect_near(x_of(mesh.interfaces[1]), {2, 2.25, 18.0 / 7, 2.8, 3, 24.0 / 7, 3.6, 30.0 / 7, 4.4, joined, 6});
}

TEST(Matching, StackOfThree) {
  model::Model model = blocks(3, 4);
  model.bodies.push_back(elastic("third", rectangle({0, 2}, {12, 2}), 12.0 / 5, 1));
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].a = edge_of(model, "upper", "top");
  model.contacts[1].b = edge_of(model, "third", "bottom");
  const Mesh mesh = sound_mesh(model);
  expect_near(x_of(mesh.interfaces[0]), {0, 3, 4, 6, 8, 9, 12});
  expect_near(x_of(mesh.interfaces[1]), {0, 2.4, 3, 4.8, 6, 7.2, 9, 9.6, 12});
}

TEST(Matching, NothingDependsOnPlaceUnitsOrSides) {
  // 1/10 - 1/11 is exactly a tenth of 1/11: rounding may not decide whether these points become opposite each other.
  const std::vector<std::pair<model::Model, std::size_t>> models{{blocks(7, 9, 2, 3, 0.0), 46},
                                                                 {blocks(7, 9, 2, 3, 0.01), 46},
                                                                 {blocks(7, 9, 2, 3, -0.01), 46},
                                                                 {blocks(10, 11, 2, 2, 0.0), 41}};
  for (const auto& [model, pairs] : models) {
    const Mesh mesh = sound_mesh(model);
    EXPECT_EQ(mesh.interfaces[0].pairs.size(), pairs);
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const Similarity turn{37 * pi / 180, scale, {2 * scale, -scale}};
      const Mesh turned = sound_mesh(turn(model));
      for (std::size_t b = 0; b < 2; ++b) {
        ASSERT_EQ(turned.bodies[b].nodes.size(), mesh.bodies[b].nodes.size());
        for (std::size_t i = 0; i < mesh.bodies[b].nodes.size(); ++i)
          EXPECT_LT((turned.bodies[b].nodes[i] - turn(mesh.bodies[b].nodes[i])).norm(), 1e-13 * scale * 12);
      }
    }
    const Mesh other = sound_mesh(swapped(model));
    for (std::size_t b = 0; b < 2; ++b) EXPECT_EQ(other.bodies[b].nodes, mesh.bodies[b].nodes);
    ASSERT_EQ(other.interfaces[0].pairs.size(), mesh.interfaces[0].pairs.size());
    for (std::size_t k = 0; k < mesh.interfaces[0].pairs.size(); ++k) {
      EXPECT_EQ(other.interfaces[0].pairs[k].node_a, mesh.interfaces[0].pairs[k].node_b);
      EXPECT_EQ(other.interfaces[0].pairs[k].gap, mesh.interfaces[0].pairs[k].gap);
    }
  }
}

TEST(Matching, LeavesNodesOfSupportsInPlace) {
  // Points of the sides are 0.05 and 0.1 apart. Those of the lower one stay where a support is.
  model::Model model = blocks(12, 12);
  model.bodies[1] = elastic("upper", rectangle({0.05, 0}, {12, 2}), 1.0, 1);
  model::Support support;
  support.on.kind = model::Place::Kind::near;
  support.on.body = 0;
  support.on.near = {5.01, 0.0};
  model.supports = {support};
  const std::vector<double> x = x_of(sound_mesh(model).interfaces[0]);
  EXPECT_THAT(x, testing::Contains(testing::DoubleNear(5.0, 1e-13)));
  EXPECT_THAT(x, testing::Contains(testing::DoubleNear(6.025, 1e-13)));
}

TEST(Matching, LeavesBodiesThatAreRefinedAlone) {
  model::Model model = blocks(3, 4);
  for (model::Body& body : model.bodies) body.mesh.tolerance = 0.01;
  EXPECT_THAT(test::message_of(model), HasSubstr("the nodes of lower.top and upper.bottom do not match"));
}

TEST(Matching, ManyElements) {
  const Mesh mesh = make_mesh(blocks(7001, 9001, 2, 2));
  EXPECT_GT(mesh.interfaces[0].pairs.size(), 20000u);
}

}  // namespace
}  // namespace scabo::mesh
