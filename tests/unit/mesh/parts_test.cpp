// Few super-elements for shapes that no point sees, and triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scabo/mesh/plane/domain_triangles.hpp"
#include "scabo/mesh/plane/star_cells.hpp"
#include "unit/mesh/domains.hpp"

namespace scabo::mesh {
namespace {

Domain plate_with_a_hole(int facets_of_quarter) {
  Domain domain = test::domain_of({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, 0.5);
  for (int quarter = 0; quarter < 4; ++quarter)
    domain.lines.push_back(
        test::arc({2, 1}, 0.5, -0.5 * std::numbers::pi * quarter, -0.5 * std::numbers::pi, facets_of_quarter));
  return domain;
}

TEST(StarCells, AConvexShapeIsOneCell) {
  const Domain square = test::domain_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.25);
  const PolygonMesh mesh = star_cells(square);
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.nodes.size(), 16u);
  test::expect_valid(square, mesh, "square");
}

TEST(StarCells, AnLIsOneCellAndAUIsTwoOrThree) {
  const Domain l = test::domain_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.25);
  EXPECT_EQ(star_cells(l).cells.size(), 1u);
  const Domain u = test::domain_of({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.25);
  const PolygonMesh parts = star_cells(u);
  EXPECT_GE(parts.cells.size(), 2u);
  EXPECT_LE(parts.cells.size(), 3u);
  test::expect_valid(u, parts, "U");
}

TEST(StarCells, GoRoundAHole) {
  const Domain plate = plate_with_a_hole(4);
  const PolygonMesh mesh = star_cells(plate);
  EXPECT_GE(mesh.cells.size(), 3u);  // no two cells go round a hole so that a point sees each of them
  EXPECT_LE(mesh.cells.size(), 6u);
  test::expect_valid(plate, mesh, "plate with a hole");
  // Every centre sees the arcs themselves: it lies beyond the tangents at the ends of the facets.
  for (std::size_t line = 4; line < plate.lines.size(); ++line)
    for (std::size_t k = 0; k + 1 < plate.lines[line].points.size(); ++k) {
      const int a = mesh.left[line][k], b = mesh.left[line][k + 1];
      for (const PolygonCell& cell : mesh.cells)
        for (std::size_t i = 0; i < cell.nodes.size(); ++i)
          if (cell.nodes[i] == a && cell.nodes[(i + 1) % cell.nodes.size()] == b)
            for (const int end : {a, b}) {
              const Vec2 outwards = mesh.nodes[static_cast<std::size_t>(end)] - Vec2(2, 1);
              EXPECT_GT((cell.centre - mesh.nodes[static_cast<std::size_t>(end)]).dot(outwards), 0.0);
            }
    }
}

TEST(StarCells, KeepRegionsApart) {
  Domain domain = test::domain_of({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, 0.5);
  for (DomainLine line : test::loop({{1, 0.5}, {3, 0.5}, {3, 1.5}, {1, 1.5}}, domain.size, 1, 0))
    domain.lines.push_back(line);
  const PolygonMesh mesh = star_cells(domain);
  test::expect_valid(domain, mesh, "inclusion");
  EXPECT_EQ(std::count_if(mesh.cells.begin(), mesh.cells.end(), [](const PolygonCell& c) { return c.region == 1; }), 1);
}

TEST(StarCells, OfRandomShapesAreValid) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.4, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Vec2> corners;
    const int count = 3 + trial % 15;
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      corners.push_back(radius(random) * Vec2(std::cos(angle), std::sin(angle)) + Vec2(0.3 * std::sin(3.0 * angle), 0));
    }
    const Domain domain = test::domain_of(corners, 0.3);
    PolygonMesh mesh;
    try {
      mesh = star_cells(domain);
    } catch (const InputError&) {
      continue;  // this outline crosses itself
    }
    test::expect_valid(domain, mesh, "trial " + std::to_string(trial));
  }
}

TEST(TriangleMesh, OfAPlateWithAHoleIsValid) {
  const Domain plate = plate_with_a_hole(5);
  const PolygonMesh mesh = triangle_mesh(plate);
  test::expect_valid(plate, mesh, "plate with a hole");
  double least = 1e9;  // height over length of the worst side: thin triangles have small ones
  for (const PolygonCell& cell : mesh.cells) {
    ASSERT_EQ(cell.nodes.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 &a = mesh.nodes[static_cast<std::size_t>(cell.nodes[i])],
                 &b = mesh.nodes[static_cast<std::size_t>(cell.nodes[(i + 1) % 3])],
                 &c = mesh.nodes[static_cast<std::size_t>(cell.nodes[(i + 2) % 3])];
      least = std::min(least, cross(b - a, c - a) / (b - a).squaredNorm());
    }
  }
  EXPECT_GT(least, 0.2);
}

}  // namespace
}  // namespace scabo::mesh
