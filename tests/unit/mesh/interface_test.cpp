// Two straight or curved sides with matching nodes.
#include "scabo/mesh/plane/interface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models.hpp"
#include "scabo/mesh/plane/divide.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::elastic;
using test::line;
using test::message_of;
using test::message_unmatched;
using test::pair_of;
using test::pi;
using test::polar;
using test::rectangle;
using test::Similarity;
using test::swapped;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Interface match(const model::Model& model) { return make_mesh(model).interfaces.at(0); }

/// `lower.top` against `upper.bottom`, `gap` apart.
model::Model blocks(double gap = 0.0) {
  return pair_of(elastic("lower", rectangle({0, 0}, {6, 1.5}), 0.375), "top",
                 elastic("upper", rectangle({0, 1.5 + gap}, {6, 1.5}), 0.375), "bottom");
}

/// A sector of a disc, `angle` to both sides of its lowest point (0, 0).
model::Body disc(double radius, double angle, double size, int order = 2) {
  const Vec2 centre(0, radius);
  const double low = -pi / 2;
  model::Body body = elastic("disc",
                             test::outline({arc("rim", centre, radius, low - angle, 2 * angle),
                                            line("right", polar(centre, radius, low + angle), centre),
                                            line("left", centre, polar(centre, radius, low - angle))}),
                             size, order);
  body.mesh.centre = {0, 0.5 * radius};
  return body;
}

/// The mirror image of `disc` below y = 0.
model::Body lower_disc(double radius, double angle, double size, int order = 2) {
  const Vec2 centre(0, -radius);
  const double high = pi / 2;
  model::Body body = elastic("base",
                             test::outline({arc("rim", centre, radius, high - angle, 2 * angle),
                                            line("left", polar(centre, radius, high + angle), centre),
                                            line("right", centre, polar(centre, radius, high - angle))}),
                             size, order);
  body.mesh.centre = {0, -0.5 * radius};
  return body;
}

/// A block with a round seat, `angle` to both sides of its lowest point (0, middle - radius).
model::Body ring(double radius, double middle, double angle, double size, int order = 2) {
  const Vec2 centre(0, middle);
  const double low = -pi / 2;
  const Vec2 left = polar(centre, radius, low - angle);
  const Vec2 right = polar(centre, radius, low + angle);
  const double bottom = middle - 2 * radius;
  model::Body body = elastic(
      "ring",
      test::outline({line("bottom", {left.x(), bottom}, {right.x(), bottom}), line("right", {right.x(), bottom}, right),
                     arc("inner", centre, radius, low + angle, -2 * angle), line("left", left, {left.x(), bottom})}),
      size, order);
  body.mesh.centre = {0, middle - 1.6 * radius};
  return body;
}

void expect_same(const Interface& a, const Interface& b, const Similarity& move, double tolerance) {
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t k = 0; k < a.pairs.size(); ++k) {
    EXPECT_EQ(a.pairs[k].node_a, b.pairs[k].node_a);
    EXPECT_EQ(a.pairs[k].node_b, b.pairs[k].node_b);
    EXPECT_LT((move.turn(a.pairs[k].normal) - b.pairs[k].normal).norm(), 1e-9);
    EXPECT_NEAR(move.scale * a.pairs[k].gap, b.pairs[k].gap, tolerance * move.scale);
  }
}

void expect_exactly_swapped(const Interface& a, const Interface& b) {
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t k = 0; k < a.pairs.size(); ++k) {
    EXPECT_EQ(a.pairs[k].node_a, b.pairs[k].node_b);
    EXPECT_EQ(a.pairs[k].node_b, b.pairs[k].node_a);
    EXPECT_EQ(a.pairs[k].point_a, b.pairs[k].point_b);
    EXPECT_EQ(a.pairs[k].normal, Vec2(-b.pairs[k].normal));
    EXPECT_EQ(a.pairs[k].gap, b.pairs[k].gap);
  }
}

// ---- straight --------------------------------------------------------------------------------------------

