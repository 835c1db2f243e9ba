#include "scabo/mesh/plane/rebuilt_side.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/replace_elements.hpp"

namespace scabo::mesh {

namespace {

/// Inner nodes that are nearer than this to their places, relative to the element, stay.
constexpr double in_place = 1e-7;

std::vector<Vec2> points_along(const MatchedSide& side, std::size_t k, int order) {
  const std::vector<double> points = geometry::lobatto_points(order);
  std::vector<Vec2> inner;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    inner.push_back(side.edge->at(std::lerp(side.breaks[k].t, side.breaks[k + 1].t, 0.5 * (1.0 + points[i]))));
  return inner;
}

/// The point of an element on the ray through a point near it. A chain of a file has straight segments, its elements
/// may be curved: on the chords their new nodes would be dents, deep enough to multiply the pressure where little
/// touches.
Vec2 on_element(const MatchedSide& side, const LineElement& element, const std::vector<Vec2>& nodes, const Vec2& near) {
  if (element.nodes.size() < 3 || !side.edge->is_chain()) return near;
  const auto foot = geometry::foot_on(*side.edge, near);
  const Ray ray = side.rays ? side.rays->through(near) : Ray{near, foot ? foot->normal : Vec2(0.0, 0.0)};
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
  const auto sum = [&](const Vector& of_nodes) {
    Vec2 x = Vec2::Zero();
    for (std::size_t i = 0; i < element.nodes.size(); ++i)
      x += of_nodes[static_cast<Eigen::Index>(i)] * (nodes[static_cast<std::size_t>(element.nodes[i])] + side.moved);
    return x;
  };
  const Vec2 from = sum(basis.values(-1.0)), chord = sum(basis.values(1.0)) - from;
  double eta = std::clamp(2.0 * (near - from).dot(chord) / chord.squaredNorm() - 1.0, -1.0, 1.0);
  for (int step = 0; step < 30; ++step) {
    const Vec2 x = sum(basis.values(eta));
    const double slope = cross(sum(basis.derivatives(eta)), ray.direction),
                 change = cross(x - near, ray.direction) / slope;
    if (!std::isfinite(change)) return near;
    eta = std::clamp(eta - change, -1.0, 1.0);
    if (std::abs(change) < 1e-15) break;
  }
  const Vec2 found = sum(basis.values(eta));
  constexpr double nearest = 0.05;  // of the chord: farther away it is another point
  return (found - near).norm() <= nearest * chord.norm() ? found : near;
}

/// Whether an element that is not divided stays as it is.
bool keeps(const MatchedSide& side, std::size_t k, const Piece& piece, const LineElement& old, const BodyMesh& mesh) {
  const BreakPoint &from = side.breaks[k], &to = side.breaks[k + 1];
  if (from.moved || to.moved || old.nodes.size() != piece.inner.size() + 2) return false;
  if (!piece.placed) return true;
  const double tolerance = in_place * (to.t - from.t) * side.length;
  for (std::size_t i = 0; i < piece.inner.size(); ++i)
    if ((mesh.nodes[static_cast<std::size_t>(old.nodes[i + 1])] + side.moved - piece.inner[i]).norm() > tolerance)
      return false;
  return true;
}

}  // namespace

std::vector<Piece> pieces_of(const MatchedSide& side) {
  const std::vector<BreakPoint>& breaks = side.breaks;
  std::vector<Piece> pieces;
  int old = -1;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    if (!breaks[k].added) ++old;
    Piece& piece = pieces.emplace_back();
    piece.old = old;
    piece.whole = !breaks[k].added && !breaks[k + 1].added;
    piece.inner = points_along(side, k, side.orders[static_cast<std::size_t>(old)]);
  }
  return pieces;
}

bool rebuild_side(MatchedSide& side, std::vector<Piece> pieces, BodyMesh& mesh) {
  const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(side.index)];
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const LineElement& old = elements[static_cast<std::size_t>(pieces[k].old)];
    BreakPoint& at = side.breaks[k];
    if (at.added) at.point = on_element(side, old, mesh.nodes, at.point);
    for (Vec2& point : pieces[k].inner) point = on_element(side, old, mesh.nodes, point);
  }
  std::map<int, Vec2> moved;
  for (BreakPoint& at : side.breaks) {
    if (at.added) {
      at.before = at.after = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(at.point - side.moved);
    } else if (at.moved) {
      moved[at.before] = at.point - side.moved;
    }
  }
  Replacements replacements;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Piece& piece = pieces[k];
    const LineElement& old = elements[static_cast<std::size_t>(piece.old)];
    if (piece.whole && keeps(side, k, piece, old, mesh)) continue;
    LineElement made;
    made.nodes.push_back(side.breaks[k].after);
    for (const Vec2& point : piece.inner) {
      made.nodes.push_back(static_cast<int>(mesh.nodes.size()));
      mesh.nodes.push_back(point - side.moved);
    }
    made.nodes.push_back(side.breaks[k + 1].before);
    replacements[old.nodes].push_back(std::move(made));
  }
  if (replacements.empty() && moved.empty()) return false;
  move_nodes(mesh, moved, replacements);
  replace_elements(mesh, replacements);
  return true;
}

bool is_ascending(const MatchedSide& side) {
  for (std::size_t i = 1; i < side.breaks.size(); ++i)
    if (!(side.breaks[i - 1].t < side.breaks[i].t)) return false;
  return true;
}

}  // namespace scabo::mesh
