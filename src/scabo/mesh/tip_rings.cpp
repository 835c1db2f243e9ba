#include "scabo/mesh/tip_rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/crack_faces.hpp"

namespace scabo::mesh {

namespace {

/// What becomes of a tip's cell: the innermost copy, the cells of the rings, and their sides on the two side faces,
/// from the boundary towards the tip.
struct DividedTip {
  Cell innermost;
  std::vector<Cell> cells;
  std::vector<LineElement> first, last;
};

LineElement inverted(const LineElement& element) { return {{element.nodes.rbegin(), element.nodes.rend()}}; }

/// The points of an element of the boundary from the tip, at the nodes of a higher order on the same curve.
std::vector<Vec2> raised_arms(const LineElement& element, const std::vector<Vec2>& nodes, const Vec2& tip, int order) {
  const int own = static_cast<int>(element.nodes.size()) - 1;
  const Matrix N = geometry::LineBasis::of_order(own).values_at(geometry::lobatto_points(order));
  std::vector<Vec2> arms;
  for (Eigen::Index k = 0; k < N.rows(); ++k) {
    Vec2 arm = Vec2::Zero();
    for (std::size_t j = 0; j < element.nodes.size(); ++j)
      arm += N(k, static_cast<Eigen::Index>(j)) * (nodes[static_cast<std::size_t>(element.nodes[j])] - tip);
    arms.push_back(arm);
  }
  // Without rounding, because the two faces of a crack begin and end at the same places.
  arms.front() = nodes[static_cast<std::size_t>(element.nodes.front())] - tip;
  arms.back() = nodes[static_cast<std::size_t>(element.nodes.back())] - tip;
  return arms;
}

/// `smallest`: the innermost copy is no smaller than this.
DividedTip divided_tip(const Cell& tip, std::vector<Vec2>& nodes, const TipRings& rings, double smallest) {
  DividedTip made;
  made.innermost = tip;
  std::vector<std::vector<Vec2>> arms;  // of every boundary element, for the copies
  std::vector<std::vector<int>> outer;  // nodes of every boundary element of the last copy
  double shortest = std::numeric_limits<double>::infinity();
  for (const LineElement& element : tip.boundary) {
    const int order = static_cast<int>(element.nodes.size()) - 1;
    arms.push_back(raised_arms(element, nodes, tip.centre, std::max(order, rings.order)));
    outer.push_back(element.nodes);
    for (const Vec2& arm : arms.back()) shortest = std::min(shortest, arm.norm());
  }
  const auto add = [&](const Vec2& arm, double xi) {
    nodes.push_back(tip.centre + xi * arm);
    return static_cast<int>(nodes.size()) - 1;
  };
  double xi = 1.0;
  for (int ring = 0; ring < rings.count; ++ring) {
    const double next = xi * rings.ratio;
    if (next * shortest < smallest) break;
    std::vector<std::vector<int>> inner;
    for (const std::vector<Vec2>& of_element : arms) {
      std::vector<int>& copy = inner.emplace_back();
      for (std::size_t k = 0; k < of_element.size(); ++k)
        copy.push_back(k == 0 && inner.size() > 1 ? inner[inner.size() - 2].back() : add(of_element[k], next));
    }
    // Sides from the outer copy to the inner one.
    const auto side = [&](int from, int to, const Vec2& arm, std::size_t order) {
      LineElement element{{from}};
      const std::vector<double> points = geometry::lobatto_points(static_cast<int>(order));
      for (std::size_t k = 1; k < order; ++k)
        element.nodes.push_back(add(arm, std::lerp(xi, next, 0.5 * (1.0 + points[k]))));
      element.nodes.push_back(to);
      return element;
    };
    LineElement before;
    for (std::size_t e = 0; e < tip.boundary.size(); ++e) {
      const std::size_t order = arms[e].size() - 1;
      if (e == 0) made.first.push_back(before = side(outer[0].front(), inner[0].front(), arms[0].front(), order));
      const LineElement after = side(outer[e].back(), inner[e].back(), arms[e].back(), order);
      const LineElement in = inverted({inner[e]});
      Cell& cell = made.cells.emplace_back();
      cell.boundary = {{outer[e]}, after, in, inverted(before)};
      for (const LineElement& element : cell.boundary)
        cell.centre += 0.25 * nodes[static_cast<std::size_t>(element.nodes.front())];
      cell.materials = {tip.materials.size() > 1 ? tip.materials[e] : tip.materials.front()};
      made.innermost.boundary[e] = {inner[e]};
      before = after;
    }
    made.last.push_back(before);
    outer = inner;
    xi = next;
  }
  return made;
}

}  // namespace

void add_tip_rings(BodyMesh& mesh, const model::Body& body, const std::vector<int>& cracks, const TipRings& rings) {
  std::vector<TipFace> tips = tip_faces(body, mesh);
  std::erase_if(tips, [&](const TipFace& tip) {
    return !tip.last || std::find(cracks.begin(), cracks.end(), tip.crack) == cracks.end();
  });
  double farthest = 0.0;
  for (const Vec2& x : mesh.nodes) farthest = std::max(farthest, x.lpNorm<Eigen::Infinity>());
  const double rounding = std::numeric_limits<double>::epsilon() * farthest;  // of coordinates
  for (const TipFace& tip : tips) {
    DividedTip divided = divided_tip(mesh.cells[tip.cell], mesh.nodes, rings, 1e5 * rounding);
    mesh.cells[tip.cell] = divided.innermost;
    mesh.cells.insert(mesh.cells.end(), divided.cells.begin(), divided.cells.end());
    // The last side face is run towards the tip, the first one away from it.
    const auto face = [&](bool left) -> std::vector<LineElement>& {
      return mesh.faces[static_cast<std::size_t>(2 * tip.crack + (left ? 1 : 0))];
    };
    std::vector<LineElement>&of_last = face(tip.left), &of_first = face(!tip.left);
    of_last.insert(of_last.end(), divided.last.begin(), divided.last.end());
    for (const LineElement& element : divided.first) of_first.insert(of_first.begin(), inverted(element));
  }
}

}  // namespace scabo::mesh
