// Outlines made of mesh files, and the keys around `mesh: {file: ...}`.
#include "scabo/model/imported_body.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "scabo/files/read_mesh_file.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/input/read_model.hpp"
#include "support/mesh_text.hpp"

namespace scabo::input {
namespace {

using model::ImportedBody;
using test::mesh_of_rectangle;
using test::MeshText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

files::ImportedMesh parsed(const MeshText& mesh) { return files::parse_mesh(mesh.vtu(), "mesh.vtu"); }

std::vector<ImportedBody> bodies_of(const files::ImportedMesh& mesh, int region = -1, bool join = false) {
  return std::get<model::ImportedBodies>(model::imported_bodies(mesh, {region, -1}, join)).parts;
}

ImportedBody body_of(const MeshText& mesh, int region = -1) { return bodies_of(parsed(mesh), region).front(); }

std::vector<std::string> edge_names(const geometry::Outline& outline) {
  std::vector<std::string> names;
  for (const geometry::Edge& edge : outline.edges)
    for (const std::string& name : edge.names) names.push_back(name);
  return names;
}

TEST(ImportedBody, OfARectangleHasFourStraightEdges) {
  for (const int type : {5, 7, 9, 22, 23, 36}) {
    const ImportedBody body = body_of(mesh_of_rectangle(type, 3.0, 2.0, 6, 4));
    const geometry::Outline& outline = body.outline;
    EXPECT_THAT(edge_names(outline), ElementsAre("edge_1", "edge_2", "edge_3", "edge_4"));
    EXPECT_EQ(outline.edges[0].start, Vec2(0, 0));
    EXPECT_EQ(outline.edges[1].start, Vec2(3, 0));
    EXPECT_EQ(outline.edges[2].end, Vec2(0, 2));
    for (const geometry::Edge& edge : outline.edges) EXPECT_FALSE(edge.is_chain());
    EXPECT_EQ(outline.corners[2].names.front(), "vertex_3");
    EXPECT_EQ(body.mesh->facet_sets.size(), 4u);
    EXPECT_EQ(body.mesh->facet_sets[1].facets.size(), 4u);
    EXPECT_DOUBLE_EQ(outline.area(), 6.0);
  }
}

TEST(ImportedBody, NamesEdgesAndCornersBySets) {
  MeshText mesh = mesh_of_rectangle(9, 4.0, 1.0, 4, 1);  // nodes 0 to 4 at the bottom, 5 to 9 at the top
  mesh.cells.push_back({3, {1, 2}, 7});
  mesh.cells.push_back({3, {2, 3}, 7});  // x from 1 to 3 of the bottom
  mesh.cells.push_back({3, {9, 8}, 8});
  mesh.cells.push_back({3, {6, 5}, 8});  // the two ends of the top
  mesh.cells.push_back({3, {8, 3}, 9});  // between two cells: no edge
  mesh.cells.push_back({1, {7}, 3});     // cuts the middle of the top
  mesh.cells.push_back({1, {2}, 4});     // within a named edge
  const ImportedBody body = body_of(mesh);
  EXPECT_THAT(edge_names(body.outline), ElementsAre("edge_1", "boundary_7", "edge_2", "edge_3", "boundary_8", "edge_4",
                                                    "edge_5", "boundary_8_2", "edge_6"));
  EXPECT_EQ(body.outline.edges[1].start, Vec2(1, 0));
  EXPECT_EQ(body.outline.edges[1].end, Vec2(3, 0));
  EXPECT_THAT(body.outline.corners[6].names, ElementsAre("vertex_7", "points_3"));
  EXPECT_EQ(body.outline.corners[6].position, Vec2(2, 1));
  EXPECT_THAT(body.pieces, ElementsAre(Pair("boundary_8", ElementsAre("boundary_8_2"))));
  ASSERT_EQ(body.lost_points.size(), 1u);
  EXPECT_EQ(body.lost_points.at("points_4"), Vec2(2, 0));
}

TEST(ImportedBody, CutsEdgesWhereSetsOverlap) {
  MeshText mesh = mesh_of_rectangle(9, 4.0, 1.0, 4, 1);
  for (int i = 0; i < 4; ++i) mesh.cells.push_back({3, {i, i + 1}, 1});
  mesh.cells.push_back({3, {1, 2}, 2});
  const ImportedBody body = body_of(mesh);
  // boundary_2 is also the second piece of boundary_1.
  EXPECT_THAT(edge_names(body.outline),
              ElementsAre("boundary_1", "boundary_1_2", "boundary_2", "boundary_1_3", "edge_1", "edge_2", "edge_3"));
}

TEST(ImportedBody, OfARegionNamesItsBorders) {
  const MeshText mesh = mesh_of_rectangle(9, 4.0, 2.0, 4, 2, [](int i, int) { return i < 1 ? 1 : i < 3 ? 2 : 3; });
  const files::ImportedMesh file = parsed(mesh);
  const ImportedBody middle = bodies_of(file, 1).front();
  EXPECT_THAT(edge_names(middle.outline), ElementsAre("edge_1", "to_region_3", "edge_2", "to_region_1"));
  EXPECT_EQ(middle.outline.edges[1].start, Vec2(3, 0));
  EXPECT_EQ(middle.mesh->cells.size(), 4u);
  EXPECT_EQ(middle.mesh->nodes.size(), 9u);
  EXPECT_THAT(middle.mesh->regions, ElementsAre("region_2"));
}

TEST(ImportedBody, HasHolesAndClosedEdges) {
  const int sides = 24;
  const files::ImportedMesh file = parsed(test::mesh_of_disc_in_ring(sides, true));
  const ImportedBody ring = bodies_of(file, 1).front();
  EXPECT_THAT(edge_names(ring.outline), ElementsAre("edge_1", "to_region_1"));
  EXPECT_THAT(ring.outline.holes, ElementsAre(1));
  EXPECT_TRUE(ring.outline.edges[0].is_chain());
  EXPECT_EQ(ring.outline.edges[1].start, ring.outline.edges[1].end);
  // 32 chords of each parabola, which turn by x = 2 pi / 768 each: the area is that of a circle times sin(x) / x.
  const double chords = std::numbers::pi * 2.0 / 768.0;
  EXPECT_NEAR(ring.outline.area() / (3.0 * std::numbers::pi), 1.0 - chords * chords / 6.0, 2e-5);
  EXPECT_NEAR(ring.outline.edges[0].length() / (4.0 * std::numbers::pi), 1.0 - chords * chords / 24.0, 1e-5);
  EXPECT_FALSE(geometry::encloses(ring.outline, {0.99, 0.0}));
  EXPECT_TRUE(geometry::encloses(ring.outline, {1.01, 0.0}));
  // Of the lowest nodes the first edge starts at the one furthest to the left.
  EXPECT_LT((ring.outline.edges[0].start - Vec2(0, -2)).norm(), 1e-15);
}

TEST(ImportedBody, IsConnected) {
  MeshText mesh = mesh_of_rectangle(9, 1.0, 1.0, 1, 1);
  mesh.nodes.insert(mesh.nodes.end(), {{2, 0}, {3, 0}, {3, 1}, {2, 1}});
  mesh.cells.push_back({9, {4, 5, 6, 7}, 2});
  const std::string why = std::get<std::string>(model::imported_bodies(parsed(mesh), {}, true));
  EXPECT_THAT(why, HasSubstr("2 parts"));
  EXPECT_THAT(why, HasSubstr("'region': 'region_1', 'region_2'"));
  EXPECT_EQ(body_of(mesh, 1).outline.edges[0].start, Vec2(2, 0));
}

TEST(ImportedBody, OfOneRegionInSeveralPartsAreSeveral) {
  MeshText mesh = mesh_of_rectangle(9, 1.0, 1.0, 1, 1);
  mesh.nodes.insert(mesh.nodes.end(), {{2, 0}, {3, 0}, {3, 1}, {2, 1}});
  mesh.cells.push_back({9, {4, 5, 6, 7}, 1});
  for (const bool join : {false, true}) {
    const std::vector<ImportedBody> bodies = bodies_of(parsed(mesh), -1, join);
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0].outline.edges[0].start, Vec2(0, 0));
    EXPECT_EQ(bodies[1].outline.edges[0].start, Vec2(2, 0));
    EXPECT_EQ(bodies[1].mesh->nodes.size(), 4u);
  }
}

