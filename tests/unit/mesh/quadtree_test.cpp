// Quadtree meshes of bodies with lines of all kinds.
#include "scabo/mesh/plane/quadtree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/base/error.hpp"
#include "support/random.hpp"
#include "unit/mesh/polygon_mesh_checks.hpp"

namespace scabo::mesh {
namespace {

using test::check_polygon_mesh;
using test::MeshSummary;

DomainLine straight(const Vec2& a, const Vec2& b, int left = 0, int right = -1) {
  return {{a, b}, {}, left, right, false};
}

DomainLine crack(const Vec2& a, const Vec2& b, int region = 0) { return {{a, b}, {}, region, region, true}; }

DomainLine arc(const Vec2& centre, double radius, double from, double sweep, int left, int right) {
  const auto at = [&](double angle) { return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle))); };
  DomainLine line{{at(from), at(from + 0.5 * sweep), at(from + sweep)},
                  geometry::Arc{centre, radius, from, sweep},
                  left,
                  right,
                  false};
  return line;
}

void add_polygon(Domain& domain, const std::vector<Vec2>& corners, int left = 0, int right = -1) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    domain.lines.push_back(straight(corners[i], corners[(i + 1) % corners.size()], left, right));
  }
}

/// Two half circles, counter-clockwise.
void add_circle(Domain& domain, const Vec2& centre, double radius, int inside, int outside, double turned = 0.1) {
  const double half = std::numbers::pi;
  domain.lines.push_back(arc(centre, radius, turned, half, inside, outside));
  domain.lines.push_back(arc(centre, radius, turned + half, half, inside, outside));
  domain.lines.back().points.front() = domain.lines[domain.lines.size() - 2].points.back();
  domain.lines.back().points.back() = domain.lines[domain.lines.size() - 2].points.front();
}

std::vector<Vec2> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::function<double(const Vec2&)> uniform_size(double size) {
  return [size](const Vec2&) { return size; };
}

/// Corners of the polygon that the nodes of an open cell and its centre make, or of a closed cell.
Domain polygon_domain(const std::vector<Vec2>& corners, double size) {
  Domain domain;
  add_polygon(domain, corners);
  domain.size = uniform_size(size);
  return domain;
}

double area_of(const std::vector<Vec2>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
  return 0.5 * twice;
}

MeshSummary valid(const Domain& domain, const PolygonMesh& mesh) {
  MeshSummary summary = check_polygon_mesh(domain, mesh);
  EXPECT_EQ(summary.faults, "");
  EXPECT_LE(summary.worst_ratio, 2.0 + 1e-9);
  return summary;
}

TEST(QuadtreeMesh, UnitSquareHasExactlyNTimesNSquares) {
  for (int n : {1, 2, 3, 7, 10, 64}) {
    const Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 1.0 / n);
    const PolygonMesh mesh = quadtree_mesh(domain);
    const MeshSummary summary = valid(domain, mesh);
    EXPECT_EQ(mesh.cells.size(), std::size_t(n) * n);
    EXPECT_EQ(mesh.nodes.size(), std::size_t(n + 1) * (n + 1));
    EXPECT_EQ(summary.squares, n * n);
    for (int line = 0; line < 4; ++line) EXPECT_EQ(mesh.left[line].size(), std::size_t(n) + 1);
    EXPECT_NEAR(summary.areas[0], 1.0, 1e-13);
  }
}

TEST(QuadtreeMesh, RectanglesAreMeshedByUncutCells) {
  // 3 by 2 with sides of at most 0.3: 0.25 divides both. 1 by 0.77: rectangles that are nearly square.
  EXPECT_EQ(quadtree_mesh(polygon_domain(rectangle(-1, 5, 2, 7), 0.3)).cells.size(), 12u * 8u);
  const Domain domain = polygon_domain(rectangle(0, 0, 1, 0.77), 0.1);
  const PolygonMesh mesh = quadtree_mesh(domain);
  EXPECT_EQ(valid(domain, mesh).squares, int(mesh.cells.size()));
}

