// An elastic edge against a rigid one: nodes and their feet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::elastic;
using test::line;
using test::message_of;
using test::pair_of;
using test::pi;
using test::polar;
using test::rectangle;
using test::rigid;
using test::Similarity;
using test::swapped;
using testing::HasSubstr;

Interface match_rigid(const model::Model& model) { return make_mesh(model).interfaces.at(0); }

/// A rigid punch of width 1 over the middle of a block of width 4.
model::Model punch(double gap = 0.0) {
  return pair_of(elastic("block", rectangle({-2, -2}, {4, 2}), 0.25), "top",
                 rigid("punch", rectangle({-0.5, gap}, {1, 1})), "bottom");
}

/// A whole rigid cylinder (two arcs) above the block, lowest at (0, gap).
model::Model cylinder(double radius, double gap) {
  const Vec2 centre(0, radius + gap);
  return pair_of(
      elastic("block", rectangle({-2, -2}, {4, 2}), 0.25), "top",
      rigid("roll", test::outline({arc("lower", centre, radius, pi, pi), arc("upper", centre, radius, 0, pi)})),
      "lower");
}

TEST(RigidInterface, PairsOnlyNodesUnderAFlatPunch) {
  const Interface joint = match_rigid(punch(0.1));
  ASSERT_EQ(joint.pairs.size(), 9u);  // -0.5 ... 0.5, ends included
  for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
    const ContactPair& pair = joint.pairs[k];
    EXPECT_GE(pair.node_a, 0);
    EXPECT_EQ(pair.node_b, -1);
    EXPECT_NEAR(pair.point_a.x(), -0.5 + 0.125 * static_cast<double>(k), 1e-14);
    EXPECT_LT((pair.point_b - pair.point_a - Vec2(0, 0.1)).norm(), 1e-14);
    EXPECT_LT((pair.normal - Vec2(0, 1)).norm(), 1e-15);
    EXPECT_NEAR(pair.gap, 0.1, 1e-15);
  }
}

/// x of the pairs under a punch from `left` to `right`.
std::vector<double> under_punch(double left, double right, bool swap = false) {
  model::Model model = punch();
  model.bodies[1].outline = rectangle({left, 0}, {right - left, 1});
  const Interface joint = match_rigid(swap ? swapped(model) : model);
  std::vector<double> x;
  for (const ContactPair& pair : joint.pairs) x.push_back(pair.point_a.x());
  return x;
}

TEST(RigidInterface, DividesElementsAtTheEndsOfThePunch) {
  const double tolerance = 1e-14;
  using testing::DoubleNear;
  using testing::ElementsAre;
  const auto near = [&](double x) { return DoubleNear(x, tolerance); };
  for (const bool swap : {false, true}) {
    EXPECT_THAT(under_punch(-0.4, 0.4, swap), ElementsAre(near(-0.4), near(-0.325), near(-0.25), near(-0.125),
                                                          near(0.0), near(0.125), near(0.25), near(0.325), near(0.4)));
    // A middle node is not an end of an element; both ends are in one element; a node nearer than a tenth moves.
    EXPECT_THAT(under_punch(0.0, 0.125, swap), ElementsAre(near(0.0), near(0.0625), near(0.125)));
    EXPECT_THAT(under_punch(0.01, 0.03, swap), ElementsAre(near(0.01), near(0.02), near(0.03)));
    EXPECT_THAT(under_punch(-0.01, 0.24, swap), ElementsAre(near(-0.01), near(0.115), near(0.24)));
  }
}

TEST(RigidInterface, SwapsToTheOppositeNormal) {
  for (const model::Model& model : {punch(0.1), punch(-0.1), cylinder(3, 0.2), cylinder(3, -0.2),
                                    Similarity{37 * pi / 180, 1000.0, {5, 6}}(cylinder(3, 0.2))}) {
    const Interface a = match_rigid(model);
    const Interface b = match_rigid(swapped(model));
    ASSERT_EQ(a.pairs.size(), b.pairs.size());
    for (std::size_t k = 0; k < a.pairs.size(); ++k) {
      EXPECT_EQ(a.pairs[k].node_a, b.pairs[k].node_b);
      EXPECT_EQ(b.pairs[k].node_a, -1);
      EXPECT_EQ(a.pairs[k].point_b, b.pairs[k].point_a);
      EXPECT_EQ(a.pairs[k].normal, Vec2(-b.pairs[k].normal));
      EXPECT_EQ(a.pairs[k].gap, b.pairs[k].gap);
    }
  }
}

