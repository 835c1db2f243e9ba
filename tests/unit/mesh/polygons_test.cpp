// Meshes of polygons: every mesh tiles its domain with cells that are seen from their centres and keeps all lines.
#include "scabo/mesh/plane/polygons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "domains.hpp"
#include "scabo/base/error.hpp"
#include "support/random.hpp"

namespace scabo::mesh {
namespace {

using test::arc, test::domain_of, test::expect_valid, test::loop, test::MeshFigures, test::scaled, test::straight;

constexpr double pi = std::numbers::pi;

const std::vector<Vec2> unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const std::vector<Vec2> l_shape{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

MeshFigures mesh_and_check(const Domain& domain, const std::string& name) {
  return expect_valid(domain, polygon_mesh(domain), name);
}

double constant_tenth(const Vec2&) { return 0.1; }

// A square of 1 x 1 with a hole, given as lines that have the outside on their right.
Domain with_hole(std::vector<DomainLine> hole, double size) {
  Domain domain = domain_of(unit_square, size);
  domain.lines.insert(domain.lines.end(), hole.begin(), hole.end());
  return domain;
}

double vertices_inside(const Domain& domain) {
  FormerVertices vertices;
  polygon_mesh(domain, vertices);
  return static_cast<double>(vertices.inside.points.size());
}

DomainLine crack(const Vec2& a, const Vec2& b, int facets) {
  DomainLine line = straight(a, b, facets, 0, 0);
  line.crack = true;
  return line;
}

TEST(Polygons, Square) {
  const Domain domain = domain_of(unit_square, 0.1);
  const PolygonMesh mesh = polygon_mesh(domain);
  const MeshFigures figures = expect_valid(domain, mesh, "square");
  EXPECT_EQ(figures.euler, 1);
  EXPECT_GT(figures.visibility, 0.1);
  EXPECT_GT(figures.shortest, 0.1);
  // Cells have about the area of a square of the wanted size.
  EXPECT_GT(mesh.cells.size(), 80u);
  EXPECT_LT(mesh.cells.size(), 130u);
}

TEST(Polygons, FewFacets) {
  for (const double size : {3.0, 1.0, 0.5, 0.34, 0.25})
    EXPECT_EQ(mesh_and_check(domain_of(unit_square, size), "square " + std::to_string(size)).euler, 1);
  for (const double size : {3.0, 1.0, 0.5, 0.34, 0.25})
    EXPECT_EQ(mesh_and_check(domain_of(l_shape, size), "L " + std::to_string(size)).euler, 1);
  EXPECT_EQ(mesh_and_check(domain_of({{0, 0}, {1, 0}, {0, 1}}, 2.0), "triangle").euler, 1);
}

TEST(Polygons, ReentrantCorner) {
  Domain domain = domain_of(l_shape, 0.13);
  EXPECT_EQ(mesh_and_check(domain, "node at the corner").euler, 1);
  domain.centres = {{1, 1}};
  const PolygonMesh mesh = polygon_mesh(domain);
  EXPECT_EQ(expect_valid(domain, mesh, "centre at the corner").euler, 1);
  const auto open = [](const PolygonCell& cell) { return cell.open; };
  ASSERT_EQ(std::count_if(mesh.cells.begin(), mesh.cells.end(), open), 1);
  EXPECT_EQ(std::find_if(mesh.cells.begin(), mesh.cells.end(), open)->centre, Vec2(1, 1));
}

TEST(Polygons, NarrowNotch) {
  // A notch of 3 degrees: its cell must be divided.
  const double half = std::tan(1.5 * pi / 180.0);
  EXPECT_EQ(mesh_and_check(domain_of({{-1, -1}, {1, -1}, {1, 1}, {half, 1}, {0, 0}, {-half, 1}, {-1, 1}}, 0.1), "notch")
                .euler,
            1);
}

TEST(Polygons, Holes) {
  std::vector<Vec2> corners{{0.4, 0.3}, {0.4, 0.6}, {0.7, 0.6}, {0.7, 0.3}};
  EXPECT_EQ(mesh_and_check(with_hole(loop(corners, constant_tenth), 0.1), "square hole").euler, 0);
  for (const int facets : {4, 6, 8, 12, 16, 40})
    EXPECT_EQ(mesh_and_check(with_hole({arc({0.5, 0.5}, 0.2, 0.3, -2 * pi, facets)}, 0.1),
                             "round hole " + std::to_string(facets))
                  .euler,
              0);
  EXPECT_EQ(
      mesh_and_check(with_hole({arc({0.5, 0.5}, 0.2, 0, -pi, 9), arc({0.5, 0.5}, 0.2, pi, -pi, 9)}, 0.1), "two arcs")
          .euler,
      0);
}

TEST(Polygons, Discs) {
  for (const int facets : {3, 4, 5, 7, 12, 13, 30, 100}) {
    Domain domain{{arc({1, 2}, 3.0, 0.1, 2 * pi, facets)}, [&](const Vec2&) { return 6 * pi / facets; }, {}};
    EXPECT_EQ(mesh_and_check(domain, "disc " + std::to_string(facets)).euler, 1);
  }
  // Half a disc of two facets, and a lens of two arcs.
  EXPECT_EQ(mesh_and_check(
                {{arc({0, 0}, 1, 0, pi, 2), straight({-1, 0}, {1, 0}, 1)}, [](const Vec2&) { return 1.0; }, {}}, "half")
                .euler,
            1);
  const double far = std::sqrt(3.0);
  EXPECT_EQ(mesh_and_check({{arc({0, -far}, 2, pi / 3, pi / 3, 2), arc({0, far}, 2, 4 * pi / 3, pi / 3, 2)},
                            [](const Vec2&) { return 0.5; },
                            {}},
                           "lens")
                .euler,
            1);
}

TEST(Polygons, SlantedBorderOfMaterials) {
  Domain domain;
  domain.size = constant_tenth;
  const Vec2 a(0.3, 0), b(0.6, 1);
  domain.lines = {straight({0, 0}, a, 3, 0), straight(a, {1, 0}, 7, 1), straight({1, 0}, {1, 1}, 10, 1),
                  straight({1, 1}, b, 4, 1), straight(b, {0, 1}, 6, 0), straight({0, 1}, {0, 0}, 10, 0),
                  straight(a, b, 10, 0, 1)};
  EXPECT_EQ(mesh_and_check(domain, "nodes at the ends").euler, 1);
  domain.centres = {a, b};
  const PolygonMesh mesh = polygon_mesh(domain);
  EXPECT_EQ(expect_valid(domain, mesh, "centres at the ends").euler, 1);
  int of_both = 0;
  for (const PolygonCell& cell : mesh.cells)
    if (!cell.side_regions.empty()) {
      EXPECT_TRUE(cell.open);
      EXPECT_EQ(std::set<int>(cell.side_regions.begin(), cell.side_regions.end()), (std::set<int>{0, 1}));
      ++of_both;
    }
  EXPECT_EQ(of_both, 2);
}

TEST(Polygons, ThreeMaterialsMeetInside) {
  Domain domain;
  domain.size = constant_tenth;
  const Vec2 centre(0.55, 0.45), a(0.5, 0), b(1, 0.7), c(0, 0.6);
  domain.lines = {straight({0, 0}, a, 5, 0),   straight(a, {1, 0}, 5, 1),       straight({1, 0}, b, 7, 1),
                  straight(b, {1, 1}, 3, 2),   straight({1, 1}, {0, 1}, 10, 2), straight({0, 1}, c, 4, 2),
                  straight(c, {0, 0}, 6, 0),   straight(centre, a, 5, 1, 0),    straight(centre, b, 5, 2, 1),
                  straight(centre, c, 6, 0, 2)};
  // Left of the line from the centre down to `a` is the region to the east of it.
  EXPECT_EQ(mesh_and_check(domain, "node").euler, 1);
  domain.centres = {centre};
  const PolygonMesh mesh = polygon_mesh(domain);
  EXPECT_EQ(expect_valid(domain, mesh, "centre").euler, 1);
  const auto found = std::find_if(mesh.cells.begin(), mesh.cells.end(),
                                  [](const PolygonCell& cell) { return !cell.side_regions.empty(); });
  ASSERT_NE(found, mesh.cells.end());
  EXPECT_FALSE(found->open);
  EXPECT_EQ(std::set<int>(found->side_regions.begin(), found->side_regions.end()), (std::set<int>{0, 1, 2}));
}

TEST(Polygons, EdgeCrack) {
  for (const int facets : {1, 2, 3, 5, 12}) {
    Domain domain;
    domain.size = constant_tenth;
    domain.lines = loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.52}}, constant_tenth);
    domain.lines.push_back(crack({0, 0.52}, {0.5, 0.5}, facets));
    const std::string name = "edge crack " + std::to_string(facets);
    const PolygonMesh mesh = polygon_mesh(domain);
    EXPECT_EQ(expect_valid(domain, mesh, name).euler, 1);
    EXPECT_EQ(mesh.left.back().back(), mesh.right.back().back());
    EXPECT_NE(mesh.left.back().front(), mesh.right.back().front());
    domain.centres = {{0.5, 0.5}};
    const PolygonMesh with_tip = polygon_mesh(domain);
    EXPECT_EQ(expect_valid(domain, with_tip, name + ", tip a centre").euler, 1);
    for (std::size_t k = 0; k < with_tip.left.back().size(); ++k)
      EXPECT_NE(with_tip.left.back()[k], with_tip.right.back()[k]);
    domain.centres.push_back({0, 0.52});
    EXPECT_EQ(mesh_and_check(domain, name + ", both ends centres").euler, 1);
  }
}

