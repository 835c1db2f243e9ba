#include "scabo/files/cell_shape.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace scabo::files {

namespace {

/// Derivatives of the n shape functions by the two coordinates of the reference cell, at each of the nodes.
template <std::size_t n>
using ShapeGradients = std::array<std::array<Vec2, n>, n>;

constexpr std::array<std::array<double, 2>, 8> square{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

ShapeGradients<4> gradients_of_quad4() {
  ShapeGradients<4> all;
  for (std::size_t node = 0; node < 4; ++node) {
    const auto [x, y] = square[node];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [a, b] = square[i];
      all[node][i] = {0.25 * a * (1.0 + b * y), 0.25 * b * (1.0 + a * x)};
    }
  }
  return all;
}

/// N = (1 + a x)(1 + b y)(a x + b y - 1) / 4 at corners, (1 - x^2)(1 + b y) / 2 and (1 + a x)(1 - y^2) / 2 at middles.
ShapeGradients<8> gradients_of_quad8() {
  ShapeGradients<8> all;
  for (std::size_t node = 0; node < 8; ++node) {
    const auto [x, y] = square[node];
    for (std::size_t i = 0; i < 8; ++i) {
      const auto [a, b] = square[i];
      if (i < 4) {
        all[node][i] = {0.25 * a * (1.0 + b * y) * (2.0 * a * x + b * y),
                        0.25 * b * (1.0 + a * x) * (a * x + 2.0 * b * y)};
      } else if (a == 0.0) {
        all[node][i] = {-x * (1.0 + b * y), 0.5 * b * (1.0 - x * x)};
      } else {
        all[node][i] = {0.5 * a * (1.0 - y * y), -y * (1.0 + a * x)};
      }
    }
  }
  return all;
}

/// N = L (2 L - 1) at corners, 4 L L' at middles, with area coordinates L = 1 - x - y, x, y.
ShapeGradients<6> gradients_of_triangle6() {
  const std::array<Vec2, 3> d{Vec2{-1, -1}, Vec2{1, 0}, Vec2{0, 1}};
  const std::array<std::array<double, 3>, 6> at{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}};
  ShapeGradients<6> all;
  for (std::size_t node = 0; node < 6; ++node) {
    const auto& area = at[node];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      all[node][i] = (4.0 * area[i] - 1.0) * d[i];
      all[node][3 + i] = 4.0 * (area[j] * d[i] + area[i] * d[j]);
    }
  }
  return all;
}

/// Node with a Jacobian of at most `zero`.
template <std::size_t n>
std::optional<int> folded_node(const ShapeGradients<n>& gradients, std::span<const Vec2> points, double zero) {
  for (std::size_t node = 0; node < n; ++node) {
    Vec2 by_x = Vec2::Zero(), by_y = Vec2::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      by_x += gradients[node][i].x() * points[i];
      by_y += gradients[node][i].y() * points[i];
    }
    if (!(cross(by_x, by_y) > zero)) return static_cast<int>(node);
  }
  return std::nullopt;
}

/// Side of the line a b on which c lies: 1 left, -1 right, 0 on it.
int side_of_line(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double s = cross(b - a, c - a);
  return (s > 0.0) - (s < 0.0);
}

bool within_box(const Vec2& a, const Vec2& b, const Vec2& c) {
  return std::min(a.x(), b.x()) <= c.x() && c.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= c.y() &&
         c.y() <= std::max(a.y(), b.y());
}

/// True if the two closed segments have a point in common.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int ca = side_of_line(a, b, c), cb = side_of_line(a, b, d);
  const int cc = side_of_line(c, d, a), cd = side_of_line(c, d, b);
  if (ca != cb && cc != cd && ca * cb <= 0 && cc * cd <= 0 && (ca != 0 || cb != 0)) return true;
  return (ca == 0 && within_box(a, b, c)) || (cb == 0 && within_box(a, b, d)) || (cc == 0 && within_box(c, d, a)) ||
         (cd == 0 && within_box(c, d, b));
}

/// Point of a closed line from which a segment starts that meets another one, or turns back on the one before.
std::optional<int> not_simple_at(const std::vector<Vec2>& line) {
  const std::size_t n = line.size();
  const auto end = [&](std::size_t i) -> const Vec2& { return line[(i + 1) % n]; };
  const auto left = [&](std::size_t i) { return std::min(line[i].x(), end(i).x()); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    if (line[i] == end(i)) return static_cast<int>(i);
    const Vec2 before = line[i] - line[(i + n - 1) % n], after = end(i) - line[i];
    if (cross(before, after) == 0.0 && before.dot(after) < 0.0) return static_cast<int>(i);
    const double right = std::max(line[i].x(), end(i).x());
    for (std::size_t m = k + 1; m < n && left(order[m]) <= right; ++m) {
      const std::size_t j = order[m];
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      if (segments_meet(line[i], end(i), line[j], end(j))) return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> folded_at(CellKind kind, std::span<const Vec2> points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double zero = 1e-12 * (high - low).squaredNorm();
  static const ShapeGradients<4> quad4 = gradients_of_quad4();
  static const ShapeGradients<8> quad8 = gradients_of_quad8();
  static const ShapeGradients<6> triangle6 = gradients_of_triangle6();
  switch (kind) {
    case CellKind::triangle3:
      if (cross(points[1] - points[0], points[2] - points[0]) > zero) return std::nullopt;
      return 0;
    case CellKind::quad4:
      return folded_node(quad4, points, zero);
    case CellKind::triangle6:
      return folded_node(triangle6, points, zero);
    case CellKind::quad8:
      return folded_node(quad8, points, zero);
    case CellKind::polygon:
    case CellKind::quadratic_polygon:
      break;
  }
  const bool quadratic = is_quadratic(kind);
  const std::size_t corners = points.size() / (quadratic ? 2 : 1);
  std::vector<Vec2> line;
  double twice_area = 0.0;
  for (std::size_t i = 0; i < corners; ++i) {
    line.push_back(points[i]);
    if (quadratic) line.push_back(points[corners + i]);
  }
  for (std::size_t i = 0; i < line.size(); ++i) {
    twice_area += cross(line[i] - line[0], line[(i + 1) % line.size()] - line[0]);
  }
  if (!(twice_area > zero)) return 0;
  const auto at = not_simple_at(line);
  if (!at) return std::nullopt;
  if (!quadratic) return *at;
  return *at % 2 == 0 ? *at / 2 : static_cast<int>(corners) + *at / 2;
}

}  // namespace scabo::files
