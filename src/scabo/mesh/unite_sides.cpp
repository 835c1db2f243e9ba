#include "scabo/mesh/unite_sides.hpp"

#include <cmath>
#include <map>

#include "scabo/geometry/foot_points.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/contact_side.hpp"
#include "scabo/mesh/node_matching.hpp"
#include "scabo/mesh/rays.hpp"
#include "scabo/mesh/replace_elements.hpp"

namespace scabo::mesh {

namespace {

/// Break points nearer than this fraction of the adjacent elements become opposite each other.
constexpr double snapping = 0.1;
/// Those nearer than this fraction are opposite each other already.
constexpr double coincidence = matching_tolerance;
/// Inner nodes that are nearer than this to their places, relative to the element, stay.
constexpr double in_place = 1e-7;
/// Largest cosine of the angle between the normals of points that are made opposite each other. Nodes need a partner up
/// to `facing_cosine`, and pairs are found up to `pairing_cosine`.
constexpr double sight_cosine = -0.25;

/// Divides the two sides of one contact alike.
class Union {
 public:
  Union(MatchedSide a, MatchedSide b) : sides_{std::move(a), std::move(b)}, rays_(*sides_[0].edge, *sides_[1].edge) {}

  /// Whether anything has changed.
  bool apply(std::vector<BodyMesh>& bodies) {
    for (const MatchedSide& side : sides_)
      for (std::size_t i = 1; i < side.breaks.size(); ++i)
        if (!(side.breaks[i - 1].t < side.breaks[i].t)) return false;  // not the nodes of this edge
    find_opposite();
    join_near();
    add_breaks();
    add_limits();
    return rebuild(bodies);
  }

  /// Nodes at the common points of the two sides.
  void fix(FixedNodes& fixed) const {
    for (const MatchedSide& side : sides_)
      for (const BreakPoint& at : side.breaks)
        if (at.event >= 0) fixed[static_cast<std::size_t>(side.body)].insert({at.before, at.after});
  }

 private:
  /// For every break point where the other side faces it.
  void find_opposite() {
    for (const int s : {0, 1}) {
      const MatchedSide& side = sides_[s];
      const MatchedSide& other = sides_[1 - s];
      for (std::size_t i = 0; i < side.breaks.size(); ++i) {
        const BreakPoint& at = side.breaks[i];
        const std::optional<geometry::Foot> foot = geometry::foot_on(*side.edge, at.point);
        opposite_[s].push_back(foot ? facing_point(*other.edge, rays_.through(at.point), foot->normal, sight_cosine,
                                                   matching_tolerance * other.length_at(0) / other.length)
                                    : std::nullopt);
      }
    }
  }

  /// On a closed edge the last break point is the first one.
  std::size_t last_of(int s) const { return sides_[s].breaks.size() - (sides_[s].closed ? 1 : 0); }
  std::size_t own(int s, std::size_t i) const { return i == last_of(s) ? 0 : i; }

  void join_near() {
    for (const int s : {0, 1})
      for (std::size_t i = 0; i < last_of(s); ++i) {
        if (!opposite_[s][i] || sides_[s].breaks[i].event >= 0) continue;
        const std::size_t j = sides_[1 - s].nearest(*opposite_[s][i]);
        const BreakPoint& there = sides_[1 - s].breaks[own(1 - s, j)];
        if (there.event >= 0) continue;
        const double distance = std::abs(*opposite_[s][i] - sides_[1 - s].breaks[j].t) * sides_[1 - s].length;
        join(s, i, j, distance / std::min(sides_[s].length_at(i), sides_[1 - s].length_at(j)));
      }
  }

  /// Makes break point i of side s and j of the other one opposite each other, if `distance`, relative to the adjacent
  /// elements, is small.
  void join(int s, std::size_t i, std::size_t j, double distance) {
    MatchedSide& side = sides_[s];
    MatchedSide& other = sides_[1 - s];
    BreakPoint& here = side.breaks[i];
    BreakPoint& there = other.breaks[own(1 - s, j)];
    if (distance > coincidence) {
      if (distance > snapping || (here.fixed && there.fixed)) return;
      const Vec2 there_point = there.point;
      const Ray ray = here.fixed ? rays_.through(here.point)
                      : there.fixed
                          ? rays_.through(there_point)
                          : rays_.between(s == 0 ? here.point : there_point, s == 0 ? there_point : here.point, 0.5);
      const std::optional<double> t_here = here.fixed ? here.t : meet(*side.edge, ray, here.t);
      const std::optional<double> t_there = there.fixed ? there.t : meet(*other.edge, ray, there.t);
      if (!t_here || !t_there || !lies_between(side, i, *t_here) || !lies_between(other, own(1 - s, j), *t_there))
        return;
      move(here, side, *t_here);
      move(there, other, *t_there);
    }
    here.event = there.event = events_++;
    if (side.closed && i == 0) side.breaks.back().event = here.event;
    if (other.closed && own(1 - s, j) == 0) other.breaks.back().event = here.event;
  }

