#include "scabo/mesh/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>

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
/// Mouths of cracks between these fractions of the adjacent elements from each other are neither in one place nor
/// apart. Measured with two tied bodies, on an edge of length 2 in elements of 0.3: mouths 1e-7 apart leave an
/// imbalance of 3.0e-10, above the tolerance of the certificate, 1e-10, and 2e-7 apart one of 6.1e-10.
constexpr double equal_mouths = 1e-9, close_mouths_apart = 1e-5;
/// Largest cosine of the angle between the normals of points that are made opposite each other. Nodes need a partner up
/// to `facing_cosine`, and pairs are found up to `pairing_cosine`.
constexpr double sight_cosine = -0.25;
/// Contacts that share edges settle after two or three rounds; more than this is a mistake of this file.
constexpr int most_rounds = 10;

using FixedNodes = std::vector<std::set<int>>;  // of every body

/// The end of an element on an edge, or the end of two.
struct Break {
  double t = 0.0;  // fraction of the length of the edge
  Vec2 point = Vec2::Zero();
  int before = -1, after = -1;  // last node of the element before, first one of that after; they differ at a mouth
  bool fixed = false;
  bool moved = false;
  bool added = false;
  int event = -1;  // index of the point that both sides have in common
};

/// One side of a contact: the elements of an edge, and its break points, one more than elements.
struct Side {
  std::shared_ptr<const model::Edge> edge;  // where it has moved, as all points of the side
  Vec2 moved = Vec2::Zero();
  int body = -1, index = -1;
  bool closed = false;
  double length = 0.0;
  std::vector<Break> breaks;
  std::vector<int> orders;

  double length_at(std::size_t i) const {  // of the shorter adjacent element
    double shortest = length;
    if (i > 0) shortest = std::min(shortest, (breaks[i].t - breaks[i - 1].t) * length);
    if (i + 1 < breaks.size()) shortest = std::min(shortest, (breaks[i + 1].t - breaks[i].t) * length);
    return shortest;
  }
  std::size_t nearest(double t) const {
    const auto above =
        std::lower_bound(breaks.begin(), breaks.end(), t, [](const Break& at, double value) { return at.t < value; });
    if (above == breaks.begin()) return 0;
    if (above == breaks.end()) return breaks.size() - 1;
    const auto i = static_cast<std::size_t>(above - breaks.begin());
    return t - breaks[i - 1].t < breaks[i].t - t ? i - 1 : i;
  }
};

Side side_of(const model::Model& model, const model::Place& place, const std::vector<BodyMesh>& bodies,
             const FixedNodes& fixed, const Vec2& moved) {
  const BodyMesh& mesh = bodies[static_cast<std::size_t>(place.body)];
  const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(place.index)];
  Side side;
  side.edge = std::make_shared<const model::Edge>(geometry::translated(
      model.bodies[static_cast<std::size_t>(place.body)].outline.edges[static_cast<std::size_t>(place.index)], moved));
  side.moved = moved;
  side.body = place.body;
  side.index = place.index;
  side.length = side.edge->length();
  // Also where a crack ends at the first point, so that there are two nodes.
  side.closed = (side.edge->at(0.0) - side.edge->at(1.0)).norm() <= 1e-9 * side.length;
  const std::set<int>& stay = fixed[static_cast<std::size_t>(place.body)];
  for (std::size_t k = 0; k <= elements.size(); ++k) {
    Break at;
    at.before = k > 0 ? elements[k - 1].nodes.back() : -1;
    at.after = k < elements.size() ? elements[k].nodes.front() : -1;
    at.point = mesh.nodes[static_cast<std::size_t>(k > 0 ? at.before : at.after)];
    if (!moved.isZero(0.0)) at.point += moved;
    const bool end = k == 0 || k == elements.size();
    at.fixed = end || at.before != at.after || stay.contains(at.before) || side.edge->is_chain();  // at its points
    const std::optional<geometry::Foot> foot = geometry::foot_on(*side.edge, at.point);
    at.t = foot ? foot->t : 0.0;
    if (side.closed && end) at.t = k == 0 ? 0.0 : 1.0;
    side.breaks.push_back(at);
    if (k < elements.size()) side.orders.push_back(static_cast<int>(elements[k].nodes.size()) - 1);
  }
  return side;
}

/// Divides the two sides of one contact alike.
class Union {
 public:
  Union(Side a, Side b) : sides_{std::move(a), std::move(b)}, rays_(*sides_[0].edge, *sides_[1].edge) {}

  /// Whether anything has changed.
  bool apply(std::vector<BodyMesh>& bodies) {
    for (const Side& side : sides_)
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
    for (const Side& side : sides_)
      for (const Break& at : side.breaks)
        if (at.event >= 0) fixed[static_cast<std::size_t>(side.body)].insert({at.before, at.after});
  }