/// Two squares above each other with nodes of their own on the side between them.
MeshText two_patches(double gap = 0.0, double offset = 0.0) {
  MeshText mesh = mesh_of_rectangle(9, 2.0, 1.0, 2, 1);  // nodes 0 to 5
  for (const double y : {1.0 + gap, 2.0})
    for (int i = 0; i < 3; ++i) mesh.nodes.push_back({i + offset, y});
  mesh.cells.push_back({9, {6, 7, 10, 9}, 1});
  mesh.cells.push_back({9, {7, 8, 11, 10}, 1});
  return mesh;
}

TEST(ImportedBody, IsJoinedWhereWholeSidesLieOnEachOther) {
  EXPECT_EQ(bodies_of(parsed(two_patches())).size(), 2u);
  const auto joined = std::get<model::ImportedBodies>(model::imported_bodies(parsed(two_patches()), {}, true));
  ASSERT_EQ(joined.parts.size(), 1u);
  EXPECT_EQ(joined.joined_nodes, 3);
  EXPECT_EQ(joined.parts[0].mesh->nodes.size(), 9u);
  EXPECT_DOUBLE_EQ(joined.parts[0].outline.area(), 4.0);
  EXPECT_EQ(joined.parts[0].outline.edges.size(), 4u);
  // Six digits of a file, but not a gap of a thousandth.
  EXPECT_EQ(bodies_of(parsed(two_patches(1e-7)), -1, true).size(), 1u);
  EXPECT_EQ(bodies_of(parsed(two_patches(1e-3)), -1, true).size(), 2u);
  // By a whole element: one side is common. By two: one node, which joins nothing.
  EXPECT_EQ(bodies_of(parsed(two_patches(0.0, 1.0)), -1, true).size(), 1u);
  EXPECT_EQ(bodies_of(parsed(two_patches(0.0, 2.0)), -1, true).size(), 2u);
  EXPECT_EQ(bodies_of(parsed(two_patches(0.0, 0.5)), -1, true).size(), 2u);
}