TEST(MatchingInterface, PairsTheBeamsFromLeftToRight) {
  const Interface joint = match(blocks());
  ASSERT_EQ(joint.pairs.size(), 33u);
  EXPECT_EQ(joint.contact, 0);
  for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
    const ContactPair& pair = joint.pairs[k];
    EXPECT_NEAR(pair.point_a.x(), 0.1875 * static_cast<double>(k), 1e-14);
    EXPECT_LT((pair.point_a - pair.point_b).norm(), 1e-14);
    EXPECT_LT((pair.normal - Vec2(0, 1)).norm(), 1e-15);  // out of `lower`
    EXPECT_EQ(pair.gap, 0.0);
    EXPECT_EQ(pair.node_a, 72 - static_cast<int>(k));
    EXPECT_EQ(pair.node_b, static_cast<int>(k));
  }
}

TEST(MatchingInterface, AddsTheContactsGapToTheGeometricOne) {
  model::Model model = blocks(0.01);
  model.contacts[0].gap = -0.03;
  for (const ContactPair& pair : match(model).pairs) EXPECT_NEAR(pair.gap, -0.02, 1e-15);
}

TEST(MatchingInterface, TakesAnOverlapAsAnInterference) {
  for (const ContactPair& pair : match(blocks(-1e-3)).pairs) EXPECT_NEAR(pair.gap, -1e-3, 1e-15);
  for (const ContactPair& pair : match(blocks(-0.9)).pairs) EXPECT_NEAR(pair.gap, -0.9, 1e-14);
}

TEST(MatchingInterface, MatchesFacesThatAreFarApart) {
  const Interface joint = match(blocks(1000.0));
  EXPECT_EQ(joint.pairs.size(), 33u);
  for (const ContactPair& pair : joint.pairs) EXPECT_NEAR(pair.gap, 1000.0, 1e-9);
}

TEST(MatchingInterface, IsExactlyReversedWhenSidesAreSwapped) {
  const Similarity turn{37 * pi / 180, 1.0, {12, -5}};
  for (const model::Model& model : {blocks(), blocks(0.01), blocks(-0.01), turn(blocks(0.01)),
                                    pair_of(lower_disc(8, 0.5, 0.3), "rim", disc(8, 0.5, 0.3), "rim")}) {
    expect_exactly_swapped(match(model), match(swapped(model)));
  }
}

TEST(MatchingInterface, DoesNotDependOnPlaceDirectionOrUnits) {
  const std::vector<model::Model> models{blocks(), blocks(0.01), blocks(-0.01),
                                         pair_of(lower_disc(8, 0.5, 0.3), "rim", disc(8, 0.5, 0.3), "rim"),
                                         pair_of(ring(1.01, 1.0, 0.5, 0.0505), "inner", disc(1.0, 0.5, 0.05), "rim")};
  for (const model::Model& model : models) {
    const Interface joint = match(model);
    for (const double scale : {1e-9, 1e-3, 1.0, 1e3, 1e9}) {
      const Similarity units{0.0, scale, {0, 0}};
      expect_same(joint, match(units(model)), units, 1e-14);
      const Similarity turned{37 * pi / 180, scale, scale * Vec2(20, -300)};
      expect_same(joint, match(turned(model)), turned, 1e-12);
    }
  }
}

TEST(MatchingInterface, KeepsExactZeroGapsWhenTurned) {
  const Similarity turn{37 * pi / 180, 1000.0, {0, 0}};
  for (const ContactPair& pair : match(turn(blocks())).pairs) EXPECT_EQ(pair.gap, 0.0);
}

TEST(MatchingInterface, RunsUpwardsAlongAnUprightJoint) {
  const model::Model model = pair_of(elastic("left", rectangle({0, 0}, {1, 3}), 0.5), "right",
                                     elastic("right", rectangle({1, 0}, {1, 3}), 0.5), "left");
  const Interface joint = match(model);
  ASSERT_EQ(joint.pairs.size(), 13u);
  EXPECT_LT(joint.pairs.front().point_a.y(), joint.pairs.back().point_a.y());
  EXPECT_LT((joint.pairs[3].normal - Vec2(1, 0)).norm(), 1e-15);
  expect_exactly_swapped(joint, match(swapped(model)));
}