TEST(Polygons, InnerCracks) {
  for (const int facets : {1, 2, 3, 6}) {
    Domain domain = domain_of(unit_square, 0.1);
    domain.lines.push_back(crack({0.3, 0.4}, {0.7, 0.6}, facets));
    const std::string name = "inner crack " + std::to_string(facets);
    const PolygonMesh mesh = polygon_mesh(domain);
    EXPECT_EQ(expect_valid(domain, mesh, name).euler, 0);
    EXPECT_EQ(mesh.left.back().size(), facets == 1 ? 3u : static_cast<std::size_t>(facets) + 1);
    domain.centres = {{0.3, 0.4}};
    EXPECT_EQ(mesh_and_check(domain, name + ", one tip a centre").euler, 0);
    domain.centres = {{0.3, 0.4}, {0.7, 0.6}};
    EXPECT_EQ(mesh_and_check(domain, name + ", tips are centres").euler, 0);
  }
  // Bent, and branched: three lines meet in a point.
  Domain domain = domain_of(unit_square, 0.1);
  for (const Vec2& end : {Vec2(0.2, 0.3), Vec2(0.75, 0.35), Vec2(0.6, 0.8)})
    domain.lines.push_back(crack({0.5, 0.5}, end, 3));
  EXPECT_EQ(mesh_and_check(domain, "branched").euler, 0);
  domain.centres = {{0.2, 0.3}, {0.75, 0.35}, {0.6, 0.8}};
  EXPECT_EQ(mesh_and_check(domain, "branched, tips are centres").euler, 0);
  domain.centres.push_back({0.5, 0.5});
  mesh_and_check(domain, "branched, all ends are centres");
}