  static bool lies_between(const MatchedSide& side, std::size_t i, double t) {
    return side.breaks[i].fixed || (side.breaks[i - 1].t < t && t < side.breaks[i + 1].t);
  }

  static void move(BreakPoint& at, const MatchedSide& side, double t) {
    if (at.fixed) return;
    at.t = t;
    at.point = side.edge->at(t);
    at.moved = true;
  }

  /// BreakPoint points of one side that have none opposite make one on the other side.
  void add_breaks() {
    std::array<std::vector<BreakPoint>, 2> added;
    for (const int s : {0, 1})
      for (std::size_t i = 0; i < last_of(s); ++i) {
        BreakPoint& here = sides_[s].breaks[i];
        if (here.event >= 0 || !opposite_[s][i]) continue;
        if (*opposite_[s][i] <= 0.0 || *opposite_[s][i] >= 1.0) continue;  // the rounding of an end
        here.event = events_++;
        if (sides_[s].closed && i == 0) sides_[s].breaks.back().event = here.event;
        BreakPoint there;
        there.t = *opposite_[s][i];
        there.point = sides_[1 - s].edge->at(there.t);
        there.event = here.event;
        there.added = true;
        added[1 - s].push_back(there);
      }
    for (const int s : {0, 1}) {
      std::vector<BreakPoint>& breaks = sides_[s].breaks;
      breaks.insert(breaks.end(), added[s].begin(), added[s].end());
      std::stable_sort(breaks.begin(), breaks.end(),
                       [](const BreakPoint& a, const BreakPoint& b) { return a.t < b.t; });
    }
  }

  /// Where curved edges turn away from each other between two break points of the first side, a common break point
  /// ends the part that matches, unless nodes beyond the last one need no partner anyway.
  void add_limits() {
    const MatchedSide& side = sides_[0];
    std::vector<std::array<double, 2>> limits;
    for (std::size_t k = 0; k + 1 < side.breaks.size(); ++k) {
      const BreakPoint &from = side.breaks[k], &to = side.breaks[k + 1];
      if ((from.event >= 0) == (to.event >= 0)) continue;
      double seen = from.event >= 0 ? from.t : to.t, unseen = from.event >= 0 ? to.t : from.t;
      if (!opposite_to(seen, facing_cosine)) continue;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (seen + unseen);
        (opposite_to(middle, sight_cosine) ? seen : unseen) = middle;
      }
      const double nine_tenths = from.event >= 0 ? std::lerp(from.t, to.t, 0.9) : std::lerp(to.t, from.t, 0.9);
      seen = from.event >= 0 ? std::min(seen, nine_tenths) : std::max(seen, nine_tenths);
      const std::optional<double> there = opposite_to(seen, sight_cosine);
      if (!there || *there < 1e-6 || *there > 1.0 - 1e-6) continue;  // the other edge ends here
      limits.push_back({seen, *there});
    }
    for (const auto& limit : limits) {
      // A break point that is not seen because of the rounding of its position only becomes the common one itself: a
      // new one beside it would leave an element of no length.
      const std::array<std::optional<std::size_t>, 2> there{break_at(0, limit[0]), break_at(1, limit[1])};
      const auto is_common = [&](int s) { return there[s] && sides_[s].breaks[*there[s]].event >= 0; };
      if (is_common(0) || is_common(1)) continue;
      for (const int s : {0, 1}) {
        if (there[s]) {
          MatchedSide& at_break = sides_[s];
          at_break.breaks[*there[s]].event = events_;
          if (at_break.closed && own(s, *there[s]) == 0)
            at_break.breaks.front().event = at_break.breaks.back().event = events_;
          continue;
        }
        BreakPoint at;
        at.t = limit[static_cast<std::size_t>(s)];
        at.point = sides_[s].edge->at(at.t);
        at.event = events_;
        at.added = true;
        std::vector<BreakPoint>& breaks = sides_[s].breaks;
        breaks.insert(std::upper_bound(breaks.begin(), breaks.end(), at.t,
                                       [](double value, const BreakPoint& one) { return value < one.t; }),
                      at);
      }
      ++events_;
    }
  }

  /// The break point of side s that is at position t already.
  std::optional<std::size_t> break_at(int s, double t) const {
    const std::size_t i = sides_[s].nearest(t);
    const double distance = std::abs(sides_[s].breaks[i].t - t) * sides_[s].length;
    return distance <= coincidence * sides_[s].length_at(i) ? std::optional(i) : std::nullopt;
  }

  /// The point of the second side that is opposite a point of the first one.
  std::optional<double> opposite_to(double t, double cosine) const {
    const Vec2 point = sides_[0].edge->at(t);
    const std::optional<geometry::Foot> foot = geometry::foot_on(*sides_[0].edge, point);
    if (!foot) return std::nullopt;
    return facing_point(*sides_[1].edge, rays_.through(point), foot->normal, cosine);
  }

  /// The element of side s between break points k and k + 1.
  struct Piece {
    int old = -1;              // element that it is, or is a part of
    bool whole = true;         // the element is not divided
    std::optional<int> faces;  // piece of the other side
  };