 private:
  /// For every break point where the other side faces it.
  void find_opposite() {
    for (const int s : {0, 1}) {
      const Side& side = sides_[s];
      const Side& other = sides_[1 - s];
      for (std::size_t i = 0; i < side.breaks.size(); ++i) {
        const Break& at = side.breaks[i];
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
        const Break& there = sides_[1 - s].breaks[own(1 - s, j)];
        if (there.event >= 0) continue;
        const double distance = std::abs(*opposite_[s][i] - sides_[1 - s].breaks[j].t) * sides_[1 - s].length;
        join(s, i, j, distance / std::min(sides_[s].length_at(i), sides_[1 - s].length_at(j)));
      }
  }

  /// Makes break point i of side s and j of the other one opposite each other, if `distance`, relative to the adjacent
  /// elements, is small.
  void join(int s, std::size_t i, std::size_t j, double distance) {
    Side& side = sides_[s];
    Side& other = sides_[1 - s];
    Break& here = side.breaks[i];
    Break& there = other.breaks[own(1 - s, j)];
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

  static bool lies_between(const Side& side, std::size_t i, double t) {
    return side.breaks[i].fixed || (side.breaks[i - 1].t < t && t < side.breaks[i + 1].t);
  }

  static void move(Break& at, const Side& side, double t) {
    if (at.fixed) return;
    at.t = t;
    at.point = side.edge->at(t);
    at.moved = true;
  }

  /// Break points of one side that have none opposite make one on the other side.
  void add_breaks() {
    std::array<std::vector<Break>, 2> added;
    for (const int s : {0, 1})
      for (std::size_t i = 0; i < last_of(s); ++i) {
        Break& here = sides_[s].breaks[i];
        if (here.event >= 0 || !opposite_[s][i]) continue;
        if (*opposite_[s][i] <= 0.0 || *opposite_[s][i] >= 1.0) continue;  // the rounding of an end
        here.event = events_++;
        if (sides_[s].closed && i == 0) sides_[s].breaks.back().event = here.event;
        Break there;
        there.t = *opposite_[s][i];
        there.point = sides_[1 - s].edge->at(there.t);
        there.event = here.event;
        there.added = true;
        added[1 - s].push_back(there);
      }
    for (const int s : {0, 1}) {
      std::vector<Break>& breaks = sides_[s].breaks;
      breaks.insert(breaks.end(), added[s].begin(), added[s].end());
      std::stable_sort(breaks.begin(), breaks.end(), [](const Break& a, const Break& b) { return a.t < b.t; });
    }
  }

  /// Where curved edges turn away from each other between two break points of the first side, a common break point
  /// ends the part that matches, unless nodes beyond the last one need no partner anyway.
  void add_limits() {
    const Side& side = sides_[0];
    std::vector<std::array<double, 2>> limits;
    for (std::size_t k = 0; k + 1 < side.breaks.size(); ++k) {
      const Break &from = side.breaks[k], &to = side.breaks[k + 1];
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
          Side& at_break = sides_[s];
          at_break.breaks[*there[s]].event = events_;
          if (at_break.closed && own(s, *there[s]) == 0)
            at_break.breaks.front().event = at_break.breaks.back().event = events_;
          continue;
        }
        Break at;
        at.t = limit[static_cast<std::size_t>(s)];
        at.point = sides_[s].edge->at(at.t);
        at.event = events_;
        at.added = true;
        std::vector<Break>& breaks = sides_[s].breaks;
        breaks.insert(std::upper_bound(breaks.begin(), breaks.end(), at.t,
                                       [](double value, const Break& one) { return value < one.t; }),
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
    const std::vector<Break>& breaks = sides_[s].breaks;
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
    const std::vector<Break>&a = sides_[0].breaks, &b = sides_[1].breaks;
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
    Side& side = sides_[s];
    std::map<int, Vec2> moved;
    for (Break& at : side.breaks) {
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
    const Break &from = sides_[s].breaks[k], &to = sides_[s].breaks[k + 1];
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
    const Side& side = sides_[s];
    const Break &from = side.breaks[k], &to = side.breaks[k + 1];
    const std::vector<double> points = geometry::lobatto_points(order);
    std::vector<Vec2> inner;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double share = 0.5 * (1.0 + points[i]);
      double t = std::lerp(from.t, to.t, share);
      if (piece.faces) {
        // Both sides use the same rays: those of the piece of the first side.
        const auto m = static_cast<std::size_t>(s == 0 ? static_cast<int>(k) : *piece.faces);
        const std::vector<Break>& first = sides_[0].breaks;
        const Ray ray = rays_.between(first[m].point, first[m + 1].point, s == 0 ? share : 0.5 * (1.0 - points[i]));
        if (const std::optional<double> met = meet(*side.edge, ray, t); met && from.t < *met && *met < to.t) t = *met;
      }
      inner.push_back(side.edge->at(t));
    }
    return inner;
  }

  std::array<Side, 2> sides_;
  Rays rays_;
  std::array<std::vector<std::optional<double>>, 2> opposite_;  // before anything is moved
  int events_ = 0;
};

/// Nodes at which materials meet.
std::set<int> material_nodes(const BodyMesh& mesh) {
  std::map<int, int> material_at;
  std::set<int> nodes;
  for (const Cell& cell : mesh.cells)
    for (std::size_t k = 0; k < cell.boundary.size(); ++k) {
      const int material = cell.materials.size() > 1 ? cell.materials[k] : cell.materials.front();
      for (const int node : {cell.boundary[k].nodes.front(), cell.boundary[k].nodes.back()})
        if (material_at.emplace(node, material).first->second != material) nodes.insert(node);
    }
  return nodes;
}

/// Nodes that are not to be moved, apart from the ends of edges.
FixedNodes fixed_nodes(const model::Model& model, const std::vector<BodyMesh>& bodies) {
  FixedNodes fixed(bodies.size());
  Mesh mesh;
  mesh.bodies = bodies;
  const auto hold = [&](const model::Place& place) {
    if (place.kind != model::Place::Kind::near || model.bodies[static_cast<std::size_t>(place.body)].rigid) return;
    const std::vector<int> nodes = nodes_of(place, mesh).nodes;
    fixed[static_cast<std::size_t>(place.body)].insert(nodes.begin(), nodes.end());
  };
  for (const model::Support& support : model.supports) hold(support.on);
  for (const model::Spring& spring : model.springs) hold(spring.on);
  for (const model::Load& load : model.loads)
    if (load.on) hold(*load.on);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].cells.size() > 1) fixed[b].merge(material_nodes(bodies[b]));
  return fixed;
}

/// The two sides of a contact between elastic bodies, always in the same order, however the contact names them.
struct Sides {
  model::Place first, second;
  std::array<Vec2, 2> moved;
};

std::optional<Sides> sides_to_match(const model::Model& model, const Joint& joint,
                                    const std::vector<BodyMesh>& bodies) {
  if (is_refined_alike(model, joint) || joint.a.kind == model::Place::Kind::face) return std::nullopt;
  for (const model::Place& place : {joint.a, joint.b}) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
    if (body.rigid) return std::nullopt;
    const std::vector<std::vector<LineElement>>& edges = bodies[static_cast<std::size_t>(place.body)].edges;
    if (edges.empty() || edges[static_cast<std::size_t>(place.index)].empty()) return std::nullopt;
  }
  const auto key = [](const model::Place& place) { return std::pair(place.body, place.index); };
  return key(joint.b) < key(joint.a) ? Sides{joint.b, joint.a, {joint.moved[1], joint.moved[0]}}
                                     : Sides{joint.a, joint.b, joint.moved};
}