TEST(Polygons, EmbeddedLineWithoutACrack) {
  Domain domain = domain_of(unit_square, 0.1);
  domain.lines.push_back(straight({0.3, 0.4}, {0.7, 0.6}, 4, 0, 0));
  EXPECT_EQ(mesh_and_check(domain, "line").euler, 1);
}

TEST(Polygons, SlenderStrip) {
  for (const double size : {0.1, 0.5, 1.0, 3.0, 10.0})
    EXPECT_EQ(
        mesh_and_check(domain_of({{0, 0}, {100, 0}, {100, 1}, {0, 1}}, size), "strip " + std::to_string(size)).euler,
        1);
}

TEST(Polygons, GradedSize) {
  const auto size = [](const Vec2& p) { return std::clamp(0.25 * (p - Vec2(0, 0)).norm(), 0.001, 0.1); };
  Domain domain{{}, size, {}};
  // Facets follow the size along the lines.
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = unit_square[i], b = unit_square[(i + 1) % 4];
    DomainLine line;
    line.points = {a};
    for (double t = size(a); t < 1.0 - 0.6 * size(b); t += size(a + t * (b - a)))
      line.points.push_back(a + t * (b - a));
    line.points.push_back(b);
    domain.lines.push_back(line);
  }
  const PolygonMesh mesh = polygon_mesh(domain);
  const MeshFigures figures = expect_valid(domain, mesh, "graded");
  EXPECT_EQ(figures.euler, 1);
  EXPECT_GT(figures.visibility, 0.05);
  double smallest = 1.0, largest = 0.0;
  for (const PolygonCell& cell : mesh.cells) {
    const double side =
        (mesh.nodes[static_cast<std::size_t>(cell.nodes[0])] - mesh.nodes[static_cast<std::size_t>(cell.nodes[1])])
            .norm();
    smallest = std::min(smallest, side);
    largest = std::max(largest, side);
  }
  EXPECT_LT(smallest, 0.0012);
  EXPECT_GT(largest, 0.05);
}