TEST(RigidInterface, MeasuresTheGapToACylinderRadially) {
  for (const double gap : {0.3, 0.0, -0.1}) {
    const double radius = 5.0;
    const Vec2 centre(0, radius + gap);
    const Interface joint = match_rigid(cylinder(radius, gap));
    ASSERT_EQ(joint.pairs.size(), 33u);
    for (const ContactPair& pair : joint.pairs) {
      EXPECT_NEAR(pair.gap, (pair.point_a - centre).norm() - radius, 2e-14);
      EXPECT_NEAR((pair.point_b - centre).norm(), radius, 2e-14);
      EXPECT_LT((pair.normal - (centre - pair.point_a).normalized()).norm(), 1e-14);
    }
    EXPECT_NEAR(joint.pairs[16].gap, gap, 1e-14);
    EXPECT_EQ(joint.pairs[16].gap < 0, gap < 0);
  }
}

TEST(RigidInterface, IsTheSameTurnedAndInOtherUnits) {
  for (const model::Model& model : {punch(0.0), punch(0.1), punch(-0.1), cylinder(5, 0.0), cylinder(1, -0.1)}) {
    const Interface a = match_rigid(model);
    for (const double scale : {1e-6, 1.0, 1e3}) {
      const Similarity turn{37 * pi / 180, scale, scale * Vec2(100, -20)};
      const Interface b = match_rigid(turn(model));
      ASSERT_EQ(a.pairs.size(), b.pairs.size());
      for (std::size_t k = 0; k < a.pairs.size(); ++k) {
        EXPECT_EQ(a.pairs[k].node_a, b.pairs[k].node_a);
        EXPECT_LT((turn.turn(a.pairs[k].normal) - b.pairs[k].normal).norm(), 1e-12);
        EXPECT_NEAR(a.pairs[k].gap * scale, b.pairs[k].gap, 1e-12 * scale);
      }
    }
  }
}

TEST(RigidInterface, TakesAHalfDiscOnAFloor) {
  const Vec2 centre(0, 5);
  const model::Model model = pair_of(
      rigid("floor", rectangle({-10, -1}, {20, 1})), "top",
      elastic("disc", test::outline({arc("rim", centre, 5, pi, pi), line("diameter", {5, 5}, {-5, 5})}), 0.2), "rim");
  model::Model lifted = model;
  lifted.bodies[1].mesh.centre = {0, 3};
  const Interface joint = match_rigid(lifted);
  EXPECT_GT(joint.pairs.size(), 140u);
  for (const ContactPair& pair : joint.pairs) {
    EXPECT_EQ(pair.node_a, -1);
    EXPECT_EQ(pair.normal, Vec2(0, 1));
    EXPECT_NEAR(pair.gap, pair.point_b.y(), 1e-14);
  }
}

TEST(RigidInterface, PairsTheLowerPartOfAWholeCircleInOneRun) {
  model::Model model = pair_of(rigid("floor", rectangle({-10, -1}, {20, 1})), "top",
                               elastic("disc", test::outline({arc("rim", {0, 5}, 5, -1.7, 2 * pi)}), 0.2), "rim");
  model.bodies[1].mesh.centre = {0, 5};
  const Interface joint = match_rigid(model);
  for (std::size_t k = 1; k < joint.pairs.size(); ++k) {
    EXPECT_LT(joint.pairs[k - 1].point_b.x(), joint.pairs[k].point_b.x());
  }
}

