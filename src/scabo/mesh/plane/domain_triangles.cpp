#include "scabo/mesh/plane/domain_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/mesh/plane/interior_points.hpp"

namespace scabo::mesh {

namespace {

class Collector {
 public:
  explicit Collector(const Domain& domain) {
    Vec2 low = domain.lines.front().points.front(), high = low;
    for (const DomainLine& line : domain.lines)
      for (const Vec2& x : line.points) low = low.cwiseMin(x), high = high.cwiseMax(x);
    step_ = 1e-10 * (high - low).maxCoeff();
  }

  LinePoints result;

  /// Ends of lines may differ by rounding.
  int index_of(const Vec2& x) {
    const auto cell = [&](double coordinate) { return std::llround(coordinate / step_); };
    for (long long i = cell(x.x()) - 1; i <= cell(x.x()) + 1; ++i)
      for (long long j = cell(x.y()) - 1; j <= cell(x.y()) + 1; ++j)
        if (const auto found = known_.find({i, j}); found != known_.end()) return found->second;
    const int index = static_cast<int>(result.points.size());
    known_.emplace(std::pair(cell(x.x()), cell(x.y())), index);
    result.points.push_back(x);
    return index;
  }

  /// `chosen`: indices of the points of the line that are taken, the first and the last included.
  void add(const DomainLine& line, const std::vector<int>& chosen) {
    const int l = static_cast<int>(result.lines.size());
    std::vector<int>& points = result.lines.emplace_back();
    for (const int k : chosen) points.push_back(index_of(line.points[static_cast<std::size_t>(k)]));
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      result.segments[std::minmax(points[k], points[k + 1])] = {points[k], points[k + 1], l, chosen[k], chosen[k + 1]};
  }

 private:
  double step_ = 1.0;
  std::map<std::pair<long long, long long>, int> known_;
};

}  // namespace

LinePoints points_of_lines(const Domain& domain) {
  Collector collector(domain);
  for (const DomainLine& line : domain.lines) {
    std::vector<int> all;
    for (std::size_t k = 0; k < line.points.size(); ++k) all.push_back(static_cast<int>(k));
    collector.add(line, all);
  }
  return std::move(collector.result);
}

LinePoints coarse_points_of_lines(const Domain& domain, double turn) {
  Collector collector(domain);
  for (const DomainLine& line : domain.lines) {
    const int facets = static_cast<int>(line.points.size()) - 1;
    const int pieces =
        line.arc ? std::clamp(static_cast<int>(std::ceil(std::abs(line.arc->sweep) / turn)), 1, facets) : 1;
    std::vector<int> chosen;
    for (int k = 0; k <= pieces; ++k) chosen.push_back(k * facets / pieces);
    collector.add(line, chosen);
  }
  return std::move(collector.result);
}

RegionTriangles triangles_of(const std::vector<Vec2>& points, const LinePoints& lines, const Domain& domain) {
  std::vector<std::pair<int, int>> segments;
  for (const auto& [ends, segment] : lines.segments) segments.push_back(ends);
  const std::vector<Triangle> all = triangulate(points, segments, spatial_order(points));
  constexpr int unknown = -2;
  std::vector<int> region(all.size(), unknown);
  std::vector<std::size_t> front;
  const auto mark = [&](std::size_t triangle, int value) {
    if (region[triangle] != unknown) return;
    region[triangle] = value;
    front.push_back(triangle);
  };
  for (std::size_t t = 0; t < all.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = all[t].vertices[(k + 1) % 3], b = all[t].vertices[(k + 2) % 3];
      const auto segment = lines.segments.find(std::minmax(a, b));
      if (segment == lines.segments.end()) continue;
      const DomainLine& line = domain.lines[static_cast<std::size_t>(segment->second.line)];
      mark(t, segment->second.from == a ? line.left : line.right);
    }
  while (!front.empty()) {
    const std::size_t t = front.back();
    front.pop_back();
    for (std::size_t k = 0; k < 3; ++k)
      if (all[t].neighbours[k] >= 0 && !all[t].constrained[k])
        mark(static_cast<std::size_t>(all[t].neighbours[k]), region[t]);
  }
  RegionTriangles result;
  std::vector<int> number(all.size(), -1);
  for (std::size_t t = 0; t < all.size(); ++t)
    if (region[t] >= 0) {
      number[t] = static_cast<int>(result.triangles.size());
      result.triangles.push_back(all[t]);
      result.regions.push_back(region[t]);
    }
  for (Triangle& triangle : result.triangles)
    for (int& neighbour : triangle.neighbours)
      if (neighbour >= 0) neighbour = number[static_cast<std::size_t>(neighbour)];
  return result;
}

PolygonMesh triangle_mesh(const Domain& domain) {
  const LinePoints lines = points_of_lines(domain);
  std::vector<BorderSegment> borders;
  for (const auto& [ends, segment] : lines.segments) {
    const DomainLine& line = domain.lines[static_cast<std::size_t>(segment.line)];
    const Vec2 &start = lines.points[static_cast<std::size_t>(segment.from)],
               &end = lines.points[static_cast<std::size_t>(segment.to)];
    borders.push_back({start, end, (end - start).norm(), line.left >= 0, line.right >= 0});
  }
  InteriorPoints inside = interior_points(borders, domain.size);
  PolygonMesh mesh;
  mesh.nodes = lines.points;
  mesh.nodes.insert(mesh.nodes.end(), inside.points.begin(), inside.points.end());
  RegionTriangles triangles;
  constexpr int rounds = 4;  // every point inside moves to the middle of its neighbours, then triangles are made anew
  for (int round = 0;; ++round) {
    triangles = triangles_of(mesh.nodes, lines, domain);
    if (round == rounds) break;
    std::vector<Vec2> sum(mesh.nodes.size(), Vec2::Zero());
    std::vector<double> weight(mesh.nodes.size(), 0.0);
    for (const Triangle& triangle : triangles.triangles) {
      const Vec2 &a = mesh.nodes[static_cast<std::size_t>(triangle.vertices[0])],
                 &b = mesh.nodes[static_cast<std::size_t>(triangle.vertices[1])],
                 &c = mesh.nodes[static_cast<std::size_t>(triangle.vertices[2])];
      const double area = std::sqrt(std::abs(cross(b - a, c - a)));  // of graded meshes, the smaller ones count too
      for (const int vertex : triangle.vertices) {
        sum[static_cast<std::size_t>(vertex)] += area * (a + b + c) / 3.0;
        weight[static_cast<std::size_t>(vertex)] += area;
      }
    }
    for (std::size_t i = lines.points.size(); i < mesh.nodes.size(); ++i)
      if (weight[i] > 0.0) mesh.nodes[i] = sum[i] / weight[i];
  }
  for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
    PolygonCell cell;
    cell.region = triangles.regions[t];
    for (const int vertex : triangles.triangles[t].vertices) {
      cell.nodes.push_back(vertex);
      cell.centre += mesh.nodes[static_cast<std::size_t>(vertex)] / 3.0;
    }
    mesh.cells.push_back(std::move(cell));
  }
  mesh.left = mesh.right = lines.lines;
  return mesh;
}

}  // namespace scabo::mesh
