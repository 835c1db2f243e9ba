#include "domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace scabo::test {

using mesh::Domain, mesh::DomainLine, mesh::PolygonCell, mesh::PolygonMesh;

DomainLine straight(const Vec2& a, const Vec2& b, int facets, int left, int right) {
  DomainLine line;
  for (int k = 0; k <= facets; ++k) line.points.push_back(a + static_cast<double>(k) / facets * (b - a));
  line.points.back() = b;
  line.left = left;
  line.right = right;
  return line;
}

DomainLine arc(const Vec2& centre, double radius, double start, double sweep, int facets, int left, int right) {
  DomainLine line;
  line.arc = geometry::Arc{centre, radius, start, sweep};
  for (int k = 0; k <= facets; ++k) {
    const double angle = start + sweep * k / facets;
    line.points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  line.left = left;
  line.right = right;
  return line;
}

std::vector<DomainLine> loop(const std::vector<Vec2>& corners, const std::function<double(const Vec2&)>& size, int left,
                             int right) {
  std::vector<DomainLine> lines;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double facets = std::ceil((b - a).norm() / size(0.5 * (a + b)) - 1e-9);
    lines.push_back(straight(a, b, std::max(1, static_cast<int>(facets)), left, right));
  }
  return lines;
}

Domain domain_of(const std::vector<Vec2>& corners, double size) {
  const auto constant = [size](const Vec2&) { return size; };
  return {loop(corners, constant), constant, {}};
}

Domain scaled(const Domain& domain, double factor) {
  Domain result = domain;
  for (DomainLine& line : result.lines) {
    for (Vec2& p : line.points) p *= factor;
    if (line.arc) {
      line.arc->centre *= factor;
      line.arc->radius *= factor;
    }
  }
  for (Vec2& centre : result.centres) centre *= factor;
  result.size = [size = domain.size, factor](const Vec2& p) { return factor * size(p / factor); };
  return result;
}