TEST(MatchingInterface, LeavesNodesOutsideTheOverlapAlone) {
  // Short on long, and two that overhang on either side; sizes equal, ends on nodes or on middle nodes.
  const model::Model short_on_long = pair_of(elastic("floor", rectangle({0, 0}, {6, 1}), 0.5), "top",
                                             elastic("block", rectangle({2, 1}, {1.5, 1}), 0.5), "bottom");
  const Interface joint = match(short_on_long);
  ASSERT_EQ(joint.pairs.size(), 7u);
  EXPECT_NEAR(joint.pairs.front().point_a.x(), 2.0, 1e-14);
  EXPECT_NEAR(joint.pairs.back().point_a.x(), 3.5, 1e-14);
  expect_exactly_swapped(joint, match(swapped(short_on_long)));

  const model::Model overhanging = pair_of(elastic("floor", rectangle({0, 0}, {6, 1}), 0.5), "top",
                                           elastic("block", rectangle({4.25, 1}, {6, 1}), 0.5), "bottom");
  EXPECT_EQ(match(overhanging).pairs.size(), 15u);  // elements of half the length from a middle node on: 4.25 ... 6
}

TEST(MatchingInterface, JoinsSuperElementAndGrid) {
  model::Model model = blocks();
  model.bodies[1].mesh.kind = model::MeshKind::fem;
  const Interface joint = match(model);
  EXPECT_EQ(joint.pairs.size(), 33u);
  for (const ContactPair& pair : joint.pairs) EXPECT_EQ(pair.gap, 0.0);
  expect_exactly_swapped(joint, match(swapped(model)));
}

TEST(MatchingInterface, MatchesHighOrderNodes) {
  for (const int order : {1, 3, 8, 16}) {
    model::Model model = blocks(0.02);
    for (model::Body& body : model.bodies) body.mesh.order = order;
    EXPECT_EQ(match(model).pairs.size(), 16u * order + 1u);
  }
}

TEST(MatchingInterface, PairsBodiesOfOneElement) {
  for (const auto& [order, gap] : {std::pair{1, 0.5}, {2, 0.5}, {1, -0.01}, {2, -0.01}}) {
    model::Model model = blocks(gap);
    for (model::Body& body : model.bodies) {
      body.mesh.size = 10.0;
      body.mesh.order = order;
    }
    EXPECT_EQ(match(model).pairs.size(), order + 1u);
  }
}

TEST(MatchingInterface, OpensLikeAWedge) {
  // The upper face turned by 5 degrees about the origin: the same nodes, opposite each other across the
  // bisector.
  model::Model model = blocks();
  model::Model upper = Similarity{0.0, 1.0, {0, -1.5}}(model);
  model.bodies[0] = upper.bodies[0];
  upper.bodies.erase(upper.bodies.begin());
  model.bodies[1] = Similarity{5 * pi / 180, 1.0, {0, 0}}(upper).bodies[0];
  const Interface joint = match(model);
  ASSERT_EQ(joint.pairs.size(), 33u);
  EXPECT_NEAR(joint.pairs[32].gap, 12 * std::sin(2.5 * pi / 180), 1e-12);
  EXPECT_LT((joint.pairs[32].normal - polar({0, 0}, 1, 92.5 * pi / 180)).norm(), 1e-12);
}

TEST(MatchingInterface, ThousandsOfNodes) {
  for (const double gap : {0.0, 5.0}) {
    model::Model model = blocks(gap);
    for (model::Body& body : model.bodies) body.mesh.size = 6.0 / 5000;
    EXPECT_EQ(match(model).pairs.size(), 10001u);
  }
}

// ---- curved ----------------------------------------------------------------------------------------------

TEST(CurvedInterface, PairsMirroredDiscsAlongTheVertical) {
  for (const int order : {1, 2, 4}) {
    const model::Model model = pair_of(lower_disc(8, 0.6, 0.25, order), "rim", disc(8, 0.6, 0.25, order), "rim");
    const Interface joint = match(model);
    ASSERT_EQ(joint.pairs.size(), 39u * order + 1u);
    for (const ContactPair& pair : joint.pairs) {
      const double theta = std::asin(pair.point_a.x() / 8);
      EXPECT_LT((pair.normal - Vec2(0, 1)).norm(), 1e-12);
      EXPECT_NEAR(pair.gap, 16 * (1 - std::cos(theta)), 1e-12);
    }
    expect_exactly_swapped(joint, match(swapped(model)));
  }
}

