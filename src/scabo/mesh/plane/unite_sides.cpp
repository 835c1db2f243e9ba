#include "scabo/mesh/plane/unite_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/contact_side.hpp"
#include "scabo/mesh/plane/node_matching.hpp"
#include "scabo/mesh/plane/rays.hpp"
#include "scabo/mesh/plane/rebuilt_side.hpp"

namespace scabo::mesh {

namespace {

/// Divides the two sides of one contact alike.
class Union {
 public:
  Union(MatchedSide a, MatchedSide b) : sides_{std::move(a), std::move(b)}, rays_(*sides_[0].edge, *sides_[1].edge) {
    for (MatchedSide& side : sides_) side.rays = rays_;
  }

  /// Whether anything has changed.
  bool apply(std::vector<BodyMesh>& bodies) {
    for (const MatchedSide& side : sides_)
      if (!is_ascending(side)) return false;  // not the nodes of this edge
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
  /// Where the other side faces a point of side s.
  std::optional<double> opposite_to(int s, const Vec2& point, double cosine, double tolerance = 0.0) const {
    const std::optional<geometry::Foot> foot = geometry::foot_on(*sides_[s].edge, point);
    if (!foot) return std::nullopt;
    return facing_point(*sides_[1 - s].edge, rays_.through(point), foot->normal, cosine, tolerance);
  }

  /// For every break point where the other side faces it, and the lengths of the elements around it that the other side
  /// faces: what is beyond the ends of the other side may be divided because of other contacts.
  void find_opposite() {
    for (const int s : {0, 1}) {
      const MatchedSide& side = sides_[s];
      const MatchedSide& other = sides_[1 - s];
      const double tolerance = matching_tolerance * other.length_at(0) / other.length;
      for (const BreakPoint& at : side.breaks)
        opposite_[s].push_back(opposite_to(s, at.point, sight_cosine, tolerance));
      lengths_[s].assign(side.breaks.size(), std::numeric_limits<double>::infinity());
      for (std::size_t k = 0; k + 1 < side.breaks.size(); ++k) {
        const double from = side.breaks[k].t, to = side.breaks[k + 1].t;
        if (!opposite_to(s, side.edge->at(0.5 * (from + to)), sight_cosine)) continue;
        for (const std::size_t end : {k, k + 1})
          lengths_[s][end] = std::min(lengths_[s][end], (to - from) * side.length);
      }
      for (std::size_t i = 0; i < side.breaks.size(); ++i)
        if (std::isinf(lengths_[s][i])) lengths_[s][i] = side.length_at(i);
    }
  }

  /// On a closed edge the last break point is the first one.
  std::size_t last_of(int s) const { return sides_[s].breaks.size() - (sides_[s].closed ? 1 : 0); }
  std::size_t own(int s, std::size_t i) const { return i == last_of(s) ? 0 : i; }

  /// Joins the nearest break points first, whichever side they are found from.
  void join_near() {
    struct Near {
      double distance;  // relative to the adjacent elements
      int s;
      std::size_t i, j;
    };
    std::vector<Near> near;
    for (const int s : {0, 1})
      for (std::size_t i = 0; i < last_of(s); ++i) {
        if (!opposite_[s][i]) continue;
        const std::size_t j = sides_[1 - s].nearest(*opposite_[s][i]);
        const double distance = std::abs(*opposite_[s][i] - sides_[1 - s].breaks[j].t) * sides_[1 - s].length,
                     relative = distance / std::min(lengths_[s][i], lengths_[1 - s][j]);
        if (relative <= snapping) near.push_back({relative, s, i, j});
      }
    std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
    for (const Near& one : near)
      if (sides_[one.s].breaks[one.i].event < 0 && sides_[1 - one.s].breaks[own(1 - one.s, one.j)].event < 0)
        join(one.s, one.i, one.j, one.distance);
  }

  /// Makes break point i of side s and j of the other one opposite each other, if `distance`, relative to the adjacent
  /// elements, is small.
  void join(int s, std::size_t i, std::size_t j, double distance) {
    MatchedSide& side = sides_[s];
    MatchedSide& other = sides_[1 - s];
    BreakPoint& here = side.breaks[i];
    BreakPoint& there = other.breaks[own(1 - s, j)];
    if (distance > coincidence) {
      if (here.fixed && there.fixed) return;
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
    return opposite_to(0, sides_[0].edge->at(t), cosine);
  }

  /// Pieces between the same two common points face each other.
  std::array<std::vector<std::optional<std::size_t>>, 2> facing_pieces() const {
    std::map<std::array<int, 2>, std::size_t> of_a;  // events at its start and end
    const std::vector<BreakPoint>&a = sides_[0].breaks, &b = sides_[1].breaks;
    std::array<std::vector<std::optional<std::size_t>>, 2> faces;
    faces[0].resize(a.size() - 1);
    faces[1].resize(b.size() - 1);
    for (std::size_t k = 0; k < faces[0].size(); ++k)
      if (a[k].event >= 0 && a[k + 1].event >= 0) of_a[{a[k].event, a[k + 1].event}] = k;
    for (std::size_t k = 0; k < faces[1].size(); ++k) {
      const auto found = of_a.find({b[k + 1].event, b[k].event});  // the two edges have opposite directions
      if (found == of_a.end()) continue;
      faces[1][k] = found->second;
      faces[0][found->second] = k;
    }
    return faces;
  }

  bool rebuild(std::vector<BodyMesh>& bodies) {
    std::array<std::vector<Piece>, 2> pieces{pieces_of(sides_[0]), pieces_of(sides_[1])};
    const auto faces = facing_pieces();
    const auto own_order = [&](int s, std::size_t k) {
      return sides_[s].orders[static_cast<std::size_t>(pieces[s][k].old)];
    };
    for (const int s : {0, 1})
      for (std::size_t k = 0; k < pieces[s].size(); ++k) {
        Piece& piece = pieces[s][k];
        const std::optional<std::size_t> other = faces[s][k];
        piece.placed = other.has_value();
        if (other) piece.inner = facing_points(s, k, *other, std::max(own_order(s, k), own_order(1 - s, *other)));
      }
    bool changed = false;
    for (const int s : {0, 1})
      changed |= rebuild_side(sides_[s], pieces[s], bodies[static_cast<std::size_t>(sides_[s].body)]);
    return changed;
  }

  /// Positions of the inner nodes of piece k of side s, along the rays to the piece that it faces.
  std::vector<Vec2> facing_points(int s, std::size_t k, std::size_t other, int order) const {
    const MatchedSide& side = sides_[s];
    const BreakPoint &from = side.breaks[k], &to = side.breaks[k + 1];
    const std::vector<double> points = geometry::lobatto_points(order);
    // Both sides use the same rays: those of the piece of the first side.
    const std::size_t m = s == 0 ? k : other;
    const std::vector<BreakPoint>& first = sides_[0].breaks;
    std::vector<Vec2> inner;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double share = 0.5 * (1.0 + points[i]);
      double t = std::lerp(from.t, to.t, share);
      const Ray ray = rays_.between(first[m].point, first[m + 1].point, s == 0 ? share : 0.5 * (1.0 - points[i]));
      if (const std::optional<double> met = meet(*side.edge, ray, t); met && from.t < *met && *met < to.t) t = *met;
      inner.push_back(side.edge->at(t));
    }
    return inner;
  }

  std::array<MatchedSide, 2> sides_;
  Rays rays_;
  std::array<std::vector<std::optional<double>>, 2> opposite_;  // before anything is moved
  std::array<std::vector<double>, 2> lengths_;                  // of the shorter element at a break point
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
