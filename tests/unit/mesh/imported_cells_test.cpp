// Cells of mesh files as cells of a body.
#include "scabo/mesh/plane/imported_cells.hpp"

#include <gtest/gtest.h>

#include <set>

#include "scabo/files/read_mesh_file.hpp"
#include "scabo/model/imported_body.hpp"
#include "support/mesh_text.hpp"

namespace scabo::mesh {
namespace {

model::Body body_of(const test::MeshText& text, model::MeshKind kind, int order = 1) {
  auto made =
      std::get<model::ImportedBodies>(model::imported_bodies(files::parse_mesh(text.vtu(), "part.vtu"), {}, true))
          .parts.front();
  model::Body body;
  body.name = "part";
  body.material = 0;
  body.imported = made.mesh;
  body.outline = made.outline;
  body.region_materials.assign(made.mesh->regions.size(), 0);
  body.mesh.kind = kind;
  body.mesh.order = order;
  body.mesh.file = "some/part.vtu";
  return body;
}

BodyMesh mesh_of(const test::MeshText& text, model::MeshKind kind, int order = 1) {
  return std::get<BodyMesh>(cells_of_file(body_of(text, kind, order), SizeField(), 1e6));
}

TEST(ImportedCells, KeepTheirNodesAndOrders) {
  // 6 x 4 cells: 35 corners, 58 sides.
  const std::vector<std::array<int, 3>> table{
      {5, 48, 35}, {9, 24, 35}, {7, 12, 35}, {22, 48, 35 + 82}, {23, 24, 35 + 58}};
  for (const auto& [type, cells, nodes] : table)
    for (const model::MeshKind kind : {model::MeshKind::imported, model::MeshKind::fem}) {
      if (type == 7 && kind == model::MeshKind::fem) continue;
      const BodyMesh mesh = mesh_of(test::mesh_of_rectangle(type, 3.0, 2.0, 6, 4), kind);
      EXPECT_EQ(static_cast<int>(mesh.cells.size()), cells);
      EXPECT_EQ(static_cast<int>(mesh.nodes.size()), nodes) << type;
      ASSERT_EQ(mesh.edges.size(), 4u);
      ASSERT_EQ(mesh.edges[0].size(), type == 7 ? 6u : 6u);
      EXPECT_EQ(mesh.edges[0].front().nodes.size(), type > 20 ? 3u : 2u);
      EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.corners[2])], Vec2(3, 2));
      EXPECT_EQ(mesh.count(CellKind::finite_element), kind == model::MeshKind::fem ? cells : 0);
    }
}

TEST(ImportedCells, AreRaisedWithoutNodesLeftOver) {
  for (const int type : {9, 23})
    for (const int order : {2, 3, 5}) {
      const BodyMesh mesh = mesh_of(test::mesh_of_rectangle(type, 3.0, 2.0, 6, 4), model::MeshKind::imported, order);
      EXPECT_EQ(static_cast<int>(mesh.nodes.size()), 35 + (order - 1) * 58);
      std::set<int> used;
      for (const Cell& cell : mesh.cells) {
        const std::vector<int> nodes = cell.nodes();
        EXPECT_EQ(static_cast<int>(nodes.size()), 4 * order);
        used.insert(nodes.begin(), nodes.end());
      }
      EXPECT_EQ(used.size(), mesh.nodes.size());
    }
}

TEST(ImportedCells, CentreOfACellThatItsCentroidDoesNotSee) {
  // An L of arms 1 x 4 and 3 x 1: the centroid lies outside, the kernel is the square [0, 1]^2.
  test::MeshText text;
  text.nodes = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  text.cells = {{7, {0, 1, 2, 3, 4, 5}, 1}};
  const BodyMesh mesh = mesh_of(text, model::MeshKind::imported);
  const Vec2 centre = mesh.cells[0].centre;
  EXPECT_GT(centre.minCoeff(), 0.1);
  EXPECT_LT(centre.maxCoeff(), 0.9);
}

TEST(ImportedCells, NameTheCellThatCannotBe) {
  // A U, of which no point sees both arms.
  test::MeshText text;
  text.nodes = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  text.cells = {{7, {0, 1, 2, 3, 4, 5, 6, 7}, 1}};
  const auto wrong = cells_of_file(body_of(text, model::MeshKind::imported), SizeField(), 1e6);
  ASSERT_TRUE(std::holds_alternative<Diagnostic>(wrong));
  EXPECT_EQ(std::get<Diagnostic>(wrong).message.substr(0, 27), "cell 0 of part.vtu (polygon");
  const auto fem = cells_of_file(body_of(text, model::MeshKind::fem), SizeField(), 1e6);
  EXPECT_NE(std::get<Diagnostic>(fem).message.find("is no finite element"), std::string::npos);
  const auto many = cells_of_file(body_of(text, model::MeshKind::imported, 9), SizeField(), 30);
  EXPECT_NE(std::get<Diagnostic>(many).message.find("more than the 30 allowed"), std::string::npos);
}

TEST(ImportedCells, SidesThatBulgeInwardsMustBeSeen) {
  // A square of side 2 whose bottom is drawn up to y = 1.2 in its middle: the tangents at its ends meet at (1, 2.4),
  // above the square, so that no point sees the whole bottom.
  test::MeshText text;
  text.nodes = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0.4}, {2, 1}, {1, 2}, {0, 1}};
  text.cells = {{36, {0, 1, 2, 3, 4, 5, 6, 7}, 1}};
  const BodyMesh mesh = mesh_of(text, model::MeshKind::imported);  // tangents meet at (1, 0.8)
  EXPECT_GT(mesh.cells[0].centre.y(), 0.8);
  text.nodes[4] = {1, 1.2};
  EXPECT_TRUE(
      std::holds_alternative<Diagnostic>(cells_of_file(body_of(text, model::MeshKind::imported), SizeField(), 1e6)));
}

}  // namespace
}  // namespace scabo::mesh
