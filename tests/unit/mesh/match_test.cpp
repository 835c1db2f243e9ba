// Sides of contacts that do not match are divided until they do.
#include "scabo/mesh/match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "models.hpp"
#include "scabo/mesh/divide.hpp"
#include "scabo/mesh/interface.hpp"
#include "scabo/mesh/many_cells.hpp"
#include "scabo/mesh/node_matching.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::edge_of;
using test::elastic;
using test::line;
using test::pair_of;
using test::pi;
using test::polar;
using test::rectangle;
using test::Similarity;
using test::swapped;
using testing::HasSubstr;

/// Blocks of length 12 and height 2, divided along the contact into m and n elements.
model::Model blocks(int m, int n, int order_a = 1, int order_b = 1, double gap = 0.0) {
  return pair_of(elastic("lower", rectangle({0, -2}, {12, 2}), 12.0 / m, order_a), "top",
                 elastic("upper", rectangle({0, gap}, {12, 2}), 12.0 / n, order_b), "bottom");
}

/// Distances of the end nodes of an edge's elements from its start.
std::vector<double> breaks_of(const BodyMesh& mesh, int edge) {
  const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(edge)];
  const auto at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  std::vector<double> breaks{0.0};
  for (const LineElement& element : elements)
    breaks.push_back(breaks.back() + (at(element.nodes.back()) - at(element.nodes.front())).norm());
  return breaks;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance = 1e-13) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance) << k;
}

std::vector<double> x_of(const Interface& joint) {
  std::vector<double> x;
  for (const ContactPair& pair : joint.pairs) x.push_back(pair.point_a.x());
  return x;
}

/// Area within the polygons of the nodes of all cells.
double area_of(const BodyMesh& mesh) {
  double twice = 0.0;
  for (const Cell& cell : mesh.cells) {
    const std::vector<int> nodes = cell.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      twice += cross(mesh.nodes[static_cast<std::size_t>(nodes[i])],
                     mesh.nodes[static_cast<std::size_t>(nodes[(i + 1) % nodes.size()])]);
  }
  return 0.5 * twice;
}

/// Every node is used, the boundaries of the cells are chains, the elements of edges are those of cells, in one or the
/// other direction, and corners are where the outline has them.
void expect_sound(const model::Body& body, const BodyMesh& mesh) {
  std::set<int> used;
  std::set<std::vector<int>> elements;
  for (const Cell& cell : mesh.cells) {
    for (std::size_t k = 0; k < cell.boundary.size(); ++k) {
      const std::vector<int>& nodes = cell.boundary[k].nodes;
      used.insert(nodes.begin(), nodes.end());
      elements.insert(nodes);
      elements.insert({nodes.rbegin(), nodes.rend()});
      const bool last = k + 1 == cell.boundary.size();
      if (!last || !cell.is_open()) {
        EXPECT_EQ(nodes.back(), cell.boundary[last ? 0 : k + 1].nodes.front());
      }
    }
    EXPECT_TRUE(cell.materials.size() == 1 || cell.materials.size() == cell.boundary.size());
  }
  EXPECT_EQ(used.size(), mesh.nodes.size());
  EXPECT_EQ(*used.rbegin() + 1, static_cast<int>(mesh.nodes.size()));
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    for (const LineElement& element : mesh.edges[e]) EXPECT_TRUE(elements.contains(element.nodes));
    for (std::size_t k = 0; k + 1 < mesh.edges[e].size(); ++k) {
      const Vec2 gap = mesh.nodes[static_cast<std::size_t>(mesh.edges[e][k].nodes.back())] -
                       mesh.nodes[static_cast<std::size_t>(mesh.edges[e][k + 1].nodes.front())];
      EXPECT_EQ(gap.norm(), 0.0);
    }
    if (mesh.corners[e] >= 0) {
      EXPECT_LT((mesh.nodes[static_cast<std::size_t>(mesh.corners[e])] - body.outline.edges[e].start).norm(), 1e-12);
    }
  }
  if (mesh.cells.size() == 1 && mesh.count(CellKind::superelement) == 1) {
    const std::vector<int> nodes = mesh.cells.front().nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_EQ(nodes[i], static_cast<int>(i));
  }
}