TEST(CurvedInterface, PairsHalfDiscsAsFarAsTheyFaceEachOther) {
  const Interface joint = match(pair_of(lower_disc(8, pi / 2, 0.2), "rim", disc(8, pi / 2, 0.2), "rim"));
  EXPECT_GT(joint.pairs.size(), 60u);
  for (const ContactPair& pair : joint.pairs) EXPECT_LT((pair.normal - Vec2(0, 1)).norm(), 1e-12);
}

TEST(CurvedInterface, MatchesDiscsThatOverlap) {
  model::Model model = pair_of(lower_disc(8, 0.6, 0.25), "rim", disc(8, 0.6, 0.25), "rim");
  model.bodies[1] = Similarity{0.0, 1.0, {0, -0.02}}(model).bodies[1];
  const Interface joint = match(model);
  ASSERT_EQ(joint.pairs.size(), 79u);
  EXPECT_NEAR(joint.pairs[39].gap, -0.02, 1e-12);
  EXPECT_GT(joint.pairs.front().gap, 1.0);
}

TEST(CurvedInterface, PairsADiscAndAPlaneDividedEqually) {
  // Arc length on the disc, x on the plane: 20 elements of 0.1 either way from the middle.
  const double radius = 50.0;
  for (const double apart : {0.0, 0.3}) {
    model::Model model =
        pair_of(elastic("floor", rectangle({-2, -3}, {4, 3}), 0.1), "top", disc(radius, 2 / radius, 0.1), "rim");
    model.bodies[1] = Similarity{0.0, 1.0, {0, apart}}(model).bodies[1];
    const Interface joint = match(model);
    ASSERT_EQ(joint.pairs.size(), 81u);
    EXPECT_NEAR(joint.pairs[40].gap, apart, 1e-12);
    for (const ContactPair& pair : joint.pairs) {
      const double x = pair.point_b.x();
      EXPECT_NEAR(pair.gap, apart + radius - std::sqrt(radius * radius - x * x), 5e-4 * (apart + 0.04));
    }
    expect_exactly_swapped(joint, match(swapped(model)));
  }
}

TEST(CurvedInterface, PairsOneCurvedElementAndAPlaneWithEqualX) {
  const double half = std::sin(0.2);
  model::Body floor = elastic("floor", rectangle({-half, -1}, {2 * half, 1}), 2 * half);
  const Interface joint = match(pair_of(floor, "top", disc(1.0, 0.2, 1.0), "rim"));
  ASSERT_EQ(joint.pairs.size(), 3u);
  EXPECT_EQ(joint.pairs[1].gap, 0.0);
  EXPECT_NEAR(joint.pairs[0].gap, 1 - std::cos(0.2), 1e-3 * (1 - std::cos(0.2)) + 2e-4);
}

TEST(CurvedInterface, PairsConcentricRingAndCylinderRadially) {
  for (const int order : {1, 2, 3}) {
    for (const double clearance : {0.0, 1e-3, 0.05, -1e-3}) {
      // The same angles: sizes in proportion to the radii.
      const double outer = 1.0 + clearance;
      const model::Model model =
          pair_of(ring(outer, 1.0, 0.7, 0.07 * outer, order), "inner", disc(1.0, 0.7, 0.07, order), "rim");
      const Interface joint = match(model);
      ASSERT_EQ(joint.pairs.size(), 20u * order + 1u) << order << ' ' << clearance;
      for (const ContactPair& pair : joint.pairs) EXPECT_NEAR(pair.gap, clearance, 3e-3 * std::abs(clearance) + 1e-15);
      expect_exactly_swapped(joint, match(swapped(model)));
    }
  }
}