TEST(QuadtreeMesh, LShapeIsOfSquaresAlone) {
  const Domain domain = polygon_domain({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.25);
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  EXPECT_EQ(mesh.cells.size(), 48u);
  EXPECT_EQ(summary.squares, 48);
  EXPECT_NEAR(summary.areas[0], 3.0, 1e-12);
}

TEST(QuadtreeMesh, ReentrantCornerBecomesTheCentreOfAnOpenCell) {
  Domain domain = polygon_domain({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.25);
  domain.centres = {{1, 1}};
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  EXPECT_EQ(summary.open, 1);
  EXPECT_EQ(mesh.cells.size(), 48u - 3u + 1u);
  for (const PolygonCell& cell : mesh.cells) {
    if (!cell.open) continue;
    EXPECT_EQ(cell.centre, Vec2(1, 1));
    EXPECT_EQ(cell.nodes.size(), 7u);  // six sides of three squares
  }
  for (const Vec2& node : mesh.nodes) EXPECT_GT((node - Vec2(1, 1)).norm(), 0.2);
  EXPECT_EQ(mesh.left[2].size(), 4u);  // (2, 1) to (1, 1): its last quarter is a side face
}

TEST(QuadtreeMesh, SlantedReentrantCornerAsCentre) {
  std::vector<Vec2> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (Vec2& p : corners) p = Mat2{{std::cos(0.3), -std::sin(0.3)}, {std::sin(0.3), std::cos(0.3)}} * p;
  Domain domain = polygon_domain(corners, 0.2);
  domain.centres = {corners[3]};
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  EXPECT_EQ(summary.open, 1);
  EXPECT_NEAR(summary.areas[0], 3.0, 3e-12);
  EXPECT_GT(summary.least_clearance, 0.03);
}

TEST(QuadtreeMesh, PlateWithCircularHole) {
  Domain domain = polygon_domain(rectangle(-2, -2, 2, 2), 0.25);
  add_circle(domain, {0.1, 0.05}, 0.5, -1, 0);
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  // A chord that turns by a takes a^2 / 6 of its sector; chords are at most diagonals of cells, 0.71 rad.
  EXPECT_NEAR(summary.areas[0], 16.0 - 0.25 * std::numbers::pi, 0.25 * std::numbers::pi * 0.71 * 0.71 / 6.0);
  EXPECT_GT(summary.areas[0], 16.0 - 0.25 * std::numbers::pi);
  EXPECT_GT(summary.least_clearance, 0.03);
  EXPECT_GT(summary.least_side, 0.08);
}

TEST(QuadtreeMesh, SmallHoleInsideOneCell) {
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 0.5);
  add_circle(domain, {0.29, 0.23}, 1e-4, -1, 0);
  QuadtreeOptions options;
  options.min_size = 0.25;  // not enough: the hole must be cut
  const PolygonMesh mesh = quadtree_mesh(domain, options);
  valid(domain, mesh);
  EXPECT_GE(mesh.left[4].size() + mesh.left[5].size(), 5u);
}

TEST(QuadtreeMesh, DiscAndInclusion) {
  Domain domain;
  add_circle(domain, {0, 0}, 1.0, 0, -1, 0.0);
  add_circle(domain, {0, 0}, 0.5, 1, 0, 0.7);
  domain.size = uniform_size(0.2);
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  // A chord that turns by a takes a^2 / 6 of its sector; chords are at most diagonals of cells, 0.28 and 0.57 rad.
  EXPECT_NEAR(summary.areas[0] + summary.areas[1], std::numbers::pi, std::numbers::pi * 0.28 * 0.28 / 6.0);
  EXPECT_NEAR(summary.areas[1], 0.25 * std::numbers::pi, 0.25 * std::numbers::pi * 0.57 * 0.57 / 6.0);
  EXPECT_GT(summary.least_clearance, 0.03);
}

TEST(QuadtreeMesh, SlantedRectangleOfTwoRegions) {
  const double angle = 13.0 * std::numbers::pi / 180.0;
  const auto turned = [&](double x, double y) {
    return Vec2(x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle));
  };
  Domain domain;
  const std::vector<Vec2> p{turned(0, 0), turned(1.2, 0), turned(3, 0), turned(3, 1), turned(1.2, 1), turned(0, 1)};
  domain.lines = {straight(p[0], p[1], 0), straight(p[1], p[2], 1), straight(p[2], p[3], 1),   straight(p[3], p[4], 1),
                  straight(p[4], p[5], 0), straight(p[5], p[0], 0), straight(p[1], p[4], 0, 1)};
  for (double size : {1.0, 0.3, 0.11, 0.04, 0.013}) {
    domain.size = uniform_size(size);
    const PolygonMesh mesh = quadtree_mesh(domain);
    const MeshSummary summary = valid(domain, mesh);
    EXPECT_NEAR(summary.areas[0], 1.2, 1.2e-12);
    EXPECT_NEAR(summary.areas[1], 1.8, 1.8e-12);
    EXPECT_GT(summary.least_clearance, 0.03) << size;
    EXPECT_GT(summary.least_side, 0.08) << size;
  }
}