Mesh sound_mesh(const model::Model& model) {
  Mesh mesh = make_mesh(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].rigid) expect_sound(model.bodies[b], mesh.bodies[b]);
  return mesh;
}

// ---- straight --------------------------------------------------------------------------------------------

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
  for (const double gap : {0.0, 0.01, -0.01}) {
    const model::Model model = blocks(7, 9, 2, 3, gap);
    const Mesh mesh = sound_mesh(model);
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

// ---- curved ----------------------------------------------------------------------------------------------

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

// ---- cells -----------------------------------------------------------------------------------------------

TEST(Matching, FiniteElementsBesideTheInterfaceBecomeSuperElements) {
  model::Model model = blocks(4, 5, 2, 2);
  model.bodies[0].mesh.kind = model::MeshKind::fem;  // 4 x 1 elements of 3 x 2
  model.bodies[0].mesh.size = 1.0;                   // 12 x 2 of 1 x 1
  const Mesh mesh = sound_mesh(model);
  // Points at 2.4, 4.8, 7.2, 9.6 fall into four of the twelve elements at the top.
  EXPECT_EQ(mesh.bodies[0].count(CellKind::superelement), 4);
  EXPECT_EQ(mesh.bodies[0].count(CellKind::finite_element), 20);
  EXPECT_EQ(mesh.bodies[0].edges[2].size(), 16u);
  EXPECT_EQ(mesh.interfaces[0].pairs.size(), 33u);
  EXPECT_NEAR(area_of(mesh.bodies[0]), 24.0, 1e-12);
  for (const Cell& cell : mesh.bodies[0].cells) {
    if (cell.kind == CellKind::finite_element) continue;
    EXPECT_NEAR(cell.centre.y(), -0.5, 1e-13);
    EXPECT_NEAR(std::abs(cell.centre.x() - std::round(cell.centre.x())), 0.5, 1e-13);
    EXPECT_EQ(cell.boundary.size(), 5u);
    EXPECT_EQ(cell.materials, std::vector<int>{0});
  }
}

TEST(Matching, SidesOfFiniteElementsFollowTheirNodes) {
  // Twelve elements against eleven of a block from 0.55 to 11.5: its first break point, at 1.545, does not meet one of
  // the floor, but others are near enough to move. All cells remain convex and fill the body.
  model::Model model = pair_of(elastic("lower", rectangle({0, -2}, {12, 2}), 1.0, 2), "top",
                               elastic("upper", rectangle({1.04, 0}, {10, 2}), 1.0, 2), "bottom");
  model.bodies[0].mesh.kind = model::MeshKind::fem;
  const Mesh mesh = sound_mesh(model);
  // All points of the block are 0.04 from those of the floor: they move, and no element is divided.
  EXPECT_EQ(mesh.bodies[0].count(CellKind::superelement), 0);
  EXPECT_EQ(mesh.interfaces[0].pairs.size(), 21u);
  EXPECT_NEAR(mesh.interfaces[0].pairs[2].point_a.x(), 2.02, 1e-13);
  EXPECT_NEAR(area_of(mesh.bodies[0]), 24.0, 1e-12);
  const auto has_node = [&](const Vec2& at) {
    return std::any_of(mesh.bodies[0].nodes.begin(), mesh.bodies[0].nodes.end(),
                       [&](const Vec2& node) { return (node - at).norm() < 1e-12; });
  };
  EXPECT_TRUE(has_node({1.04, 0}));
  EXPECT_TRUE(has_node({1.02, -0.5}));  // the middle of the side below it
  EXPECT_TRUE(has_node({1.0, -1.0}));
}

TEST(Matching, OfACrackedBodyKeepsMouthAndSectors) {
  // The mouth of the crack is in the middle of the contact edge: two nodes at one place.
  model::Model model = blocks(4, 6, 2, 2);
  model::Crack crack;
  crack.name = "crack";
  crack.tip = {6, 1};
  crack.mouth = {6, 0};
  crack.edge = 0;
  crack.at = 0.5;
  model.bodies[1].cracks = {crack};
  model.bodies[1].mesh.centre = crack.tip;
  model.bodies[1].sector_materials = {0, 1, 2, 3};
  const Mesh mesh = make_mesh(model);
  const BodyMesh& cracked = mesh.bodies[1];
  EXPECT_EQ(cracked.mouth[0], 0);
  EXPECT_EQ(cracked.mouth[1], static_cast<int>(cracked.nodes.size()) - 1);
  EXPECT_LT((cracked.nodes.front() - Vec2(6, 0)).norm(), 1e-14);
  EXPECT_LT((cracked.nodes.back() - Vec2(6, 0)).norm(), 1e-14);
  const Cell& cell = cracked.cells.front();
  ASSERT_EQ(cell.materials.size(), cell.boundary.size());
  for (std::size_t k = 0; k < cell.boundary.size(); ++k) {
    const Vec2 middle = cracked.nodes[static_cast<std::size_t>(cell.boundary[k].nodes[1])];
    const int sector = middle.y() < 1e-9 ? 0 : middle.x() > 12 - 1e-9 ? 1 : middle.y() > 2 - 1e-9 ? 2 : 3;
    EXPECT_EQ(cell.materials[k], sector);
  }
  EXPECT_EQ(mesh.bodies[0].edges[2].size(), 8u);  // at 2, 3, 4, 6, 8, 9, 10
}

/// A pin of radius 1 in a plate with a crack from the rim of the hole at `angle` radially outwards.
model::Model pin_and_cracked_plate(double angle) {
  model::Body plate = elastic("plate", test::outline({arc("rim", {0, 0}, 2, 0, 2 * pi)}), 0.3, 2);
  const model::Outline hole = test::outline({arc("h", {0, 0}, 1, 0, -2 * pi)});
  plate.outline.holes = {1};
  plate.outline.edges.push_back(hole.edges.front());
  plate.outline.corners.push_back(hole.corners.front());
  plate.mesh.kind = model::MeshKind::polygons;
  model::Crack& crack = plate.cracks.emplace_back();
  crack.name = "k";
  crack.path = {polar({0, 0}, 1, angle), polar({0, 0}, 1.5, angle)};
  model::Body pin = elastic("pin", test::outline({arc("rim", {0, 0}, 1, 0, 2 * pi)}), 0.23, 2);
  pin.mesh.kind = model::MeshKind::polygons;
  return pair_of(plate, "h", pin, "rim");
}

TEST(Matching, ACrackThatEndsWhereTheRimStarts) {
  // Every node of the pin has a partner, wherever the crack ends, and the one that faces its mouth has two.
  for (const double angle : {0.0, 0.5 * pi}) {
    const model::Model model = pin_and_cracked_plate(angle);
    const Mesh mesh = make_mesh(model);
    const std::vector<LineElement>& rim = mesh.bodies[1].edges[0];
    std::size_t nodes = 0;
    for (const LineElement& element : rim) nodes += element.nodes.size() - 1;
    EXPECT_EQ(mesh.interfaces.front().pairs.size(), nodes + 1) << angle;
    for (const ContactPair& pair : mesh.interfaces.front().pairs)
      EXPECT_LT((pair.point_a - pair.point_b).norm(), 1e-9) << angle;
  }
}

TEST(Matching, RefusesMouthsThatAreAlmostInOnePlace) {
  const auto message = [](double x, const Vec2& from = {0, 0}) -> std::string {
    model::Body lower = elastic("lower", rectangle(from, {2, 1}), 0.3, 2);
    model::Body upper = elastic("upper", rectangle(from + Vec2(0, 1), {2, 1}), 0.25, 2);
    for (model::Body* body : {&lower, &upper}) {
      body->mesh.kind = model::MeshKind::polygons;
      body->cracks.emplace_back().name = "k";
    }
    lower.cracks[0].path = {from + Vec2(1, 1), from + Vec2(1, 0.5)};
    upper.cracks[0].path = {from + Vec2(x, 1), from + Vec2(x, 1.5)};
    try {
      make_mesh(pair_of(lower, "top", upper, "bottom"));
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return "";
  };
  EXPECT_EQ(message(1.0), "");
  EXPECT_EQ(message(1.001), "");
  EXPECT_EQ(message(1.0, {1e7 / 3.0, -1e7 / 7.0}), "");  // the digits that are left
  for (const double apart : {1e-8, 1e-7, 1e-6})
    EXPECT_THAT(message(1.0 + apart), testing::AllOf(HasSubstr("a crack ends at (1, 1) on "),
                                                     HasSubstr(" from the end of a crack at (1.0000")))
        << apart;
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
