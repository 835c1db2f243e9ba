// Boundaries with elements of different length and order, and their enrichment.
#include <gtest/gtest.h>

#include "models.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/division.hpp"

namespace scabo::mesh {
namespace {

using namespace scabo::test;

model::Model one(model::Body body) {
  model::Model model;
  model.file = "model.yaml";
  model.bodies = {std::move(body)};
  return model;
}

/// A unit square whose bottom has elements 0.1 (order 3) and 0.9 (order 1), the other sides one of order 2.
Division mixed() {
  const EdgeDivision plain{{0.0, 1.0}, {2}};
  return {{{{0.0, 0.1, 1.0}, {3, 1}}, plain, plain, plain}};
}

TEST(MixedDivision, GivesEveryElementItsLengthAndOrder) {
  const Mesh mesh = make_mesh(one(elastic("square", rectangle({0, 0}, {1, 1}), 1.0)), mixed());
  const BodyMesh& body = mesh.bodies[0];
  ASSERT_EQ(body.nodes.size(), 10u);
  ASSERT_EQ(body.edges[0].size(), 2u);
  EXPECT_EQ(body.edges[0][0].nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(body.edges[0][1].nodes, (std::vector<int>{3, 4}));
  EXPECT_EQ(body.cells[0].boundary.back().nodes, (std::vector<int>{8, 9, 0}));
  EXPECT_NEAR(body.nodes[3].x(), 0.1, 1e-16);
  EXPECT_NEAR(body.nodes[1].x(), 0.05 * (1 - std::sqrt(0.2)), 1e-16);
  EXPECT_EQ(body.corners, (std::vector<int>{0, 4, 6, 8}));
}

TEST(MixedDivision, IsTheOldOneWhereItIsUniform) {
  const model::Model model =
      one(elastic("disc", outline({arc("a", {0, 0}, 1, 0, pi), arc("b", {0, 0}, 1, pi, pi)}), 0.3, 3));
  const Mesh plain = make_mesh(model), divided = make_mesh(model, initial_division(model));
  EXPECT_EQ(plain.bodies[0].nodes, divided.bodies[0].nodes);
}

TEST(Enriched, HoldsEveryFieldOfTheOldElementsOnTheSameCurve) {
  const model::Model model =
      one(elastic("disc", outline({arc("a", {0, 0}, 1, 0, pi), arc("b", {0, 0}, 1, pi, pi)}), 0.9, 2));
  const Mesh mesh = make_mesh(model);
  std::vector<std::vector<bool>> frozen(1, std::vector<bool>(mesh.bodies[0].cells[0].boundary.size(), false));
  frozen[0][1] = true;
  const BodyMesh fine = enriched(model, mesh, frozen).bodies[0];
  const auto& old_elements = mesh.bodies[0].cells[0].boundary;
  const auto& new_elements = fine.cells[0].boundary;
  ASSERT_EQ(old_elements.size(), new_elements.size());
  for (std::size_t e = 0; e < old_elements.size(); ++e) {
    EXPECT_EQ(new_elements[e].nodes.size(), e == 1 ? 3u : 4u);
    // A parabola: equal third differences of position vanish, so the inner points lie on it.
    const auto at = [&](double eta) {
      const Vec2 &a = mesh.bodies[0].nodes[static_cast<std::size_t>(old_elements[e].nodes[0])],
                 &b = mesh.bodies[0].nodes[static_cast<std::size_t>(old_elements[e].nodes[1])],
                 &c = mesh.bodies[0].nodes[static_cast<std::size_t>(old_elements[e].nodes[2])];
      return Vec2(0.5 * eta * (eta - 1) * a + (1 - eta * eta) * b + 0.5 * eta * (eta + 1) * c);
    };
    const auto points = geometry::lobatto_points(static_cast<int>(new_elements[e].nodes.size()) - 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((fine.nodes[static_cast<std::size_t>(new_elements[e].nodes[i])] - at(points[i])).norm(), 1e-15);
  }
  EXPECT_EQ(new_elements.front().nodes.front(), 0);
  EXPECT_EQ(new_elements.back().nodes.back(), 0);
  std::size_t k = 0;
  for (const auto& edge : fine.edges)
    for (const LineElement& element : edge) EXPECT_EQ(element.nodes, new_elements[k++].nodes);
  EXPECT_EQ(fine.nodes[static_cast<std::size_t>(fine.corners[1])],
            mesh.bodies[0].nodes[static_cast<std::size_t>(mesh.bodies[0].corners[1])]);
}

model::Model stacked(double upper_length, double upper_size, int upper_order) {
  model::Model model = one(elastic("lower", rectangle({0, 0}, {4, 1}), 1.0, 2));
  model.bodies.push_back(elastic("upper", rectangle({0, 1}, {upper_length, 1}), upper_size, upper_order));
  model::Contact contact;
  contact.name = "joint";
  contact.a = {model::Place::Kind::edge, 0, 2, Vec2::Zero(), "lower.top", {}};
  contact.b = {model::Place::Kind::edge, 1, 0, Vec2::Zero(), "upper.bottom", {}};
  model.contacts = {contact};
  return model;
}

TEST(PairedElements, FaceEachOtherInReverse) {
  const model::Model model = stacked(3.0, 1.0, 2);  // shorter: lower's first element along its top faces nothing
  const PairedElements paired = paired_elements(model, make_mesh(model));
  EXPECT_TRUE(paired.alone.empty());
  ASSERT_EQ(paired.alike.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(paired.alike[static_cast<std::size_t>(k)][0], (EdgeElement{0, 2, k + 1}));
    EXPECT_EQ(paired.alike[static_cast<std::size_t>(k)][1], (EdgeElement{1, 0, 2 - k}));
  }
}

TEST(PairedElements, OfAnotherOrderStayAlone) {
  const model::Model model = stacked(4.0, 0.5, 1);  // nodes match, elements do not
  Mesh mesh;
  mesh.bodies = divided_bodies(model);  // before the sides are divided alike
  const PairingFaults faults = add_interfaces(model, mesh);
  EXPECT_TRUE(faults.mistakes.empty());
  EXPECT_EQ(faults.unlike.size(), 1u);
  const PairedElements paired = paired_elements(model, mesh);
  EXPECT_TRUE(paired.alike.empty());
  EXPECT_EQ(paired.alone.size(), 4u + 8u);
}

TEST(Enriched, KeepsContactPairsTogetherAlsoWithMixedOrders) {
  const model::Model model = stacked(4.0, 1.0, 2);
  Division division = initial_division(model);
  division[0][2].orders = {2, 4, 1, 3};
  division[1][0].orders = {3, 1, 4, 2};
  const Mesh mesh = make_mesh(model, division);
  EXPECT_EQ(mesh.interfaces[0].pairs.size(), 11u);
  const Mesh fine = enriched(model, mesh, {});
  EXPECT_EQ(fine.interfaces[0].pairs.size(), 15u);
  for (const ContactPair& pair : fine.interfaces[0].pairs) EXPECT_EQ(pair.gap, 0.0);
}

}  // namespace
}  // namespace scabo::mesh