TEST(QuadtreeMesh, LinesThroughNodesOfTheGrid) {
  // A diamond in a square: its sides are diagonals of cells.
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 0.125);
  add_polygon(domain, {{0.5, 0.25}, {0.75, 0.5}, {0.5, 0.75}, {0.25, 0.5}}, 1, 0);
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  EXPECT_NEAR(summary.areas[1], 0.125, 1e-13);
  EXPECT_EQ(mesh.nodes.size(), 81u);
  EXPECT_EQ(mesh.cells.size(), 64u + 8u);
  // Slopes 1/2 and 3/4 through nodes, and lines along the grid.
  Domain other = polygon_domain({{0, 0}, {4, 0}, {4, 2}, {2, 3}, {0, 4}}, 0.5);
  other.lines.push_back(straight({0, 0}, {4, 2}, 1, 0));
  for (std::size_t line : {2u, 3u, 4u}) other.lines[line].left = 1;
  const MeshSummary second = valid(other, quadtree_mesh(other));
  EXPECT_NEAR(second.areas[0], 4.0, 1e-12);
  EXPECT_NEAR(second.areas[1], 8.0, 1e-12);
}

TEST(QuadtreeMesh, EdgeCrackWithTipAsCentre) {
  for (double height : {0.5, 0.53}) {
    Domain domain = polygon_domain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, height}}, 0.1);
    domain.lines.push_back(crack({0, height}, {0.47, height}));
    domain.centres = {{0.47, height}};
    const PolygonMesh mesh = quadtree_mesh(domain);
    const MeshSummary summary = valid(domain, mesh);
    EXPECT_EQ(summary.open, 1);
    EXPECT_NEAR(summary.areas[0], 1.0, 1e-12);
    EXPECT_EQ(mesh.left[5].size(), mesh.right[5].size());
    ASSERT_GE(mesh.left[5].size(), 3u);
    for (std::size_t k = 0; k < mesh.left[5].size(); ++k) {
      EXPECT_NE(mesh.left[5][k], mesh.right[5][k]);
      EXPECT_EQ(mesh.nodes[mesh.left[5][k]], mesh.nodes[mesh.right[5][k]]);
    }
    // The mouth: the edges above and below the crack end at different nodes.
    EXPECT_EQ(mesh.left[3].back(), mesh.left[5].front());
    EXPECT_EQ(mesh.left[4].front(), mesh.right[5].front());
    for (const PolygonCell& cell : mesh.cells) {
      if (!cell.open) continue;
      EXPECT_EQ(cell.nodes.front(),
                mesh.right[5].back() == cell.nodes.front() ? mesh.right[5].back() : mesh.left[5].back());
      EXPECT_NE(cell.nodes.front(), cell.nodes.back());
      EXPECT_EQ(mesh.nodes[cell.nodes.front()], mesh.nodes[cell.nodes.back()]);
    }
  }
}

TEST(QuadtreeMesh, InnerCrackWithAndWithoutCentres) {
  const Vec2 a(0.312, 0.401), b(0.655, 0.577);
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 0.1);
  domain.lines.push_back(crack(a, b));
  {
    const PolygonMesh mesh = quadtree_mesh(domain);
    EXPECT_EQ(valid(domain, mesh).open, 0);
    ASSERT_GE(mesh.left[4].size(), 4u);
    EXPECT_EQ(mesh.left[4].front(), mesh.right[4].front());
    EXPECT_EQ(mesh.left[4].back(), mesh.right[4].back());
    EXPECT_EQ(mesh.nodes[mesh.left[4].front()], a);
    EXPECT_EQ(mesh.nodes[mesh.left[4].back()], b);
    for (std::size_t k = 1; k + 1 < mesh.left[4].size(); ++k) EXPECT_NE(mesh.left[4][k], mesh.right[4][k]);
  }
  domain.centres = {a, b};
  const PolygonMesh mesh = quadtree_mesh(domain);
  EXPECT_EQ(valid(domain, mesh).open, 2);
  for (std::size_t k = 0; k < mesh.left[4].size(); ++k) EXPECT_NE(mesh.left[4][k], mesh.right[4][k]);
}

