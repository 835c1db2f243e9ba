#include "scabo/mesh/plane/sides_of_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/geometry/line_basis.hpp"

namespace scabo::mesh {

namespace {

/// The point of a side at a fraction of it, in the direction from `a` to `b`.
Vec2 point_at(double t, const Vec2& a, const Vec2& b, const std::optional<geometry::Arc>& arc) {
  if (!arc) return a + t * (b - a);
  const Vec2 from = a - arc->centre, to = b - arc->centre;
  const double turn = std::atan2(cross(from, to), from.dot(to)), angle = std::atan2(from.y(), from.x()) + t * turn;
  const double radius = (1.0 - t) * from.norm() + t * to.norm();
  return arc->centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

/// An element of the cell around a crack tip is seen from the tip under at most this angle: the singular stress is as
/// exact as the elements there resolve it, however small the cell is.
constexpr double largest_angle_at_tip = std::numbers::pi / 8;

}  // namespace

CellSides::CellSides(const PolygonMesh& polygons, const Domain& domain, int order, std::vector<Vec2>& nodes)
    : domain_(domain), order_(order), nodes_(nodes), inside_(nodes.size()) {
  const std::vector<double> lobatto = geometry::lobatto_points(order);
  for (int i = 1; i < order; ++i) fractions_.push_back(0.5 * (1.0 + lobatto[static_cast<std::size_t>(i)]));
  find_arcs(polygons);
  for (const PolygonCell& polygon : polygons.cells)
    for (std::size_t i = 0; polygon.open && i + 1 < polygon.nodes.size(); ++i)
      divide_at_tip(polygon.centre, std::minmax(polygon.nodes[i], polygon.nodes[i + 1]));
}

std::vector<LineElement> CellSides::elements(int a, int b) {
  std::vector<LineElement> elements;
  append(a, b, elements);
  return elements;
}

void CellSides::append(int a, int b, std::vector<LineElement>& to) {
  const auto divided = parts_.find(side_number(a, b));
  if (divided == parts_.end()) return to.push_back(element(a, b));
  std::vector<int> ends = divided->second;
  if (a > b) std::reverse(ends.begin(), ends.end());
  ends.push_back(b);
  for (const int end : ends) {
    to.push_back(element(a, end));
    a = end;
  }
}

std::optional<geometry::Arc> CellSides::arc_of(int a, int b) const {
  if (!is_on_arc(a) || !is_on_arc(b)) return std::nullopt;  // of nearly all sides
  const auto found = on_arc_.find(side_number(a, b));
  return found == on_arc_.end() ? std::nullopt : domain_.lines[found->second].arc;
}

void CellSides::find_arcs(const PolygonMesh& polygons) {
  for (std::size_t l = 0; l < domain_.lines.size(); ++l)
    for (const auto* chain : {&polygons.left[l], &polygons.right[l]})
      for (std::size_t k = 0; domain_.lines[l].arc && k + 1 < chain->size(); ++k)
        put_on_arc((*chain)[k], (*chain)[k + 1], l);
}

void CellSides::put_on_arc(int a, int b, std::size_t line) {
  on_arc_.emplace(side_number(a, b), line);
  ends_on_arc_.resize(nodes_.size(), 0);
  for (const int node : {a, b}) ends_on_arc_[static_cast<std::size_t>(node)] = 1;
}

/// Divides a side of the cell around a crack tip (largest_angle_at_tip).
void CellSides::divide_at_tip(const Vec2& tip, const Ends& ends) {
  const Vec2 from = at(ends.first), to = at(ends.second), a = from - tip, b = to - tip;
  const double angle = std::abs(std::atan2(cross(a, b), a.dot(b)));
  const int count = std::max(1, static_cast<int>(std::ceil(angle / largest_angle_at_tip - 1e-6)));
  const std::uint64_t side = side_number(ends.first, ends.second);
  if (count == 1 || parts_.contains(side)) return;
  const std::optional<geometry::Arc> arc = arc_of(ends.first, ends.second);
  const std::size_t line = arc ? on_arc_.at(side) : 0;
  std::vector<int>& inside = parts_[side];
  int before = ends.first;
  for (int k = 1; k < count; ++k) {
    inside.push_back(add_node(point_at(static_cast<double>(k) / count, from, to, arc)));
    if (arc) put_on_arc(before, inside.back(), line);
    before = inside.back();
  }
  if (arc) put_on_arc(before, ends.second, line);
}

LineElement CellSides::element(int a, int b) {
  LineElement element;
  const int between = order_ - 1, first = between > 0 ? first_inside(std::minmax(a, b)) : 0;
  element.nodes.reserve(static_cast<std::size_t>(order_) + 1);
  element.nodes.push_back(a);
  for (int k = 0; k < between; ++k) element.nodes.push_back(first + (a < b ? k : between - 1 - k));
  element.nodes.push_back(b);
  return element;
}

int CellSides::first_inside(const Ends& ends) {
  const auto [first, is_new] = inside_.add(ends.first, ends.second, static_cast<int>(nodes_.size()));
  if (is_new) {
    const Vec2 from = at(ends.first), to = at(ends.second);
    const std::optional<geometry::Arc> arc = arc_of(ends.first, ends.second);
    for (const double t : fractions_) add_node(point_at(t, from, to, arc));
  }
  return first;
}

int CellSides::add_node(const Vec2& x) {
  nodes_.push_back(x);
  return static_cast<int>(nodes_.size()) - 1;
}

}  // namespace scabo::mesh