/// `edge`: that of the place, where it has moved.
ContactSide contact_side(const model::Place& place, const model::Edge& edge, const std::vector<BodyMesh>& bodies,
                         const Vec2& moved) {
  const BodyMesh& mesh = bodies[static_cast<std::size_t>(place.body)];
  const auto e = static_cast<std::size_t>(place.index);
  if (moved.isZero(0.0)) return {edge, mesh.edges[e], mesh.nodes};
  std::vector<Vec2> nodes = mesh.nodes;
  for (Vec2& node : nodes) node += moved;
  return {edge, mesh.edges[e], nodes};
}

/// Fixes the nodes of a contact that match, or returns false if some do not.
bool matches(const model::Model& model, const Sides& sides, const std::vector<BodyMesh>& bodies, FixedNodes& fixed) {
  const auto edge_of = [&](const model::Place& place, const Vec2& moved) {
    return geometry::translated(
        model.bodies[static_cast<std::size_t>(place.body)].outline.edges[static_cast<std::size_t>(place.index)], moved);
  };
  const model::Edge edge_a = edge_of(sides.first, sides.moved[0]), edge_b = edge_of(sides.second, sides.moved[1]);
  const ContactSide a = contact_side(sides.first, edge_a, bodies, sides.moved[0]),
                    b = contact_side(sides.second, edge_b, bodies, sides.moved[1]);
  const NodeMatching matching = match_nodes(a, b);
  if (matching.lone) return false;
  for (const auto& [i, j] : matching.partners) {
    fixed[static_cast<std::size_t>(sides.first.body)].insert(a.nodes[static_cast<std::size_t>(i)]);
    fixed[static_cast<std::size_t>(sides.second.body)].insert(b.nodes[static_cast<std::size_t>(j)]);
  }
  return true;
}