TEST(ImportedBody, IsJoinedAlongQuadraticSides) {
  MeshText mesh = mesh_of_rectangle(23, 1.0, 1.0, 1, 1);
  const int first = static_cast<int>(mesh.nodes.size());
  const std::vector<int> below = mesh.cells[0].nodes;
  for (int i = 0; i < first; ++i)
    mesh.nodes.push_back(
        {mesh.nodes[static_cast<std::size_t>(i)].x(), mesh.nodes[static_cast<std::size_t>(i)].y() + 1.0});
  std::vector<int> above;
  for (const int node : below) above.push_back(node + first);
  mesh.cells.push_back({23, above, 1});
  EXPECT_EQ(bodies_of(parsed(mesh)).size(), 2u);
  const std::vector<ImportedBody> joined = bodies_of(parsed(mesh), -1, true);
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_EQ(joined[0].mesh->nodes.size(), 13u);
}

TEST(ImportedBody, MayTouchItselfAtACrack) {
  // 2 x 2 cells with a crack from the left to the middle: nodes 3 and 9 lie at (0, 1).
  MeshText mesh;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 2; ++i) mesh.nodes.push_back({i, j});
  mesh.nodes.push_back({0, 1});
  mesh.cells = {{9, {0, 1, 4, 3}, 1}, {9, {1, 2, 5, 4}, 1}, {9, {9, 4, 7, 6}, 1}, {9, {4, 5, 8, 7}, 1}};
  const ImportedBody body = body_of(mesh);
  EXPECT_EQ(body.outline.edges.size(), 7u);  // the left side in two, and the two faces of the crack
  EXPECT_DOUBLE_EQ(body.outline.area(), 4.0);
  EXPECT_NO_THROW(parse_model(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies: {{plate: {{material: steel, mesh: {{file: {}}}}}}}
supports: [{{on: plate.edge_1, fix: [x, y]}}]
loads: {{pull: {{on: plate.edge_3, force: [0, 1]}}}}
)",
                                          mesh.file()),
                              "model.yaml"));
}