  std::vector<Piece> pieces_of(int s) const {
    const std::vector<BreakPoint>& breaks = sides_[s].breaks;
    std::vector<Piece> pieces;
    int old = -1;
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      if (!breaks[k].added) ++old;
      Piece& piece = pieces.emplace_back();
      piece.old = old;
      piece.whole = !breaks[k].added && !breaks[k + 1].added;
    }
    return pieces;
  }

  /// Pieces between the same two common points face each other.
  void pair_pieces(std::array<std::vector<Piece>, 2>& pieces) const {
    std::map<std::array<int, 2>, std::size_t> of_a;  // events at its start and end
    const std::vector<BreakPoint>&a = sides_[0].breaks, &b = sides_[1].breaks;
    for (std::size_t k = 0; k < pieces[0].size(); ++k)
      if (a[k].event >= 0 && a[k + 1].event >= 0) of_a[{a[k].event, a[k + 1].event}] = k;
    for (std::size_t k = 0; k < pieces[1].size(); ++k) {
      const auto found = of_a.find({b[k + 1].event, b[k].event});  // the two edges have opposite directions
      if (found == of_a.end()) continue;
      pieces[1][k].faces = static_cast<int>(found->second);
      pieces[0][found->second].faces = static_cast<int>(k);
    }
  }

  bool rebuild(std::vector<BodyMesh>& bodies) {
    std::array<std::vector<Piece>, 2> pieces{pieces_of(0), pieces_of(1)};
    pair_pieces(pieces);
    bool changed = false;
    for (const int s : {0, 1}) changed |= rebuild(s, pieces, bodies[static_cast<std::size_t>(sides_[s].body)]);
    return changed;
  }

  bool rebuild(int s, const std::array<std::vector<Piece>, 2>& pieces, BodyMesh& mesh) {
    MatchedSide& side = sides_[s];
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
    for (std::size_t k = 0; k < pieces[s].size(); ++k) {
      const Piece& piece = pieces[s][k];
      const LineElement& old = elements[static_cast<std::size_t>(piece.old)];
      int order = side.orders[static_cast<std::size_t>(piece.old)];
      if (piece.faces) {
        const Piece& other = pieces[1 - s][static_cast<std::size_t>(*piece.faces)];
        order = std::max(order, sides_[1 - s].orders[static_cast<std::size_t>(other.old)]);
      }
      const std::vector<Vec2> inner = inner_points(s, k, piece, order);
      if (piece.whole && keeps(s, k, piece, old, inner, mesh)) continue;
      LineElement made;
      made.nodes.push_back(side.breaks[k].after);
      for (const Vec2& point : inner) {
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

  /// Whether an element that is not divided stays as it is.
  bool keeps(int s, std::size_t k, const Piece& piece, const LineElement& old, const std::vector<Vec2>& inner,
             const BodyMesh& mesh) const {
    const BreakPoint &from = sides_[s].breaks[k], &to = sides_[s].breaks[k + 1];
    if (from.moved || to.moved || old.nodes.size() != inner.size() + 2) return false;
    if (!piece.faces) return true;
    const double tolerance = in_place * (to.t - from.t) * sides_[s].length;
    for (std::size_t i = 0; i < inner.size(); ++i)
      if ((mesh.nodes[static_cast<std::size_t>(old.nodes[i + 1])] + sides_[s].moved - inner[i]).norm() > tolerance)
        return false;
    return true;
  }

  /// Positions of the inner nodes of a piece: along the rays if it faces another one, otherwise along the edge.
  std::vector<Vec2> inner_points(int s, std::size_t k, const Piece& piece, int order) const {
    const MatchedSide& side = sides_[s];
    const BreakPoint &from = side.breaks[k], &to = side.breaks[k + 1];
    const std::vector<double> points = geometry::lobatto_points(order);
    std::vector<Vec2> inner;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double share = 0.5 * (1.0 + points[i]);
      double t = std::lerp(from.t, to.t, share);
      if (piece.faces) {
        // Both sides use the same rays: those of the piece of the first side.
        const auto m = static_cast<std::size_t>(s == 0 ? static_cast<int>(k) : *piece.faces);
        const std::vector<BreakPoint>& first = sides_[0].breaks;
        const Ray ray = rays_.between(first[m].point, first[m + 1].point, s == 0 ? share : 0.5 * (1.0 - points[i]));
        if (const std::optional<double> met = meet(*side.edge, ray, t); met && from.t < *met && *met < to.t) t = *met;
      }
      inner.push_back(side.edge->at(t));
    }
    return inner;
  }

  std::array<MatchedSide, 2> sides_;
  Rays rays_;
  std::array<std::vector<std::optional<double>>, 2> opposite_;  // before anything is moved
  int events_ = 0;
};

}  // namespace

bool unite_sides(MatchedSide a, MatchedSide b, std::vector<BodyMesh>& bodies, FixedNodes& fixed) {
  Union sides(std::move(a), std::move(b));
  if (!sides.apply(bodies)) return false;
  sides.fix(fixed);
  return true;
}

}  // namespace scabo::mesh