/// The mouth of a crack, in which two nodes are in one place.
bool is_mouth(const Side& side, std::size_t i) {
  const Break& at = side.breaks[i];
  if (side.closed && (i == 0 || i + 1 == side.breaks.size()))
    return side.breaks.front().after != side.breaks.back().before;
  return at.before >= 0 && at.after >= 0 && at.before != at.after;
}

bool is_end(const Side& side, std::size_t i) { return !side.closed && (i == 0 || i + 1 == side.breaks.size()); }

/// A mouth of `side` that almost lies opposite a mouth or an end of `other`.
std::optional<Diagnostic> close_mouth(const Side& side, const std::string& name, const Side& other,
                                      const std::string& other_name, const Source& source) {
  for (std::size_t i = 0; i < side.breaks.size(); ++i) {
    if (!is_mouth(side, i)) continue;
    const Vec2& mouth = side.breaks[i].point;
    const std::optional<geometry::Foot> foot = geometry::foot_on(*other.edge, mouth);
    if (!foot) continue;
    const std::size_t j = other.nearest(foot->t);
    if (!is_mouth(other, j) && !is_end(other, j)) continue;
    const double distance = std::abs(foot->t - other.breaks[j].t) * other.length;
    const double element = std::min(side.length_at(i), other.length_at(j));
    // Far from the origin coordinates have fewer digits.
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * mouth.cwiseAbs().maxCoeff();
    if (distance <= std::max(equal_mouths * element, rounding) || distance > close_mouths_apart * element) continue;
    const Vec2& there = other.breaks[j].point;
    return Diagnostic{
        source, fmt::format("a crack ends at ({:.10g}, {:.10g}) on {}, only {:.2g} from {} at ({:.10g}, {:.10g}) "
                            "on {}, which is {:.1g} of the elements there: give both the same coordinates, or "
                            "move them farther apart",
                            mouth.x(), mouth.y(), name, distance,
                            is_mouth(other, j) ? "the end of a crack" : "the end of the edge", there.x(), there.y(),
                            other_name, distance / element)};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Diagnostic> close_mouths(const model::Model& model, const std::vector<BodyMesh>& bodies) {
  std::vector<Diagnostic> mistakes;
  const FixedNodes none(bodies.size());
  const auto has_cracks = [&](const model::Place& place) {
    return !model.bodies[static_cast<std::size_t>(place.body)].cracks.empty();
  };
  for (const Joint& joint : joints_of(model)) {
    if (!has_cracks(joint.a) && !has_cracks(joint.b)) continue;
    if (!sides_to_match(model, joint, bodies)) continue;
    const Side a = side_of(model, joint.a, bodies, none, Vec2::Zero()),
               b = side_of(model, joint.b, bodies, none, Vec2::Zero());
    auto wrong = close_mouth(a, joint.a.text, b, joint.b.text, joint.source);
    if (!wrong) wrong = close_mouth(b, joint.b.text, a, joint.a.text, joint.source);
    if (wrong) mistakes.push_back(*std::move(wrong));
  }
  return mistakes;
}

bool is_refined_alike(const model::Model& model, const Joint& joint) {
  const auto is_refined = [&](const model::Place& place) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
    return !body.rigid && body.mesh.tolerance && !body.mesh.matched_anew &&
           body.mesh.kind == model::MeshKind::superelement;
  };
  return is_refined(joint.a) && is_refined(joint.b);
}

std::optional<std::vector<BodyMesh>> match_sides(const model::Model& model, const std::vector<BodyMesh>& bodies,
                                                 const Placement& placement) {
  std::vector<BodyMesh> matched = bodies;
  FixedNodes fixed = fixed_nodes(model, bodies);
  const std::vector<Joint> joints = joints_of(model, placement);
  std::set<int> changed;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Sides> apart;
    for (const Joint& joint : joints)
      if (const auto sides = sides_to_match(model, joint, matched); sides && !matches(model, *sides, matched, fixed))
        apart.push_back(*sides);
    bool any = false;
    for (const auto& [first, second, moved] : apart) {
      Union sides(side_of(model, first, matched, fixed, moved[0]), side_of(model, second, matched, fixed, moved[1]));
      if (!sides.apply(matched)) continue;
      sides.fix(fixed);
      changed.insert({first.body, second.body});
      any = true;
    }
    if (!any) break;
  }
  if (changed.empty()) return std::nullopt;
  for (const int body : changed)
    matched[static_cast<std::size_t>(body)] = renumbered(matched[static_cast<std::size_t>(body)]);
  return matched;
}

}  // namespace scabo::mesh