TEST(Polygons, FinerInside) {
  // Spacing of many levels, away from lines: the wanted areas are reached everywhere.
  const Vec2 place(0.5, 0.6);
  Domain domain = domain_of(unit_square, 0.02);
  domain.size = [&](const Vec2& p) { return std::clamp(0.25 * (p - place).norm(), 0.0004, 0.02); };
  const PolygonMesh mesh = polygon_mesh(domain);
  EXPECT_EQ(expect_valid(domain, mesh, "finer inside").euler, 1);
  double cells = 0.0;
  for (const PolygonCell& cell : mesh.cells)
    if ((cell.centre - place).norm() < 0.05) cells += 1.0;
  // The integral of 1 / size^2: pi r0^2 / s0^2 + 2 pi / 0.25^2 ln(r / r0), r0 = 4 s0 where the size begins to grow.
  const double wanted = 16 * pi + 32 * pi * std::log(0.05 / 0.0016);
  EXPECT_NEAR(cells / wanted, 1.0, 0.15);
}

// Random polygons around a point (star-shaped from it, not convex), with facets and sizes that do not fit each other.
TEST(Polygons, RandomShapes) {
  std::mt19937 random(11);
  double least = 1e9;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = test::whole(random, 3, 12);
    std::vector<Vec2> corners;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * pi * (i + test::uniform(random, -0.3, 0.3)) / n;
      corners.push_back(test::uniform(random, 0.3, 1.0) * Vec2(std::cos(angle), std::sin(angle)));
    }
    const double size = std::exp(test::uniform(random, std::log(0.03), std::log(0.5)));
    Domain domain{{}, [size](const Vec2&) { return size; }, {}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double facet = size * test::uniform(random, 0.3, 2.0);
      const std::vector<DomainLine> lines = loop(corners, [&](const Vec2&) { return facet; });
      domain.lines.push_back(lines[i]);
    }
    if (trial % 2 == 1)
      for (const Vec2& corner : corners)
        if (test::whole(random, 0, 3) == 0) domain.centres.push_back(corner);
    const MeshFigures figures = mesh_and_check(domain, "shape " + std::to_string(trial));
    EXPECT_EQ(figures.euler, 1);
    least = std::min(least, figures.visibility);
    if (HasFailure()) break;
  }
  RecordProperty("least_visibility", std::to_string(least));
}

TEST(Polygons, UnitsDoNotMatter) {
  Domain domain = with_hole({arc({0.5, 0.5}, 0.2, 0.3, -2 * pi, 16)}, 0.1);
  domain.lines.push_back(crack({0.1, 0.1}, {0.2, 0.3}, 3));
  const PolygonMesh mesh = polygon_mesh(domain);
  for (const double factor : {std::ldexp(1.0, -20), std::ldexp(1.0, 20)}) {
    const PolygonMesh other = polygon_mesh(scaled(domain, factor));
    ASSERT_EQ(mesh.cells.size(), other.cells.size());
    ASSERT_EQ(mesh.nodes.size(), other.nodes.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) EXPECT_EQ(mesh.cells[c].nodes, other.cells[c].nodes);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) EXPECT_EQ(Vec2(factor * mesh.nodes[i]), other.nodes[i]);
  }
  mesh_and_check(scaled(domain, 1e-6), "small");
  mesh_and_check(scaled(domain, 1e6), "large");
}

