#include "scabo/mesh/plane/sides_of_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/geometry/line_basis.hpp"

namespace scabo::mesh {

namespace {

/// Points of a side at fractions of it, in the direction from `a` to `b`.
std::vector<Vec2> points_at(const std::vector<double>& fractions, const Vec2& a, const Vec2& b,
                            const std::optional<geometry::Arc>& arc) {
  std::vector<Vec2> points;
  for (const double t : fractions) {
    if (!arc) {
      points.push_back(a + t * (b - a));
      continue;
    }
    const Vec2 from = a - arc->centre, to = b - arc->centre;
    const double turn = std::atan2(cross(from, to), from.dot(to)), angle = std::atan2(from.y(), from.x()) + t * turn;
    const double radius = (1.0 - t) * from.norm() + t * to.norm();
    points.push_back(arc->centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// Points between the ends of a side, in the direction from `a` to `b`.
std::vector<Vec2> points_between(const Vec2& a, const Vec2& b, int order, const std::optional<geometry::Arc>& arc) {
  const std::vector<double> lobatto = geometry::lobatto_points(order);
  std::vector<double> fractions;
  for (int i = 1; i < order; ++i) fractions.push_back(0.5 * (1.0 + lobatto[static_cast<std::size_t>(i)]));
  return points_at(fractions, a, b, arc);
}

/// An element of the cell around a crack tip is seen from the tip under at most this angle: the singular stress is as
/// exact as the elements there resolve it, however small the cell is.
constexpr double largest_angle_at_tip = std::numbers::pi / 8;

}  // namespace

CellSides::CellSides(const PolygonMesh& polygons, const Domain& domain, int order, std::vector<Vec2>& nodes)
    : domain_(domain), order_(order), nodes_(nodes) {
  find_arcs(polygons);
  for (const PolygonCell& polygon : polygons.cells)
    for (std::size_t i = 0; polygon.open && i + 1 < polygon.nodes.size(); ++i)
      divide_at_tip(polygon.centre, std::minmax(polygon.nodes[i], polygon.nodes[i + 1]));
}

std::vector<LineElement> CellSides::elements(int a, int b) {
  const auto divided = parts_.find(std::minmax(a, b));
  if (divided == parts_.end()) return {element(a, b)};
  std::vector<int> ends = divided->second;
  if (a > b) std::reverse(ends.begin(), ends.end());
  ends.push_back(b);
  std::vector<LineElement> elements;
  for (const int end : ends) {
    elements.push_back(element(a, end));
    a = end;
  }
  return elements;
}

std::optional<geometry::Arc> CellSides::arc_of(int a, int b) const {
  const auto found = on_arc_.find(std::minmax(a, b));
  return found == on_arc_.end() ? std::nullopt : domain_.lines[found->second].arc;
}

void CellSides::find_arcs(const PolygonMesh& polygons) {
  for (std::size_t l = 0; l < domain_.lines.size(); ++l)
    for (const auto* chain : {&polygons.left[l], &polygons.right[l]})
      for (std::size_t k = 0; domain_.lines[l].arc && k + 1 < chain->size(); ++k)
        on_arc_.emplace(std::minmax((*chain)[k], (*chain)[k + 1]), l);
}

/// Divides a side of the cell around a crack tip (largest_angle_at_tip).
void CellSides::divide_at_tip(const Vec2& tip, const Ends& ends) {
  const Vec2 from = at(ends.first), to = at(ends.second), a = from - tip, b = to - tip;
  const double angle = std::abs(std::atan2(cross(a, b), a.dot(b)));
  const int count = std::max(1, static_cast<int>(std::ceil(angle / largest_angle_at_tip - 1e-6)));
  if (count == 1 || parts_.contains(ends)) return;
  std::vector<double> fractions;
  for (int k = 1; k < count; ++k) fractions.push_back(static_cast<double>(k) / count);
  const std::optional<geometry::Arc> arc = arc_of(ends.first, ends.second);
  const std::size_t line = arc ? on_arc_.at(ends) : 0;
  std::vector<int>& inside = parts_[ends];
  int before = ends.first;
  for (const Vec2& x : points_at(fractions, from, to, arc)) {
    inside.push_back(add_node(x));
    if (arc) on_arc_.emplace(std::minmax(before, inside.back()), line);
    before = inside.back();
  }
  if (arc) on_arc_.emplace(std::minmax(before, ends.second), line);
}

LineElement CellSides::element(int a, int b) {
  LineElement element;
  element.nodes.push_back(a);
  if (order_ > 1) {
    const std::vector<int>& inside = nodes_inside(std::minmax(a, b));
    if (a < b)
      element.nodes.insert(element.nodes.end(), inside.begin(), inside.end());
    else
      element.nodes.insert(element.nodes.end(), inside.rbegin(), inside.rend());
  }
  element.nodes.push_back(b);
  return element;
}

const std::vector<int>& CellSides::nodes_inside(const Ends& ends) {
  const auto [found, is_new] = inside_.try_emplace(ends);
  if (is_new)
    for (const Vec2& x : points_between(at(ends.first), at(ends.second), order_, arc_of(ends.first, ends.second)))
      found->second.push_back(add_node(x));
  return found->second;
}

int CellSides::add_node(const Vec2& x) {
  nodes_.push_back(x);
  return static_cast<int>(nodes_.size()) - 1;
}

}  // namespace scabo::mesh