TEST(CurvedInterface, PairsACylinderThatTouchesItsRingBelow) {
  // Clearance 0.001 of the radius, equal arc lengths from the lowest point: nodes are opposite but for
  // c s^3 / (6 R^3).
  const double clearance = 1e-3;
  const double outer = 1.0 + clearance;
  const model::Model model = pair_of(ring(outer, outer, 0.6 / outer, 0.03), "inner", disc(1.0, 0.6, 0.03), "rim");
  const Interface joint = match(model);
  ASSERT_EQ(joint.pairs.size(), 81u);
  EXPECT_EQ(joint.pairs[40].gap, 0.0);
  for (const ContactPair& pair : joint.pairs) {
    const double s = std::asin(pair.point_b.x());
    EXPECT_NEAR(pair.gap, clearance * (1 - std::cos(s)), 0.03 * clearance * (1 - std::cos(s)) + 1e-9);
  }
}

TEST(CurvedInterface, TransmitsAUniformPressureExactly) {
  // Nodal forces of a pressure are the integrals of N n; the normals must be along them.
  const Interface joint = match(pair_of(ring(1.0, 1.0, 0.7, 0.2), "inner", disc(1.0, 0.7, 0.2), "rim"));
  ASSERT_EQ(joint.pairs.size(), 15u);
  const auto point = [&](std::size_t k) { return joint.pairs[k].point_b; };
  for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
    Vec2 along = Vec2::Zero();  // Simpson's rule for the elements at the node; disc.rim runs with the pairs
    if (k % 2 == 1) along = point(k + 1) - point(k - 1);
    if (k % 2 == 0 && k > 0) along += 3 * point(k) - 4 * point(k - 1) + point(k - 2);
    if (k % 2 == 0 && k + 1 < joint.pairs.size()) along += -3 * point(k) + 4 * point(k + 1) - point(k + 2);
    EXPECT_LT((joint.pairs[k].normal + tangent_of(along).normalized()).norm(), 1e-12);
  }
}

TEST(CurvedInterface, ClosesAroundAWholeCylinder) {
  // Full circles: the edge is the whole boundary. The outer one, run clockwise, is the rim of a hole; as it
  // is no super-element of its own, it is divided by hand.
  for (const double clearance : {0.0, 0.01}) {
    const double outer = 1.0 + clearance;
    const model::Model model =
        pair_of(elastic("cylinder", test::outline({arc("rim", {0, 0}, 1.0, 0.5, 2 * pi)}), 0.3), "rim",
                elastic("plate", test::outline({arc("hole", {0, 0}, outer, 0.5, -2 * pi)}), 0.3 * outer), "hole");
    const std::vector<BodyMesh> bodies{divide_boundary(model.bodies[0]), divide_boundary(model.bodies[1])};
    const Interface joint = std::get<Interface>(match_interface(model, 0, bodies));
    ASSERT_EQ(joint.pairs.size(), 42u);
    double turn = 0.0;
    for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
      const Vec2 next = joint.pairs[(k + 1) % 42].point_a;
      EXPECT_NEAR(joint.pairs[k].gap, clearance, 1e-12);
      EXPECT_GT(cross(joint.pairs[k].point_a, next), 0.0);
      turn += std::asin(cross(joint.pairs[k].point_a, next));
    }
    EXPECT_NEAR(turn, 2 * pi, 1e-12);
    expect_exactly_swapped(joint, std::get<Interface>(match_interface(swapped(model), 0, bodies)));
  }
}

// ---- mistakes --------------------------------------------------------------------------------------------

TEST(MatchingMistake, NamesTheFirstPairThatDoesNotMatch) {
  model::Model model = blocks();
  model.bodies[1].mesh.size = 0.3;
  EXPECT_EQ(message_unmatched(model),
            "contacts.joint: the nodes of lower.top and upper.bottom do not match: first at "
            "(0.1875, "
            "1.5) on lower.top, whose nearest node on upper.bottom is (0.15, 1.5), 0.0375 away along the "
            "edge; give "
            "both bodies the same mesh size and order along the contact");
  model.bodies[1].mesh.size = 0.1875;  // every node of `lower` has a partner, but not every one of `upper`
  EXPECT_THAT(message_unmatched(model),
              HasSubstr("first at (0.09375, 1.5) on upper.bottom, whose nearest node on lower.top"));
  model.bodies[1].mesh.size = 0.375;
  model.bodies[1].mesh.order = 3;
  EXPECT_THAT(message_unmatched(model), HasSubstr("do not match: first at (0.1875, 1.5) on lower.top"));
}