TEST(Polygons, FarFromTheOrigin) {
  mesh_and_check(domain_of({{1e4, 1e4}, {1e4 + 1, 1e4}, {1e4 + 1, 1e4 + 1}, {1e4, 1e4 + 1}}, 0.1), "far");
}

// Of the vertices before all stay, so that the mesh of the same domain is the same to the last bit.
TEST(Polygons, WhatStaysOfTheSameDomainIsAllOfIt) {
  Domain domain = with_hole({arc({0.5, 0.5}, 0.2, 0.3, -2 * pi, 32)}, 0.03);
  domain.size = [](const Vec2& x) { return 0.03 + 0.2 * x.norm(); };
  FormerVertices former;
  const PolygonMesh a = polygon_mesh(domain, former), b = polygon_mesh(domain, former);
  ASSERT_GT(a.cells.size(), 100u);
  EXPECT_EQ(former.inside.kept, former.inside.points.size());
  EXPECT_EQ(a.nodes, b.nodes);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t c = 0; c < a.cells.size(); ++c) {
    EXPECT_EQ(a.cells[c].nodes, b.cells[c].nodes);
    EXPECT_EQ(a.cells[c].centre, b.cells[c].centre);
  }
}

// A crack that goes round in a square by short pieces, with small cells at its tip: every mesh is one that its domain
// may have, with cells that are seen as well as those of a mesh made at once.
TEST(Polygons, EveryMeshOfACrackThatGrowsIsValid) {
  FormerVertices former;
  Domain domain = domain_of(unit_square, 0.1);
  Vec2 tip(0.8, 0.5);
  for (int k = 0; k < 60; ++k) {
    const double angle = 2 * pi * (k + 1) / 80.0;
    const Vec2 next(0.5 + 0.3 * std::cos(angle), 0.5 + 0.3 * std::sin(angle));
    domain.lines.push_back(crack(tip, next, 2));
    tip = next;
    domain.centres = {Vec2(0.8, 0.5), tip};
    domain.size = [tip](const Vec2& x) { return std::min(0.1, 0.01 + 0.3 * (x - tip).norm()); };
    const MeshFigures figures = expect_valid(domain, polygon_mesh(domain, former), "piece " + std::to_string(k));
    EXPECT_GT(figures.visibility, 0.03) << k;
    if (k > 0) {
      EXPECT_GT(former.inside.kept, former.inside.points.size() / 2) << k;
    }
  }
  EXPECT_LT(former.inside.points.size(), 1.3 * vertices_inside(domain));
}

TEST(Polygons, SameInputSameMesh) {
  const Domain domain = with_hole({arc({0.5, 0.5}, 0.2, 0.3, -2 * pi, 16)}, 0.03);
  const PolygonMesh a = polygon_mesh(domain), b = polygon_mesh(domain);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) EXPECT_EQ(a.nodes[i], b.nodes[i]);
  for (std::size_t c = 0; c < a.cells.size(); ++c) EXPECT_EQ(a.cells[c].nodes, b.cells[c].nodes);
}

TEST(Polygons, LinesThatCrossAreRefused) {
  EXPECT_THROW(polygon_mesh(domain_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 0.13)), InputError);
  Domain domain = domain_of(unit_square, 0.1);
  domain.lines.pop_back();
  EXPECT_THROW(polygon_mesh(domain), InputError);  // not closed
  domain = domain_of(unit_square, 0.1);
  domain.centres = {{0.5, 0.5}};
  EXPECT_THROW(polygon_mesh(domain), InputError);
}

}  // namespace
}  // namespace scabo::mesh