TEST(RigidInterface, HoldsInAConcaveRigidSeat) {
  // A rigid block with a round seat (radius 1.05, run clockwise) under an elastic disc of radius 1.
  const double seat = 1.05;
  const double half = 0.8;
  const Vec2 centre(0, 1);
  const Vec2 left = polar(centre, seat, -pi / 2 - half);
  const Vec2 right = polar(centre, seat, -pi / 2 + half);
  const model::Model model = pair_of(
      rigid("seat",
            test::outline({line("bottom", {-1, -1}, {1, -1}), line("right", {1, -1}, right),
                           arc("round", centre, seat, -pi / 2 + half, -2 * half), line("left", left, {-1, -1})})),
      "round",
      elastic("disc", test::outline({arc("rim", centre, 1.0, -pi, pi), line("diameter", {1, 1}, {-1, 1})}), 0.1),
      "rim");
  model::Model lowered = model;
  lowered.bodies[1].mesh.centre = {0, 0.6};
  const Interface joint = match_rigid(lowered);
  EXPECT_GT(joint.pairs.size(), 30u);
  for (const ContactPair& pair : joint.pairs) {
    EXPECT_NEAR(pair.gap, 0.05, 1e-14);
    EXPECT_LT((pair.normal - (centre - pair.point_a).normalized()).norm(), 1e-14);
  }
}

TEST(RigidInterface, CountsNodesWithinRoundingOfTheEndAsOnTheEdge) {
  for (const double beyond : {1e-10, 1e-7}) EXPECT_EQ(under_punch(-0.5 + beyond, 0.5 - beyond).front(), -0.5);
  EXPECT_NEAR(under_punch(-0.5 + 1e-5, 0.5 - 1e-5).front(), -0.5 + 1e-5, 1e-14);
  for (const double beyond : {1e-10, 1e-7, 1e-5}) EXPECT_EQ(under_punch(-0.5 + beyond, 0.5 - beyond).size(), 9u);
}

TEST(RigidInterfaceMistake, NothingAboveOrBelow) {
  model::Model model = punch();
  model.bodies[1].outline = rectangle({3, 0}, {1, 1});
  EXPECT_EQ(message_of(model),
            "model.yaml:24:3: contacts.joint: block.top and punch.bottom are nowhere opposite each other: move a body, "
            "or name other edges");
  model.bodies[1].outline = rectangle({0.01, 0}, {0.02, 1});  // between two nodes: the element is divided
  EXPECT_EQ(message_of(swapped(model)), "no error");
}

// Bodies side by side that have only a corner in common share no length: elastic ones are refused with the same words.
TEST(RigidInterfaceMistake, ACornerOnly) {
  for (const double x : {-3.0, 2.0}) {  // the block is on [-2, 2]
    for (const double beyond : {0.0, 1e-9, -1e-9}) {
      model::Model model = punch();
      model.bodies[1].outline = rectangle({x + beyond, 0}, {1, 1});
      EXPECT_THAT(message_of(model), HasSubstr("block.top and punch.bottom are nowhere opposite each other")) << x;
      EXPECT_THAT(message_of(swapped(model)), HasSubstr("are nowhere opposite each other")) << x;
    }
  }
}

TEST(RigidInterfaceMistake, TheWrongEdgeOfThePunch) {
  model::Model model = punch();
  model.contacts[0].b = test::edge_of(model, "punch", "top");
  EXPECT_THAT(message_of(model), HasSubstr("block.top and punch.top do not face each other"));
  model.contacts[0].a = test::edge_of(model, "block", "bottom");
  EXPECT_THAT(message_of(model), HasSubstr("face away from each other at a distance of 3"));
}

TEST(RigidInterface, TwoRigidBodiesHaveTheEndsOfTheirStretch) {
  for (const bool swap : {false, true}) {
    model::Model model = punch(0.1);
    model.bodies[0].rigid = true;
    const Interface joint = match_rigid(swap ? swapped(model) : model);
    ASSERT_EQ(joint.pairs.size(), 2u);
    const double sign = swap ? -1.0 : 1.0;
    for (std::size_t k = 0; k < 2; ++k) {
      const ContactPair& pair = joint.pairs[k];
      EXPECT_EQ(pair.node_a, -1);
      EXPECT_EQ(pair.node_b, -1);
      EXPECT_NEAR(pair.point_a.x(), k == 0 ? -0.5 : 0.5, 1e-14);
      EXPECT_LT((pair.normal - Vec2(0, sign)).norm(), 1e-15);
      EXPECT_NEAR(pair.gap, 0.1, 1e-15);
    }
  }
}

TEST(RigidInterfaceMistake, TwoRigidBodiesApart) {
  model::Model model = punch();
  model.bodies[0].rigid = true;
  model.bodies[1].outline = rectangle({3, 0}, {1, 1});
  EXPECT_THAT(message_of(model), HasSubstr("are nowhere opposite each other"));
}

}  // namespace
}  // namespace scabo::mesh
