// What dividing the sides of contacts does to finite elements, super-elements and cracks beside them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "matched_meshes.hpp"
#include "scabo/mesh/plane/match.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::area_of;
using test::blocks;
using test::elastic;
using test::pair_of;
using test::pi;
using test::polar;
using test::rectangle;
using test::sound_mesh;
using testing::HasSubstr;

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

}  // namespace
}  // namespace scabo::mesh