TEST(QuadtreeMesh, CornersOfRegionsAsCentres) {
  // A quadrilateral inclusion with a corner at (0.43, 0.52), and an edge crack that ends on a border between two
  // regions.
  const std::vector<Vec2> p{{0.43, 0.52}, {0.7, 0.3}, {0.81, 0.66}, {0.52, 0.84}};
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 0.06);
  add_polygon(domain, p, 1, 0);
  domain.centres = {p[0]};
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  EXPECT_EQ(summary.open, 0);
  EXPECT_NEAR(summary.areas[1], area_of(p), 1e-13);
  int found = 0;
  for (const PolygonCell& cell : mesh.cells) {
    if (cell.side_regions.empty()) continue;
    ++found;
    EXPECT_EQ(cell.centre, p[0]);
    EXPECT_EQ(cell.side_regions.size(), cell.nodes.size());
    EXPECT_GE(std::count(cell.side_regions.begin(), cell.side_regions.end(), 0), 4);
    EXPECT_GE(std::count(cell.side_regions.begin(), cell.side_regions.end(), 1), 2);
  }
  EXPECT_EQ(found, 1);

  Domain second;
  const std::vector<Vec2> q{{0, 0}, {0.55, 0}, {1, 0}, {1, 1}, {0.55, 1}, {0, 1}, {0, 0.47}, {0.55, 0.47}};
  second.lines = {straight(q[0], q[1], 0), straight(q[1], q[2], 1),    straight(q[2], q[3], 1),
                  straight(q[3], q[4], 1), straight(q[4], q[5], 0),    straight(q[5], q[6], 0),
                  straight(q[6], q[0], 0), straight(q[1], q[7], 0, 1), straight(q[7], q[4], 0, 1),
                  crack(q[6], q[7], 0)};
  second.centres = {q[7]};
  second.size = uniform_size(0.1);
  const PolygonMesh other = quadtree_mesh(second);
  const MeshSummary figures = valid(second, other);
  EXPECT_EQ(figures.open, 1);
  EXPECT_NEAR(figures.areas[0], 0.55, 1e-13);
  for (const PolygonCell& cell : other.cells) {
    if (!cell.open) continue;
    EXPECT_EQ(other.nodes[cell.nodes.front()], other.nodes[cell.nodes.back()]);
    EXPECT_NE(cell.nodes.front(), cell.nodes.back());
    EXPECT_EQ(cell.side_regions.front(), 0);
    EXPECT_EQ(cell.side_regions.back(), 0);
    EXPECT_GE(std::count(cell.side_regions.begin(), cell.side_regions.end(), 1), 2);
  }
}

TEST(QuadtreeMesh, BranchedCrack) {
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 0.07);
  const Vec2 fork(0.51, 0.49);
  domain.lines.push_back(crack({0.22, 0.31}, fork));
  domain.lines.push_back(crack(fork, {0.81, 0.55}));
  domain.lines.push_back(crack(fork, {0.45, 0.83}));
  domain.centres = {{0.22, 0.31}, {0.81, 0.55}, {0.45, 0.83}};
  const PolygonMesh mesh = quadtree_mesh(domain);
  EXPECT_EQ(valid(domain, mesh).open, 3);
  // Three nodes at the fork, each shared by the sides of two branches.
  EXPECT_EQ(mesh.left[4].back(), mesh.left[6].front());
  EXPECT_EQ(mesh.right[4].back(), mesh.right[5].front());
  EXPECT_EQ(mesh.left[5].front(), mesh.right[6].front());
  EXPECT_EQ(std::count(mesh.nodes.begin(), mesh.nodes.end(), fork), 3);
}

