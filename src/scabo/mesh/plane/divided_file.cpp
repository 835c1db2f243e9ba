#include "scabo/mesh/plane/divided_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>

#include "scabo/geometry/box.hpp"
#include "scabo/mesh/plane/polygon_kernel.hpp"

namespace scabo::mesh {

namespace {

using files::Facet;
using files::ImportedCell;
using files::ImportedMesh;

/// A cell is not divided if its size exceeds the wanted one only by rounding.
constexpr double nearly_wanted = 1.0 + 1e-6;
/// The centroid is the point inside if it sees all sides at least so well (polygon_kernel.hpp).
constexpr double centroid_sees = 0.1;

/// A cell by the sides that it had when it was made; they may have been divided since.
struct Undivided {
  std::vector<Facet> sides;
  const ImportedCell* from = nullptr;
};

class Divider {
 public:
  Divider(const ImportedMesh& mesh, const std::function<double(const Vec2&)>& size_at, double most_cells,
          const std::vector<bool>& kept)
      : mesh_(mesh), size_at_(size_at), most_cells_(most_cells), kept_(kept) {
    made_.nodes = mesh.nodes;
    made_.regions = mesh.regions;
    made_.materials = mesh.materials;
    made_.remarks = mesh.remarks;
  }

  ImportedMesh run() {
    std::deque<Undivided> cells;
    std::vector<Undivided> done;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const ImportedCell& cell = mesh_.cells[c];
      Undivided undivided{{}, &cell};
      for (int i = 0; i < cell.corners(); ++i) undivided.sides.push_back(files::side_of(cell, i));
      if (!kept_.empty() && kept_[c])
        done.push_back(std::move(undivided));
      else
        cells.push_back(std::move(undivided));
    }
    while (!cells.empty() && static_cast<double>(done.size() + cells.size()) <= most_cells_) {
      Undivided cell = std::move(cells.front());
      cells.pop_front();
      if (!is_too_large(cell) || !divide(cell, cells)) done.push_back(std::move(cell));
    }
    done.insert(done.end(), cells.begin(), cells.end());
    for (const Undivided& cell : done) made_.cells.push_back(as_cell(cell));
    for (const files::FacetSet& set : mesh_.facet_sets) {
      files::FacetSet& divided = made_.facet_sets.emplace_back();
      divided.name = set.name;
      for (const Facet& facet : set.facets) add_parts(facet, divided.facets);
    }
    return std::move(made_);
  }

 private:
  /// The point that halves a side, and the middle nodes of its halves; -1 on straight sides.
  struct Halves {
    int point = -1;
    std::array<int, 2> middles{-1, -1};  // of the half at the end with the lower number, and of the other one
  };

  const Vec2& at(int node) const { return made_.nodes[static_cast<std::size_t>(node)]; }
  int add_node(const Vec2& x) {
    made_.nodes.push_back(x);
    return static_cast<int>(made_.nodes.size()) - 1;
  }
  static std::uint64_t key_of_side(const Facet& side) {
    const auto [low, high] = std::minmax(side.start, side.end);
    return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
  }

  bool is_too_large(const Undivided& cell) const {
    geometry::Box box;
    for (const Facet& side : cell.sides) box.add(at(side.start));
    const Vec2 extent = box.high - box.low;
    return extent.maxCoeff() > nearly_wanted * size_at_(0.5 * (box.low + box.high));
  }

  std::array<Facet, 2> halves_of(const Facet& side) {
    const auto [found, is_new] = halves_.try_emplace(key_of_side(side));
    Halves& halves = found->second;
    const bool forwards = side.start < side.end;
    if (is_new) {
      const Vec2 a = at(forwards ? side.start : side.end), b = at(forwards ? side.end : side.start);
      if (side.middle < 0) {
        halves.point = add_node(0.5 * (a + b));
      } else {  // at -1/2 and 1/2 of the parabola
        const Vec2 m = at(side.middle);
        halves.point = side.middle;
        halves.middles = {add_node(0.375 * a + 0.75 * m - 0.125 * b), add_node(-0.125 * a + 0.75 * m + 0.375 * b)};
      }
    }
    const auto [near, far] = halves.middles;
    return {Facet{side.start, halves.point, forwards ? near : far},
            Facet{halves.point, side.end, forwards ? far : near}};
  }

  /// The sides of which a side consists by now.
  void add_parts(const Facet& side, std::vector<Facet>& parts) {
    if (!halves_.contains(key_of_side(side))) {
      parts.push_back(side);
      return;
    }
    for (const Facet& half : halves_of(side)) add_parts(half, parts);
  }

