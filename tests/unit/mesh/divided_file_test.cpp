#include "scabo/mesh/plane/divided_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scabo::mesh {
namespace {

files::ImportedMesh two_squares() {
  files::ImportedMesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  mesh.cells = {{files::CellKind::quad4, {0, 1, 4, 3}}, {files::CellKind::quad4, {1, 2, 5, 4}}};
  mesh.regions = {"all"};
  mesh.facet_sets = {{"bottom", {{0, 1, -1}, {1, 2, -1}}}};
  return mesh;
}

double area(const files::ImportedMesh& mesh) {
  double sum = 0.0;
  for (const files::ImportedCell& cell : mesh.cells) sum += files::area_of(mesh, cell);
  return sum;
}

// The left square becomes four; the right one keeps its place and gets a fifth corner.
TEST(DividedFile, NeighbourTakesTheNewPoint) {
  const auto size = [](const Vec2& x) { return x.x() < 1.0 ? 0.5 : 1.0; };
  const files::ImportedMesh mesh = divided_mesh(two_squares(), size, 1e6);
  ASSERT_EQ(mesh.cells.size(), 5);
  EXPECT_EQ(mesh.nodes.size(), 6 + 5);
  int fives = 0;
  for (const files::ImportedCell& cell : mesh.cells)
    fives += cell.corners() == 5 && cell.kind == files::CellKind::polygon;
  EXPECT_EQ(fives, 1);
  EXPECT_NEAR(area(mesh), 2.0, 1e-14);
  ASSERT_EQ(mesh.facet_sets.front().facets.size(), 3);
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.facet_sets.front().facets[0].end)], Vec2(0.5, 0.0));
}

TEST(DividedFile, EveryCellToTheWantedSize) {
  const files::ImportedMesh mesh = divided_mesh(
      two_squares(), [](const Vec2&) { return 0.25; }, 1e6);
  EXPECT_EQ(mesh.cells.size(), 32);
  EXPECT_EQ(mesh.nodes.size(), 9 * 5);
  for (const files::ImportedCell& cell : mesh.cells) EXPECT_EQ(cell.kind, files::CellKind::quad4);
}

TEST(DividedFile, NoCellIsTooLarge) {
  const files::ImportedMesh given = two_squares();
  const files::ImportedMesh mesh = divided_mesh(
      given, [](const Vec2&) { return 1.0; }, 1e6);
  EXPECT_EQ(mesh.cells.size(), 2);
  EXPECT_EQ(mesh.nodes.size(), given.nodes.size());
}

// New points of a curved side lie on its parabola, and those of a triangle make three quadrilaterals.
TEST(DividedFile, CurvedSidesKeepTheirPlace) {
  files::ImportedMesh mesh;
  mesh.nodes = {{0, 0}, {2, 0}, {0, 2}, {1, -0.5}, {1, 1}, {0, 1}};
  mesh.cells = {{files::CellKind::triangle6, {0, 1, 2, 3, 4, 5}}};
  mesh.regions = {"all"};
  mesh.facet_sets = {{"bow", {{0, 1, 3}}}};
  const double before = area(mesh);
  const auto y = [](double x) { return 0.5 * x * (x - 2.0); };
  for (const double size : {1.9, 0.9, 0.4}) {
    const files::ImportedMesh fine = divided_mesh(
        mesh, [&](const Vec2&) { return size; }, 1e6);
    EXPECT_NEAR(area(fine), before, 1e-13);
    EXPECT_GE(fine.cells.size(), 3);
    for (const files::Facet& facet : fine.facet_sets.front().facets)
      for (const int node : {facet.start, facet.middle, facet.end}) {
        const Vec2& x = fine.nodes[static_cast<std::size_t>(node)];
        EXPECT_NEAR(x.y(), y(x.x()), 1e-14);
      }
    for (const files::ImportedCell& cell : fine.cells) EXPECT_GT(files::area_of(fine, cell), 0.0);
  }
}

TEST(DividedFile, EndsWhenThereAreTooMany) {
  const files::ImportedMesh mesh = divided_mesh(
      two_squares(), [](const Vec2&) { return 1e-6; }, 1000);
  EXPECT_GT(mesh.cells.size(), 1000);
  EXPECT_LT(mesh.cells.size(), 1010);
}

}  // namespace
}  // namespace scabo::mesh