/// Lines of the tree are tangents of the hole where cells on one side of them are smaller than on the other.
TEST(QuadtreeMesh, HoleThatTouchesLinesOfTheTree) {
  for (int k = 0; k < 24; ++k) {
    const double turned = 2.0 * std::numbers::pi * k / 24.0;
    const Vec2 at = Vec2(0.1875, 0.2375) + (0.0125 + 0.0003 * (1 + k % 5)) * Vec2(std::cos(turned), std::sin(turned));
    Domain domain = polygon_domain(rectangle(0, 0, 1, 0.4), 1.0 / 32.0);
    add_circle(domain, {0.1875, 0.2375}, 0.0125, -1, 0, 0.0);
    domain.size = [at](const Vec2& p) { return std::min(1.0 / 32.0, 3.45e-4 + 0.5 * (p - at).norm()); };
    QuadtreeOptions options;
    options.turn = 0.25;
    options.curved_sides = true;
    const PolygonMesh mesh = quadtree_mesh(domain, options);
    const MeshSummary summary = valid(domain, mesh);
    EXPECT_GT(summary.least_side, 1e-3) << k;
  }
}

TEST(QuadtreeMesh, SizesGradedByAThousand) {
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 1.0);
  const Vec2 at(0.3, 0.4);
  domain.size = [at](const Vec2& p) { return 1e-4 + std::min(0.1, 0.3 * (p - at).norm()); };
  const PolygonMesh mesh = quadtree_mesh(domain);
  const MeshSummary summary = valid(domain, mesh);
  EXPECT_EQ(summary.squares, int(mesh.cells.size()));
  double least = 1.0, most = 0.0;
  for (const PolygonCell& cell : mesh.cells) {
    double width = 0.0;
    for (int node : cell.nodes) width = std::max(width, 2.0 * (mesh.nodes[node] - cell.centre).cwiseAbs().maxCoeff());
    EXPECT_LE(width, domain.size(cell.centre) * (1.0 + 1e-9));
    least = std::min(least, width);
    most = std::max(most, width);
  }
  EXPECT_GE(most / least, 1000.0 * (1.0 - 1e-9));
}

TEST(QuadtreeMesh, AbruptSizesAreBalanced) {
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 1.0);
  domain.size = [](const Vec2& p) { return (p - Vec2(0.3, 0.4)).norm() < 0.2 ? 1.0 / 256.0 : 0.25; };
  const MeshSummary summary = valid(domain, quadtree_mesh(domain));
  EXPECT_EQ(summary.worst_ratio, 2.0);
}

TEST(QuadtreeMesh, EqualCellsHaveEqualRelativeCoordinates) {
  Domain domain = polygon_domain(rectangle(0.1, 0.3, 3.1, 2.3), 1.0);
  domain.size = [](const Vec2& p) { return 0.02 + 0.1 * std::abs(p.x() - 1.0); };
  const PolygonMesh mesh = quadtree_mesh(domain);
  std::vector<std::vector<int>> kinds;  // relative to the centre in quarters of the width
  for (const PolygonCell& cell : mesh.cells) {
    double width = 0.0;
    for (int node : cell.nodes) width = std::max(width, 2.0 * (mesh.nodes[node] - cell.centre).cwiseAbs().maxCoeff());
    std::vector<int> kind;
    for (int node : cell.nodes) {
      for (int axis : {0, 1}) {
        const double place = 2.0 * (mesh.nodes[node] - cell.centre)[axis] / width;
        EXPECT_NEAR(place, std::round(place), 1e-12);
        kind.push_back(int(std::round(place)));
      }
    }
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  }
  EXPECT_LE(kinds.size(), 16u);
  EXPECT_GE(kinds.size(), 3u);
}

/// A random simple polygon: random points joined in a ring, crossings removed by reversing the part between.
std::vector<Vec2> random_polygon(std::mt19937& random, int n) {
  std::vector<Vec2> p;
  for (int k = 0; k < n; ++k) p.push_back({test::uniform(random, 0, 1), test::uniform(random, 0, 1)});
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < n; ++i) {
      for (int j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        const Vec2 a = p[i], b = p[i + 1], c = p[j], d = p[(j + 1) % n];
        if (cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0) {
          std::reverse(p.begin() + i + 1, p.begin() + j + 1);
          changed = true;
        }
      }
    }
  }
  if (area_of(p) < 0.0) std::reverse(p.begin(), p.end());
  return p;
}