  /// The middle of a convex quadrilateral's bilinear map, whose quarters are convex again, and the centroid of the
  /// corners of a triangle; of other cells a point that sees all, or nothing.
  std::optional<Vec2> point_inside(const Undivided& cell, const std::vector<Vec2>& polygon) const {
    if (cell.sides.size() <= 4) {
      Vec2 mean = Vec2::Zero();
      for (const Facet& side : cell.sides) mean += at(side.start) / static_cast<double>(cell.sides.size());
      if (visibility(polygon, mean) > 0.0) return mean;
    }
    const KernelCentre inside = kernel_centre(polygon, centroid_sees);
    if (!(inside.visibility > 0.0)) return std::nullopt;
    return inside.centre;
  }

  /// False if no point sees the whole cell.
  bool divide(const Undivided& cell, std::deque<Undivided>& cells) {
    std::vector<Vec2> polygon;
    for (const Facet& side : cell.sides) {
      polygon.push_back(at(side.start));
      if (side.middle >= 0) polygon.push_back(at(side.middle));
    }
    const std::optional<Vec2> inside = point_inside(cell, polygon);
    if (!inside) return false;
    const int centre = add_node(*inside);
    const bool quadratic = files::is_quadratic(cell.from->kind);
    const std::size_t count = cell.sides.size();
    std::vector<std::array<Facet, 2>> halves;
    std::vector<Facet> spokes;  // from the middle of each side to the centre
    for (const Facet& side : cell.sides) {
      halves.push_back(halves_of(side));
      const int middle = halves.back()[0].end;
      spokes.push_back({middle, centre, quadratic ? add_node(0.5 * (at(middle) + *inside)) : -1});
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t before = (i + count - 1) % count;
      const Facet back{centre, spokes[before].start, spokes[before].middle};
      cells.push_back({{halves[i][0], spokes[i], back, halves[before][1]}, cell.from});
    }
    return true;
  }

  ImportedCell as_cell(const Undivided& undivided) {
    std::vector<Facet> sides;
    for (const Facet& side : undivided.sides) add_parts(side, sides);
    ImportedCell cell = *undivided.from;
    cell.nodes.clear();
    for (const Facet& side : sides) cell.nodes.push_back(side.start);
    const bool quadratic = files::is_quadratic(undivided.from->kind);
    if (quadratic)
      for (const Facet& side : sides) cell.nodes.push_back(side.middle);
    const bool three = sides.size() == 3, four = sides.size() == 4;
    const bool polygon =
        undivided.from->kind == files::CellKind::polygon || undivided.from->kind == files::CellKind::quadratic_polygon;
    // A triangle with one new point on a side has four corners, three of them on a line.
    const bool element = !polygon && sides.size() == undivided.sides.size() && (three || four);
    if (quadratic)
      cell.kind = !element ? files::CellKind::quadratic_polygon
                  : three  ? files::CellKind::triangle6
                           : files::CellKind::quad8;
    else
      cell.kind = !element ? files::CellKind::polygon : three ? files::CellKind::triangle3 : files::CellKind::quad4;
    return cell;
  }

  const ImportedMesh& mesh_;
  const std::function<double(const Vec2&)>& size_at_;
  double most_cells_;
  const std::vector<bool>& kept_;
  std::unordered_map<std::uint64_t, Halves> halves_;
  ImportedMesh made_;
};

}  // namespace

ImportedMesh divided_mesh(const ImportedMesh& mesh, const std::function<double(const Vec2&)>& size_at,
                          double most_cells, const std::vector<bool>& kept) {
  return Divider(mesh, size_at, most_cells, kept).run();
}

std::vector<bool> cells_around(const ImportedMesh& mesh, const std::vector<Vec2>& points, int rows, double tolerance) {
  std::vector<bool> reached(mesh.nodes.size(), false), around(mesh.cells.size(), false);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    reached[n] = std::any_of(points.begin(), points.end(),
                             [&](const Vec2& point) { return (mesh.nodes[n] - point).norm() <= tolerance; });
  for (int row = 0; row < rows; ++row) {
    std::vector<bool> next = reached;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      const std::vector<int>& nodes = mesh.cells[c].nodes;
      if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return reached[static_cast<std::size_t>(node)]; }))
        continue;
      around[c] = true;
      for (const int node : nodes) next[static_cast<std::size_t>(node)] = true;
    }
    reached = std::move(next);
  }
  return around;
}

}  // namespace scabo::mesh
