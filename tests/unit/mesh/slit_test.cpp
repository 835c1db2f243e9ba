#include "scabo/mesh/plane/slit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "matched_meshes.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/mesh/plane/imported_cells.hpp"
#include "scabo/model/imported_body.hpp"

namespace scabo::mesh {
namespace {

using test::area_of;

/// Columns x rows unit squares, of which those from column `from` on are of region 1.
model::Body squares(int columns, int rows, model::MeshKind kind, int from = 1000) {
  files::ImportedMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) mesh.nodes.emplace_back(i, j);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      mesh.cells.push_back({files::CellKind::quad4, {a, a + 1, a + columns + 2, a + columns + 1}, i >= from ? 1 : 0});
    }
  mesh.regions = {"one"};
  if (from < columns) mesh.regions.push_back("two");
  mesh.materials.resize(mesh.regions.size());
  model::ImportedBody imported = std::get<model::ImportedBodies>(model::imported_bodies(mesh, {}, true)).parts.front();
  model::Body body;
  body.imported = imported.mesh;
  body.outline = imported.outline;
  body.mesh.kind = kind;
  body.mesh.order = 1;
  body.material = 0;
  for (std::size_t i = 0; i < mesh.regions.size(); ++i) body.region_materials.push_back(static_cast<int>(i));
  return body;
}

model::Crack crack(std::vector<Vec2> path) {
  model::Crack made;
  made.name = "flaw";
  made.path = std::move(path);
  return made;
}

BodyMesh whole(const model::Body& body) {
  model::Body without = body;
  without.cracks.clear();
  return std::get<BodyMesh>(cells_of_file(without, SizeField(), 1e6));
}

BodyMesh slit_mesh(const model::Body& body, int layers) {
  return std::get<BodyMesh>(slit(whole(body), body, {.layers = layers}));
}

// By hand: 35 nodes; the three nodes behind the tip are doubled, the tip is a centre, and each of the eight sides
// around it, seen under 45 degrees, gets a node.
TEST(Slit, EdgeCrackBetweenSquares) {
  for (const model::MeshKind kind : {model::MeshKind::imported, model::MeshKind::fem}) {
    model::Body body = squares(6, 4, kind);
    body.cracks = {crack({{0, 2}, {3, 2}})};
    const BodyMesh mesh = slit_mesh(body, 1);
    EXPECT_EQ(mesh.nodes.size(), 35 + 3 - 1 + 8);
    ASSERT_EQ(mesh.cells.size(), 24 - 4 + 1);
    EXPECT_NEAR(area_of(mesh), 24.0, 1e-12);
    const Cell& tip = mesh.cells.back();
    EXPECT_TRUE(tip.is_open());
    EXPECT_EQ(tip.centre, Vec2(3, 2));
    EXPECT_EQ(tip.boundary.size(), 16);
    ASSERT_EQ(mesh.faces.size(), 2);
    for (const auto& face : mesh.faces) EXPECT_EQ(face.size(), 2);
    const auto at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
    EXPECT_EQ(at(mesh.faces[1].front().nodes.front()), Vec2(0, 2));  // the left face runs along the path
    EXPECT_EQ(at(mesh.faces[0].back().nodes.back()), Vec2(0, 2));
    EXPECT_EQ(face_pairs(mesh, 0).size(), 3);
    // Elements with a node too many are super-elements, the others stay.
    if (kind == model::MeshKind::fem) EXPECT_EQ(mesh.count(CellKind::finite_element), 24 - 4 - 8);
  }
}

TEST(Slit, BothEndsAreTips) {
  model::Body body = squares(10, 4, model::MeshKind::imported);
  body.cracks = {crack({{2, 2}, {8, 2}})};
  const BodyMesh mesh = slit_mesh(body, 1);
  EXPECT_EQ(std::count_if(mesh.cells.begin(), mesh.cells.end(), [](const Cell& cell) { return cell.is_open(); }), 2);
  EXPECT_EQ(mesh.faces[0].size(), 4);
  EXPECT_NEAR(area_of(mesh), 40.0, 1e-12);
}

TEST(Slit, MoreLayersMakeALargerCell) {
  model::Body body = squares(12, 12, model::MeshKind::imported);
  body.cracks = {crack({{0, 6}, {6, 6}})};
  for (const int layers : {1, 2, 3}) {
    const BodyMesh mesh = slit_mesh(body, layers);
    EXPECT_EQ(mesh.cells.size(), 144 - 4 * layers * layers + 1) << layers;
    EXPECT_EQ(mesh.faces[0].size(), 6 - layers) << layers;
    EXPECT_NEAR(area_of(mesh), 144.0, 1e-12) << layers;
  }
}

// Where two cracks cross, four groups of cells meet: one node becomes four.
TEST(Slit, CracksThatCross) {
  model::Body body = squares(8, 8, model::MeshKind::imported);
  body.cracks = {crack({{1, 4}, {7, 4}}), crack({{4, 1}, {4, 7}})};
  body.cracks.back().name = "other";
  const BodyMesh mesh = slit_mesh(body, 1);
  EXPECT_EQ(std::count(mesh.nodes.begin(), mesh.nodes.end(), Vec2(4, 4)), 4);
  EXPECT_EQ(mesh.faces.size(), 4);
  EXPECT_NEAR(area_of(mesh), 64.0, 1e-12);
}

// The tip between two materials: each side of its cell has that of the square beside it.
TEST(Slit, TipOnABorderOfMaterials) {
  model::Body body = squares(6, 4, model::MeshKind::imported, 3);
  body.cracks = {crack({{0, 2}, {3, 2}})};
  const BodyMesh mesh = slit_mesh(body, 3);
  const Cell& tip = mesh.cells.back();
  ASSERT_EQ(tip.materials.size(), tip.boundary.size());
  EXPECT_EQ(std::count(tip.materials.begin(), tip.materials.end(), 1), 8);
}

TEST(Slit, WhatIsNoCrackOfAMesh) {
  const auto message = [](std::vector<Vec2> path) {
    model::Body body = squares(6, 4, model::MeshKind::imported);
    body.cracks = {crack(std::move(path))};
    const auto made = slit(whole(body), body);
    return std::holds_alternative<Diagnostic>(made) ? std::get<Diagnostic>(made).message : "";
  };
  EXPECT_EQ(
      message({{0, 2}, {3, 2.5}}),
      "no side of a cell runs along crack 'flaw' from (0, 2) on: a crack follows the sides of the cells of its mesh "
      "and ends at their corners");
  EXPECT_EQ(
      message({{0, 2}, {2.5, 2}}),
      "no side of a cell runs along crack 'flaw' from (2, 2) on: a crack follows the sides of the cells of its mesh "
      "and ends at their corners");
  EXPECT_EQ(
      message({{2, 2}, {3, 2}}),
      "the cells around the tip (2, 2) of crack 'flaw' cannot be joined to one: use a finer mesh there, so that two "
      "rows of cells lie between it and other tips and borders of materials");
}

}  // namespace
}  // namespace scabo::mesh