TEST(QuadtreeMesh, TwoHundredRandomPolygons) {
  std::mt19937 random(5);
  for (int k = 0; k < 200; ++k) {
    const std::vector<Vec2> corners = random_polygon(random, test::whole(random, 3, 12));
    SCOPED_TRACE(k);
    const Domain domain = polygon_domain(corners, test::uniform(random, 0.03, 0.3));
    try {
      const PolygonMesh mesh = quadtree_mesh(domain);
      const MeshSummary summary = valid(domain, mesh);
      EXPECT_NEAR(summary.areas[0], area_of(corners), 1e-12);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(QuadtreeMesh, RandomStarsWithTheirReentrantCornersAsCentres) {
  std::mt19937 random(17);
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec2> corners;
    Domain domain;
    const int n = test::whole(random, 3, 7);
    for (int i = 0; i < 2 * n; ++i) {
      const double angle = std::numbers::pi * (i + test::uniform(random, -0.2, 0.2)) / n,
                   r = i % 2 ? test::uniform(random, 0.3, 0.5) : 1.0;
      corners.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    domain = polygon_domain(corners, test::uniform(random, 0.05, 0.2));
    int reentrant = 0;
    for (int i = 1; i < 2 * n; i += 2) {
      if (cross(corners[i] - corners[i - 1], corners[(i + 1) % (2 * n)] - corners[i]) > 0.0) continue;
      domain.centres.push_back(corners[i]);
      ++reentrant;
    }
    SCOPED_TRACE(k);
    try {
      const PolygonMesh mesh = quadtree_mesh(domain);
      const MeshSummary summary = valid(domain, mesh);
      EXPECT_NEAR(summary.areas[0], area_of(corners), 3e-12);
      EXPECT_EQ(summary.open, reentrant);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(QuadtreeMesh, ScaledByPowersOfTwoIsTheSameMesh) {
  std::mt19937 random(3);
  const std::vector<Vec2> corners = random_polygon(random, 9);
  const auto meshed = [&](double scale) {
    std::vector<Vec2> scaled;
    for (const Vec2& p : corners) scaled.push_back(scale * p);
    Domain domain = polygon_domain(scaled, scale * 0.06);
    domain.lines.back().points.back() = domain.lines.front().points.front();
    return quadtree_mesh(domain);
  };
  const PolygonMesh one = meshed(1.0);
  for (double scale : {1.0, std::ldexp(1.0, -40), std::ldexp(1.0, 30)}) {
    const PolygonMesh other = meshed(scale);
    ASSERT_EQ(one.cells.size(), other.cells.size());
    ASSERT_EQ(one.nodes.size(), other.nodes.size());
    for (std::size_t k = 0; k < one.nodes.size(); ++k) EXPECT_EQ(Vec2(scale * one.nodes[k]), other.nodes[k]);
    for (std::size_t k = 0; k < one.cells.size(); ++k) EXPECT_EQ(one.cells[k].nodes, other.cells[k].nodes);
    EXPECT_EQ(one.left, other.left);
  }
}

TEST(QuadtreeMesh, ManyDiscsAsInclusions) {
  Domain domain = polygon_domain(rectangle(0, 0, 10, 10), 0.5);
  std::mt19937 random(11);
  std::vector<std::pair<Vec2, double>> discs;
  for (int tries = 0; tries < 4000 && discs.size() < 60; ++tries) {
    const double r = test::uniform(random, 0.1, 0.8);
    const Vec2 c(test::uniform(random, r + 0.02, 9.98 - r), test::uniform(random, r + 0.02, 9.98 - r));
    if (std::any_of(discs.begin(), discs.end(),
                    [&](const auto& d) { return (d.first - c).norm() < d.second + r + 0.02; }))
      continue;
    discs.push_back({c, r});
    add_circle(domain, c, r, 1, 0, test::uniform(random, 0.0, 6.0));
  }
  const MeshSummary summary = valid(domain, quadtree_mesh(domain));
  EXPECT_NEAR(summary.areas[0] + summary.areas[1], 100.0, 1e-9);
}

TEST(QuadtreeMesh, LinesThatCrossAreRefused) {
  Domain domain = polygon_domain(rectangle(0, 0, 1, 1), 0.3);
  domain.lines.push_back(straight({0.2, 0.2}, {0.8, 0.8}, 0, 0));
  domain.lines.push_back(straight({0.2, 0.8}, {0.8, 0.21}, 0, 0));
  domain.lines[4].crack = domain.lines[5].crack = true;
  EXPECT_THROW(quadtree_mesh(domain), InputError);
}

}  // namespace
}  // namespace scabo::mesh