TEST(ImportedBody, NamesAreMadeValid) {
  EXPECT_EQ(model::name_from("My surface"), "My_surface");
  EXPECT_EQ(model::name_from("5"), "_5");
  EXPECT_EQ(model::name_from("crest-1"), "crest-1");
  EXPECT_EQ(model::name_from("-a.b"), "_-a_b");
  EXPECT_EQ(model::name_from(""), "_");
}

std::string model_of(const std::string& body, const std::string& rest = "") {
  return "scabo: 1\nmaterials: {rock: {young: 1, poisson: 0.3}, steel: {young: 2, poisson: 0.3}}\nbodies: {part: {" +
         body + "}}\nsupports: [{on: part.edge_1, fix: [x, y]}]\nloads: {pull: {on: part.edge_3, force: [0, 1]}}\n" +
         rest;
}

TEST(ImportedBody, MaterialsOfRegions) {
  const std::string file = mesh_of_rectangle(9, 4.0, 2.0, 4, 2, [](int i, int) { return i < 2 ? 1 : 2; }).file();
  const auto materials = [&](const std::string& keys) {
    return parse_model(model_of(keys + ", mesh: {file: " + file + "}"), "model.yaml").bodies[0].region_materials;
  };
  EXPECT_THAT(materials("material: rock"), ElementsAre(0, 0));
  EXPECT_THAT(materials("material: rock, materials: {region_2: steel}"), ElementsAre(0, 1));
  EXPECT_THAT(materials("materials: {region_2: rock, region_1: steel}"), ElementsAre(1, 0));
}

TEST(ImportedBody, IsReadBesideTheModelFile) {
  const std::filesystem::path file = mesh_of_rectangle(9, 1.0, 1.0, 1, 1).file();
  const std::string model = model_of("material: rock, mesh: {file: " + file.filename().string() + "}");
  EXPECT_NO_THROW(parse_model(model, (file.parent_path() / "model.yaml").string()));
  EXPECT_THROW(parse_model(model, "/nowhere/model.yaml"), InputError);
}

TEST(ImportedBody, WarnsOfPiecesThatNoPlaceNames) {
  MeshText mesh = mesh_of_rectangle(9, 4.0, 1.0, 4, 1);
  for (const int i : {0, 3}) mesh.cells.push_back({3, {i, i + 1}, 1});  // the two ends of the bottom
  mesh.cells.push_back({3, {3, 4}, 2});                                 // the second one by another name
  const auto warnings = [&](const std::string& places, const std::string& more = "") {
    return texts_of(parse_model("scabo: 1\nmaterials: {rock: {young: 1, poisson: 0}}\n"
                                "bodies: {part: {material: rock, mesh: {file: " +
                                    mesh.file() + "}}}\n" + places +
                                    "loads: {down: {on: {body: part, near: [2, 1]}, force: [0, -1]}" + more + "}\n",
                                "model.yaml")
                        .warnings);
  };
  const std::string support = "supports:\n  - {on: part.boundary_1, fix: [x, y]}\n";
  const auto tells = ElementsAre(HasSubstr("part.boundary_1 is its first piece, and part.boundary_1_2 the next"));
  EXPECT_THAT(warnings(support), tells);
  EXPECT_THAT(warnings(support + "  - {on: part.boundary_1, fix: [x]}\n"), tells);
  EXPECT_THAT(warnings(support + "  - {on: part.boundary_1_2, fix: [x]}\n"), IsEmpty());
  EXPECT_THAT(warnings("supports:\n  - {on: part.boundary_1_2, fix: [x, y]}\n  - {on: part.boundary_1, fix: [x]}\n"),
              IsEmpty());
  EXPECT_THAT(warnings(support, ", push: {on: part.boundary_2, pressure: 1}"), IsEmpty());
  EXPECT_THAT(warnings("supports:\n  - {on: part.boundary_1_2, fix: [x, y]}\n"), IsEmpty());
}

}  // namespace
}  // namespace scabo::input
