#include "scabo/files/folded_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "scabo/files/cell_shape.hpp"

namespace scabo::files {

namespace {

double size_of(std::span<const Vec2> points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

/// Two nodes in one place, or empty.
std::string nodes_in_one_place(std::span<const Vec2> points, std::span<const std::int64_t> numbers) {
  const double together = 1e-9 * size_of(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k) {
      if ((points[i] - points[k]).norm() > together) continue;
      const std::string at = fmt::format("({:.6g}, {:.6g})", points[i].x(), points[i].y());
      if (numbers[i] == numbers[k])
        return fmt::format("has node {} twice, at {}; give the cell as many nodes as it has corners", numbers[i], at);
      return fmt::format(
          "has two nodes in one place, {} and {} at {}; move one of them, or give the cell as many nodes as it has "
          "corners",
          numbers[i], numbers[k], at);
    }
  return "";
}

bool on_one_line(std::span<const Vec2> corners) {
  const Vec2 &first = corners.front(), &second = *std::max_element(corners.begin(), corners.end(), [&](auto&a, auto&b) {
    return (a - first).squaredNorm() < (b - first).squaredNorm();
  });
  const double flat = 1e-12 * (second - first).squaredNorm();
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec2& p) { return std::abs(cross(second - first, p - first)) <= flat; });
}

/// Whether the same corners in another order are a sound cell.
bool is_order_wrong(std::span<const Vec2> corners) {
  const Vec2 middle =
      std::accumulate(corners.begin(), corners.end(), Vec2(Vec2::Zero())) / static_cast<double>(corners.size());
  std::vector<Vec2> around(corners.begin(), corners.end());
  std::sort(around.begin(), around.end(), [&](const Vec2& a, const Vec2& b) {
    const Vec2 to_a = a - middle, to_b = b - middle;
    return std::atan2(to_a.y(), to_a.x()) < std::atan2(to_b.y(), to_b.x());
  });
  return !folded_at(around.size() == 4 ? CellKind::quad4 : CellKind::polygon, around);
}

}  // namespace

std::string why_folded(CellKind kind, std::span<const Vec2> points, std::span<const std::int64_t> numbers, int folded) {
  if (const std::string together = nodes_in_one_place(points, numbers); !together.empty()) return together;
  const bool quadratic = is_quadratic(kind);
  const std::size_t count = points.size() / (quadratic ? 2 : 1);
  const std::span<const Vec2> corners = points.first(count);
  if (on_one_line(corners))
    return "has no area, because its corners lie on one line; move one of them, or remove the cell";
  const CellKind straight = count == 3 ? CellKind::triangle3 : count == 4 ? CellKind::quad4 : CellKind::polygon;
  const bool at_corners = !quadratic || folded_at(straight, corners).has_value();
  const bool polygon = kind == CellKind::polygon || kind == CellKind::quadratic_polygon;
  const bool middle = static_cast<std::size_t>(folded) >= count;
  const std::string where =
      fmt::format("is folded: {} at {}node {}",
                  polygon ? "its boundary meets itself or has no area" : "its Jacobian is not positive",
                  middle ? "middle " : "", numbers[static_cast<std::size_t>(folded)]);
  if (!at_corners) return where + "; move its nodes: a middle node belongs between the quarters of its side";
  if (is_order_wrong(corners)) return where + "; put its nodes in order around it, or mesh again";
  return where + (straight == CellKind::quad4
                      ? "; its angle there is 180 degrees or more: move the node, or divide the "
                        "cell into triangles"
                      : "; move its nodes, or divide the cell");
}

}  // namespace scabo::files
