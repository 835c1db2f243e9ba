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

/// `smallest`: the innermost copy is no smaller than this.
DividedTip divided_tip(const Cell& tip, std::vector<Vec2>& nodes, const TipRings& rings, double smallest) {
  DividedTip made;
  made.innermost = tip;
  const std::vector<int> own = tip.nodes();
  std::vector<Vec2> arms;  // from the tip to each node of the boundary
  for (const int node : own) arms.push_back(nodes[static_cast<std::size_t>(node)] - tip.centre);
  const auto add = [&](std::size_t i, double xi) {
    nodes.push_back(tip.centre + xi * arms[i]);
    return static_cast<int>(nodes.size()) - 1;
  };

  std::vector<int> outer = own;
  double xi = 1.0, shortest = arms.front().norm();
  for (const Vec2& arm : arms) shortest = std::min(shortest, arm.norm());
  for (int ring = 0; ring < rings.count; ++ring) {
    const double next = xi * rings.ratio;
    if (next * shortest < smallest) break;
    std::vector<int> inner;
    for (std::size_t i = 0; i < own.size(); ++i) inner.push_back(add(i, next));
    // Sides from the outer copy to the inner one.
    const auto side = [&](std::size_t i, std::size_t order) {
      order = std::max(order, static_cast<std::size_t>(rings.order));
      LineElement element{{outer[i]}};
      const std::vector<double> points = geometry::lobatto_points(static_cast<int>(order));
      for (std::size_t k = 1; k < order; ++k)
        element.nodes.push_back(add(i, std::lerp(xi, next, 0.5 * (1.0 + points[k]))));
      element.nodes.push_back(inner[i]);
      return element;
    };
    std::size_t start = 0;
    LineElement before;
    for (std::size_t e = 0; e < tip.boundary.size(); ++e) {
      const std::size_t order = tip.boundary[e].nodes.size() - 1;
      if (e == 0) made.first.push_back(before = side(0, order));
      const LineElement after = side(start + order, order);
      LineElement out, in;
      for (std::size_t k = 0; k <= order; ++k) {
        out.nodes.push_back(outer[start + k]);
        in.nodes.push_back(inner[start + order - k]);
      }
      Cell& cell = made.cells.emplace_back();
      cell.boundary = {out, after, in, inverted(before)};
      for (const LineElement& element : cell.boundary)
        cell.centre += 0.25 * nodes[static_cast<std::size_t>(element.nodes.front())];
      cell.materials = {tip.materials.size() > 1 ? tip.materials[e] : tip.materials.front()};
      made.innermost.boundary[e] = inverted(in);
      before = after;
      start += order;
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
