#include "scabo/mesh/rebuilt_side.hpp"

#include <cmath>
#include <map>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/replace_elements.hpp"

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

bool rebuild_side(MatchedSide& side, const std::vector<Piece>& pieces, BodyMesh& mesh) {
  std::map<int, Vec2> moved;
  for (BreakPoint& at : side.breaks) {
    if (at.added) {
      at.before = at.after = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(at.point - side.moved);
    } else if (at.moved) {
      moved[at.before] = at.point - side.moved;
    }
  }
  const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(side.index)];
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