TEST(MatchingMistake, IsFoundAlsoAtTheFarEndAndWhenTurned) {
  model::Model model = blocks();
  model.bodies[1] = elastic("upper", rectangle({0.001, 1.5}, {6, 1.5}), 0.375);
  EXPECT_THAT(message_unmatched(model), HasSubstr("0.001 away along the edge"));
  model = Similarity{37 * pi / 180, 1000.0, {0, 0}}(blocks());
  model.bodies[1].mesh.size = 300.0;
  EXPECT_THAT(message_unmatched(model), HasSubstr("37.5 away along the edge"));
}

TEST(MatchingMistake, TellsToAlignTheShorterEdge) {
  const model::Model model = pair_of(elastic("floor", rectangle({0, 0}, {6, 1}), 0.5), "top",
                                     elastic("block", rectangle({2.1, 1}, {1.5, 1}), 0.5), "bottom");
  EXPECT_THAT(message_unmatched(model),
              AllOf(HasSubstr("first at (2.25, 1) on floor.top"),
                    HasSubstr("let the ends of the shorter edge fall on nodes of the longer one")));
}

TEST(MatchingMistake, OfArcsWithUnlikeDivision) {
  EXPECT_THAT(message_unmatched(pair_of(ring(1.0, 1.0, 0.7, 0.07), "inner", disc(1.0, 0.7, 0.08), "rim")),
              HasSubstr("ring.inner and disc.rim do not match: first at"));
  EXPECT_THAT(message_unmatched(
                  pair_of(elastic("floor", rectangle({-1, -1}, {2, 1}), 0.05), "top", disc(5.0, 0.2, 0.06), "rim")),
              HasSubstr("do not match"));
}

TEST(MatchingMistake, EdgesThatLookAway) {
  const auto of = [](const char* a, const char* b) {
    model::Model model = blocks(0.01);
    model.contacts[0].a = test::edge_of(model, "lower", a);
    model.contacts[0].b = test::edge_of(model, "upper", b);
    return message_of(model);
  };
  EXPECT_THAT(of("top", "top"), HasSubstr("lower.top and upper.top do not face each other"));
  EXPECT_THAT(of("top", "left"), HasSubstr("do not"));
  EXPECT_THAT(of("bottom", "top"),
              HasSubstr("lower.bottom and upper.top face away from each other at a distance of 3.01"));
  EXPECT_EQ(of("top", "bottom"), "no error");
}

TEST(MatchingMistake, EdgesThatDoNotOverlap) {
  const auto at = [](double x) {
    return message_of(pair_of(elastic("floor", rectangle({0, 0}, {6, 1}), 0.5), "top",
                              elastic("block", rectangle({x, 1}, {1.5, 1}), 0.5), "bottom"));
  };
  EXPECT_THAT(at(7.0), HasSubstr("floor.top and block.bottom are nowhere opposite each other"));
  EXPECT_THAT(at(6.0), HasSubstr("are nowhere opposite each other"));  // corner on corner only
  EXPECT_EQ(at(5.5), "no error");
}

TEST(MatchingMistake, IsNotReportedForABodyWithoutMesh) {
  model::Model model = blocks();
  model.bodies[0].mesh.size = 1e-12;
  EXPECT_THAT(message_of(model), AllOf(HasSubstr("bodies.lower.mesh"), Not(HasSubstr("contacts.joint"))));
}

TEST(MatchingMistake, IsReportedForEveryContact) {
  model::Model model = blocks();
  for (model::Body& body : model.bodies) body.mesh.tolerance = 0.01;  // their sides are not divided alike first
  model.bodies[1].mesh.size = 0.3;
  model.contacts.push_back(model.contacts[0]);
  model.contacts[1].source.path = "contacts.other";
  EXPECT_THAT(message_of(model), AllOf(HasSubstr("model.yaml:24:3: contacts.joint"), HasSubstr("contacts.other")));
}

}  // namespace
}  // namespace scabo::mesh
