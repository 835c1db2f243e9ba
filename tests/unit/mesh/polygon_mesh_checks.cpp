#include "unit/mesh/polygon_mesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace scabo::test {

namespace {

bool pieces_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

double twice_area(const std::vector<Vec2>& p, const Vec2& origin) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i] - origin, p[(i + 1) % p.size()] - origin);
  return sum;
}

}  // namespace

MeshSummary check_polygon_mesh(const mesh::Domain& domain, const mesh::PolygonMesh& mesh) {
  MeshSummary out;
  int faults = 0;
  const auto fault = [&](const std::string& text) {
    if (++faults <= 6) out.faults += text + "\n";
  };
  int regions = 0;
  for (const mesh::DomainLine& line : domain.lines) regions = std::max({regions, line.left + 1, line.right + 1});
  out.areas.assign(regions, 0.0);
  const Vec2 origin = domain.lines.front().points.front();

  std::map<std::pair<int, int>, int> region_of;  // by directed side
  std::vector<double> widths(mesh.cells.size(), 0.0), shapes(mesh.cells.size(), 0.0);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const mesh::PolygonCell& cell = mesh.cells[k];
    const int n = int(cell.nodes.size());
    std::vector<Vec2> p;
    for (int node : cell.nodes) p.push_back(mesh.nodes.at(node));
    const std::string name = fmt::format("cell {} at ({:.6g}, {:.6g})", k, cell.centre.x(), cell.centre.y());
    if (n < (cell.open ? 2 : 3)) fault(name + " has too few nodes");
    std::vector<Vec2> whole = p;
    if (cell.open) whole.push_back(cell.centre);
    const double area = 0.5 * twice_area(whole, cell.centre);
    if (!(area > 0.0)) fault(name + " is not counter-clockwise");
    if (cell.region < 0 || cell.region >= regions) {
      fault(name + " has no region");
      continue;
    }
    if (cell.side_regions.empty()) {
      out.areas[cell.region] += area;
    } else if (int(cell.side_regions.size()) != n - cell.open || cell.side_regions.front() != cell.region) {
      fault(name + " has wrong regions of its sides");
    } else {
      for (int i = 0; i < n - cell.open; ++i) {
        out.areas.at(cell.side_regions[i]) += 0.5 * cross(p[i] - cell.centre, p[(i + 1) % n] - cell.centre);
      }
    }
    out.open += cell.open;
    for (int i = 0; i + (cell.open ? 1 : 0) < n; ++i) {
      const int j = (i + 1) % n;
      const double length = (p[j] - p[i]).norm();
      const double clearance = cross(p[i] - cell.centre, p[j] - cell.centre) / length;
      out.least_clearance = std::min(out.least_clearance, clearance / std::sqrt(area));
      out.least_side = std::min(out.least_side, length / std::sqrt(area));
      if (!(clearance > 1e-6 * std::sqrt(area))) fault(name + fmt::format(" does not see its side {}", i));
      const int side_region = cell.side_regions.empty() ? cell.region : cell.side_regions[i];
      if (!region_of.emplace(std::pair(cell.nodes[i], cell.nodes[j]), side_region).second)
        fault(name + " has a side of another cell");
      for (int l = i + 2; l + (cell.open ? 1 : 0) < n; ++l) {
        if ((l + 1) % n != i && pieces_cross(p[i], p[j], p[l], p[(l + 1) % n])) fault(name + " is not simple");
      }
    }
    Vec2 lower = p[0], upper = p[0];
    for (const Vec2& q : p) {
      lower = lower.cwiseMin(q);
      upper = upper.cwiseMax(q);
    }
    if (!cell.open && cell.side_regions.empty() && std::abs(area - (upper - lower).prod()) < 1e-9 * area) {
      ++out.squares;
      widths[k] = upper.x() - lower.x();
      shapes[k] = (upper.y() - lower.y()) / widths[k];
    }
  }

  std::map<std::pair<int, int>, std::pair<int, int>> on_line;  // directed side, its line and the region on its left
  double scale = 0.0;
  for (const Vec2& node : mesh.nodes) scale = std::max(scale, (node - origin).norm());
  std::vector<double> expected(regions, 0.0);
  for (std::size_t l = 0; l < domain.lines.size(); ++l) {
    const mesh::DomainLine& line = domain.lines[l];
    const std::string name = fmt::format("line {}", l);
    if (!line.crack && mesh.left[l] != mesh.right[l]) fault(name + " has two chains");
    const auto is_centre = [&](const Vec2& point) {
      return std::any_of(mesh.cells.begin(), mesh.cells.end(), [&](const auto& cell) {
        return (cell.open || !cell.side_regions.empty()) && cell.centre == point;
      });
    };
    for (const bool left : {true, false}) {
      const std::vector<int>& chain = left ? mesh.left[l] : mesh.right[l];
      std::vector<Vec2> p;
      for (int node : chain) p.push_back(mesh.nodes.at(node));
      for (const bool front : {true, false}) {
        const Vec2 end = front ? line.points.front() : line.points.back();
        if (p.empty() || ((front ? p.front() : p.back()) - end).norm() > 1e-12 * scale) {
          if (!domain.centres.empty() && is_centre(end)) {
            p.insert(front ? p.begin() : p.end(), end);
          } else {
            fault(name + " does not reach its end");
          }
        }
      }
      double before = -1.0;
      for (const Vec2& q : p) {
        if (line.arc) {
          if (std::abs((q - line.arc->centre).norm() - line.arc->radius) > 1e-14 * scale)
            fault(name + " has a node beside its arc");
          continue;
        }
        const Vec2 along = line.points.back() - line.points.front();
        const double t = (q - line.points.front()).dot(along) / along.squaredNorm();
        if (t <= before && &q != &p.front()) fault(name + " does not run forwards");
        before = t;
        if (std::abs(cross(along, q - line.points.front())) / along.norm() > 1e-14 * scale)
          fault(name + " has a node beside it");
      }
      const int region = left ? line.left : line.right;
      double twice = 0.0;
      for (std::size_t i = 0; i + 1 < p.size(); ++i) twice += cross(p[i] - origin, p[i + 1] - origin);
      if (region >= 0) expected[region] += (left ? 0.5 : -0.5) * twice;
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const std::pair<int, int> side = left ? std::pair(chain[i], chain[i + 1]) : std::pair(chain[i + 1], chain[i]);
        const auto found = region_of.find(side);
        const int there = found == region_of.end() ? -1 : found->second;
        if (there != region) fault(name + fmt::format(" has region {} instead of {} at piece {}", there, region, i));
        if (!on_line.emplace(side, std::pair(int(l), region)).second) fault(name + " shares a side with another line");
      }
    }
  }
  for (const auto& [side, region] : region_of) {
    if (on_line.count(side)) continue;
    const auto twin = region_of.find({side.second, side.first});
    const Vec2 at = 0.5 * (mesh.nodes[side.first] + mesh.nodes[side.second]);
    if (twin == region_of.end()) {
      fault(fmt::format("a side at ({:.9g}, {:.9g}) has one cell and no line", at.x(), at.y()));
    } else if (twin->second != region) {
      fault(fmt::format("a side at ({:.9g}, {:.9g}) has two regions and no line", at.x(), at.y()));
    }
  }
  for (int r = 0; r < regions; ++r) {
    if (!(std::abs(out.areas[r] - expected[r]) <= 1e-12 * (expected[r] + 1e-2 * scale * scale))) {
      fault(fmt::format("region {} has area {:.17g} instead of {:.17g}", r, out.areas[r], expected[r]));
    }
  }
  // Cut cells may be rectangles too, but rarely of the shape of the cells of the tree.
  std::vector<double> sorted = shapes;
  std::sort(sorted.begin(), sorted.end());
  const double usual =
      sorted.empty() ? 0.0 : sorted[sorted.size() - std::size_t(out.squares + 1) / 2 - (out.squares == 0)];
  std::vector<std::pair<double, double>> around(mesh.nodes.size(), {1e300, 0.0});
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    for (int node : mesh.cells[k].nodes) {
      if (widths[k] == 0.0 || std::abs(shapes[k] - usual) > 1e-6 * usual) continue;
      around[node].first = std::min(around[node].first, widths[k]);
      around[node].second = std::max(around[node].second, widths[k]);
    }
  }
  for (const auto& [least, most] : around) {
    if (most > 0.0) out.worst_ratio = std::max(out.worst_ratio, most / least);
  }
  return out;
}

}  // namespace scabo::test