MeshFigures expect_valid(const Domain& domain, const PolygonMesh& mesh, const std::string& name) {
  SCOPED_TRACE(name);
  MeshFigures figures;
  const auto node = [&](int i) { return mesh.nodes.at(static_cast<std::size_t>(i)); };
  int broken = 0;

  std::map<int, long double> area;
  std::map<std::pair<int, int>, int> side_region;  // by its nodes, counter-clockwise around its cell
  std::set<std::pair<int, int>> undirected;
  int centres = 0;
  std::vector<bool> used(mesh.nodes.size(), false);
  for (const PolygonCell& cell : mesh.cells) {
    const std::size_t n = cell.nodes.size(), sides = cell.open ? n - 1 : n;
    EXPECT_GE(n, cell.open ? 2u : 3u);
    if (!cell.side_regions.empty()) EXPECT_EQ(cell.side_regions.size(), sides);
    EXPECT_EQ(std::set<int>(cell.nodes.begin(), cell.nodes.end()).size(), n);
    double angle = 0.0;
    for (std::size_t i = 0; i < sides; ++i) {
      const int a = cell.nodes[i], b = cell.nodes[(i + 1) % n];
      const Vec2 to_a = node(a) - cell.centre, to_b = node(b) - cell.centre;
      const int region = cell.side_regions.empty() ? cell.region : cell.side_regions[i];
      used[static_cast<std::size_t>(a)] = used[static_cast<std::size_t>(b)] = true;
      area[region] += 0.5L * cross(to_a, to_b);
      angle += std::atan2(cross(to_a, to_b), to_a.dot(to_b));
      figures.visibility = std::min(figures.visibility, cross(to_a, to_b) / (to_b - to_a).squaredNorm());
      if (!(cross(to_a, to_b) > 2e-3 * (to_b - to_a).squaredNorm()) && ++broken < 5)
        ADD_FAILURE() << "a side is not seen: " << cross(to_a, to_b) / (to_b - to_a).squaredNorm() << " at "
                      << cell.centre.transpose();
      if (!side_region.emplace(std::pair(a, b), region).second) ADD_FAILURE() << "a side has two cells on one side";
      undirected.insert(std::minmax(a, b));
    }
    if (cell.open) {
      EXPECT_LT(angle, 2.0 * std::numbers::pi + 1e-9);
      ++centres;
    } else {
      EXPECT_NEAR(angle, 2.0 * std::numbers::pi, 1e-9);  // once around: simple
    }
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "nodes without a cell";

  // Areas.
  std::map<int, long double> expected;
  const Vec2 origin = domain.lines.front().points.front();
  for (const DomainLine& line : domain.lines)
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
      const long double part = 0.5L * cross(line.points[k] - origin, line.points[k + 1] - origin);
      if (line.left >= 0) expected[line.left] += part;
      if (line.right >= 0) expected[line.right] -= part;
    }
  EXPECT_EQ(expected.size(), area.size());
  for (const auto& [region, value] : expected)
    EXPECT_NEAR(static_cast<double>(area[region] / value), 1.0, 1e-12) << "region " << region;

  // Lines: nodes as given, and every facet the side of a cell on each side that has a region.
  std::set<std::pair<int, int>> on_lines;
  EXPECT_EQ(mesh.left.size(), domain.lines.size());
  EXPECT_EQ(mesh.right.size(), domain.lines.size());
  for (std::size_t i = 0; i < domain.lines.size(); ++i) {
    const DomainLine& line = domain.lines[i];
    if (!line.crack) EXPECT_EQ(mesh.left[i], mesh.right[i]);
    const auto is_centre = [&](const Vec2& p) {
      return std::any_of(domain.centres.begin(), domain.centres.end(),
                         [&](const Vec2& c) { return (c - p).norm() == 0.0; });
    };
    std::vector<Vec2> given;
    for (std::size_t k = 0; k < line.points.size(); ++k)
      if ((k > 0 && k + 1 < line.points.size()) || !is_centre(line.points[k])) given.push_back(line.points[k]);
    if (line.points.size() == 2 && mesh.left[i].size() == given.size() + 1)  // a split facet
      given.insert(given.begin() + (given.size() == 2 || is_centre(line.points.front()) ? given.size() / 2 : 1),
                   0.5 * (line.points.front() + line.points.back()));
    for (const bool left : {true, false}) {
      const std::vector<int>& nodes = left ? mesh.left[i] : mesh.right[i];
      EXPECT_EQ(nodes.size(), given.size());
      if (nodes.size() != given.size()) continue;
      // Ends of lines that meet may differ by rounding (arcs); the node there is one of them.
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (given[k] != line.points.front() && given[k] != line.points.back())
          EXPECT_EQ(node(nodes[k]), given[k]);
        else
          EXPECT_LT((node(nodes[k]) - given[k]).norm(), 1e-14 * (1.0 + given[k].norm()));
      const int region = left ? line.left : line.right;
      if (region < 0) continue;
      for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const auto side = left ? std::pair(nodes[k], nodes[k + 1]) : std::pair(nodes[k + 1], nodes[k]);
        const auto found = side_region.find(side);
        if (found == side_region.end())
          ADD_FAILURE() << "line " << i << ", facet " << k << ": no cell";
        else
          EXPECT_EQ(found->second, region);
        on_lines.insert(side);
        if (line.crack || (left ? line.right : line.left) < 0)
          EXPECT_EQ(side_region.count({side.second, side.first}), 0u) << "a facet of the border is shared";
      }
    }
  }
  for (const auto& [side, region] : side_region) {
    if (on_lines.count(side) != 0) continue;
    const auto other = side_region.find({side.second, side.first});
    if (other == side_region.end())
      ADD_FAILURE() << "a side inside has one cell, at " << node(side.first).transpose();
    else
      EXPECT_EQ(other->second, region);
    const Vec2 middle = 0.5 * (node(side.first) + node(side.second));
    figures.shortest = std::min(figures.shortest, (node(side.first) - node(side.second)).norm() / domain.size(middle));
  }
  int side_faces = 0;
  for (const PolygonCell& cell : mesh.cells)
    if (cell.open) side_faces += 2;
  figures.euler = static_cast<int>(mesh.nodes.size()) + centres - static_cast<int>(undirected.size()) - side_faces +
                  static_cast<int>(mesh.cells.size());
  return figures;
}

}  // namespace scabo::test
