#include "scabo/mesh/plane/node_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/rays.hpp"

namespace scabo::mesh {

namespace {

using Partners = std::vector<std::array<int, 2>>;

/// Tolerances for curved edges: offset along the edge in node spacings, and relative to the gap.
constexpr double curved_tolerance = 0.02;
constexpr double curved_slope = 0.5;

/// Component of x_B - x_A along the interface.
double offset_along(const ContactSide& a, int i, const ContactSide& b, int j) {
  return (b.points[j] - a.points[i]).dot(tangent_of(common_normal(a.normals[i], b.normals[j])));
}

/// Two sides, and the rays along which they are divided.
struct Sides {
  const ContactSide &a, &b;
  Rays rays{*a.edge, *b.edge};
};

bool nodes_match(const Sides& sides, int i, int j) {
  const ContactSide &a = sides.a, &b = sides.b;
  if (a.normals[i].dot(b.normals[j]) > pairing_cosine) return false;
  const Vec2 n = common_normal(a.normals[i], b.normals[j]);
  const Vec2 t = tangent_of(n);
  const Vec2 offset = b.points[j] - a.points[i];
  const double along = offset.dot(t);
  const double gap = offset.dot(n);
  const double tolerance = matching_tolerance * std::min(a.element_length, b.element_length);
  if (std::abs(along) <= tolerance) return true;

  // Whether it lies between the normals of the two sides, as divided or exact.
  double low = 0.0;
  double high = 0.0;
  for (const Vec2& normal : {a.normals[i], a.true_normals[i], Vec2(-b.normals[j]), Vec2(-b.true_normals[j])}) {
    const double slope = normal.dot(t) / normal.dot(n);
    low = std::min(low, slope);
    high = std::max(high, slope);
  }
  const auto [least, most] = std::minmax({low * gap, high * gap});
  if (least - tolerance <= along && along <= most + tolerance) return true;

  const auto is_curved = [](const model::Edge& edge) { return edge.arc || edge.is_chain(); };
  if (!is_curved(*a.edge) && !is_curved(*b.edge)) return false;
  if (std::abs(along) > curved_slope * std::abs(gap)) return false;
  const bool on_one_ray = std::abs(cross(sides.rays.through(a.points[i]).direction, offset)) <= tolerance;
  return on_one_ray || std::abs(along) <= curved_tolerance * std::min(a.spacing, b.spacing);
}

std::vector<Lie> lies_of(const ContactSide& side, const ContactSide& other) {
  const double tolerance =
      matching_tolerance * std::min(side.element_length, other.element_length) / other.edge->length();
  std::vector<Lie> lies;
  for (int i = 0; i < side.size(); ++i) {
    const std::optional<geometry::Foot> foot = geometry::foot_on(*other.edge, side.points[i]);
    if (!foot || foot->t < -tolerance || foot->t > 1.0 + tolerance) {
      lies.push_back(Lie::beyond);
    } else if (side.normals[i].dot(foot->normal) > facing_cosine - 1e-9) {
      lies.push_back(Lie::averted);
    } else if (!other.closed && (foot->t <= tolerance || foot->t >= 1.0 - tolerance)) {
      lies.push_back(Lie::at_end);
    } else {
      lies.push_back(Lie::face_to_face);
    }
  }
  return lies;
}

/// For each node of `side` the nearest one of `other`.
std::vector<int> nearest_nodes(const ContactSide& side, const ContactSide& other) {
  const NearestPoint nearest(other.points);
  std::vector<int> found;
  for (const Vec2& point : side.points) found.push_back(nearest(point));
  return found;
}

/// Whether positions i and i + step are the two nodes at the mouth of a crack.
bool is_mouth(const ContactSide& side, int i, int step) {
  const int next = side.closed ? (i + step + side.size()) % side.size() : i + step;
  return next >= 0 && next < side.size() && next != i && side.points[next] == side.points[i];
}

/// The closest pair of nodes that match, if there is one.
std::optional<std::array<int, 2>> closest_partners(const Sides& sides, const std::vector<int>& nearest_b,
                                                   const std::vector<int>& nearest_a) {
  const ContactSide &a = sides.a, &b = sides.b;
  std::optional<std::array<int, 2>> closest;
  double shortest = std::numeric_limits<double>::max();
  const auto at_mouth = [](const ContactSide& side, int i) { return is_mouth(side, i, 1) || is_mouth(side, i, -1); };
  const auto consider = [&](int i, int j) {
    if (at_mouth(a, i) || at_mouth(b, j)) return;  // which of its nodes, the way along the sides will tell
    const double distance = (b.points[j] - a.points[i]).squaredNorm();
    if (!(distance < shortest) || !nodes_match(sides, i, j)) return;
    shortest = distance;
    closest = {i, j};
  };
  for (int i = 0; i < a.size(); ++i) consider(i, nearest_b[i]);
  for (int j = 0; j < b.size(); ++j) consider(nearest_a[j], j);
  return closest;
}

/// From the closest pair in both directions as long as the nodes match, in the order of the boundary of A. Both nodes
/// at the mouth of a crack are partners of the node that faces them; of two mouths that face each other, those on one
/// side.
Partners partners_along(const Sides& sides, const std::array<int, 2>& closest) {
  const ContactSide &a = sides.a, &b = sides.b;
  const auto moved = [&](std::array<int, 2> at, int by_a, int by_b) -> std::optional<std::array<int, 2>> {
    at[0] += by_a;
    at[1] += by_b;
    if (a.closed) at[0] = (at[0] + a.size()) % a.size();
    if (b.closed) at[1] = (at[1] + b.size()) % b.size();
    if (at[0] < 0 || at[0] >= a.size() || at[1] < 0 || at[1] >= b.size()) return std::nullopt;
    if (!nodes_match(sides, at[0], at[1])) return std::nullopt;
    return at;
  };
  const auto step = [&](const std::array<int, 2>& at, int direction) {
    auto next =
        moved(at, direction, -direction);  // both boundaries run counter-clockwise, hence in opposite directions
    if (!next && is_mouth(a, at[0], direction)) next = moved(at, direction, 0);
    if (!next && is_mouth(b, at[1], -direction)) next = moved(at, 0, -direction);
    return next;
  };
  std::set<std::array<int, 2>> found{closest};  // around a closed interface the way ends where it began
  Partners before;
  for (auto at = step(closest, -1); at && found.insert(*at).second; at = step(*at, -1)) before.push_back(*at);
  Partners partners(before.rbegin(), before.rend());
  partners.push_back(closest);
  for (auto at = step(closest, 1); at && found.insert(*at).second; at = step(*at, 1)) partners.push_back(*at);
  return partners;
}

/// Whether the node also faces the other edge along the rays. Beside curved edges that are far apart it may have its
/// foot on the other edge, while what faces it lies beyond the end.
bool is_seen(const ContactSide& side, int i, const ContactSide& other, const Rays& rays) {
  return facing_point(*other.edge, rays.through(side.points[i]), side.true_normals[i], facing_cosine).has_value();
}

/// The first node of side A or B, from its start or, if `backwards`, from its end, that should have a partner but has
/// none, and that would (`nearest_matches`) or would not match the nearest node.
std::optional<int> first_alone(const Sides& sides, bool on_a, const std::vector<Lie>& lies,
                               const std::vector<bool>& paired, const std::vector<int>& nearest, bool backwards,
                               bool nearest_matches) {
  const ContactSide &side = on_a ? sides.a : sides.b, &other = on_a ? sides.b : sides.a;
  for (int k = 0; k < side.size(); ++k) {
    const int i = backwards ? side.size() - 1 - k : k;
    if (lies[i] != Lie::face_to_face || paired[i] || !is_seen(side, i, other, sides.rays)) continue;
    const bool match = on_a ? nodes_match(sides, i, nearest[i]) : nodes_match(sides, nearest[i], i);
    if (match == nearest_matches) return i;
  }
  return std::nullopt;
}

/// Whether an element of `side` has several partners that are not those of one element of the same order of `other`. An
/// element with one partner lies beyond the end of the other side. `partners`: of nodes that face each other.
bool is_unlike(const ContactSide& side, const ContactSide& other, const Partners& partners) {
  std::vector<std::vector<int>> partners_of(side.nodes.size()), elements_at(other.nodes.size());
  for (const auto& [i, j] : partners) partners_of[i].push_back(j);
  for (int e = 0; e < static_cast<int>(other.elements.size()); ++e)
    for (const int node : other.elements[e].nodes) elements_at[node].push_back(e);
  const auto is_equal = [&](const std::vector<int>& own, const std::vector<int>& facing) {
    for (std::size_t k = 0; own.size() == facing.size() && k < own.size(); ++k) {
      const std::vector<int>& of_node = partners_of[own[k]];
      const int expected = facing[facing.size() - 1 - k];
      if (!of_node.empty() && std::find(of_node.begin(), of_node.end(), expected) == of_node.end()) return false;
    }
    return own.size() == facing.size();
  };
  for (const LineElement& element : side.elements) {
    const std::vector<int>& own = element.nodes;
    std::set<int> met;
    int paired = 0;
    for (const int node : own) {
      paired += partners_of[node].empty() ? 0 : 1;
      for (const int j : partners_of[node]) met.insert(elements_at[j].begin(), elements_at[j].end());
    }
    const auto equals_own = [&](int f) { return is_equal(own, other.elements[f].nodes); };
    if (paired > 1 && std::none_of(met.begin(), met.end(), equals_own)) return true;
  }
  return false;
}

/// Whether elements do not match where the sides face each other. Beyond, where curved sides turn away from each other,
/// nodes may be partners, but need not.
bool have_unlike_elements(const ContactSide& a, const ContactSide& b, const NodeMatching& matching) {
  const auto faces = [](Lie lie) { return lie == Lie::face_to_face || lie == Lie::at_end; };
  Partners of_a, of_b;
  for (const auto& [i, j] : matching.partners) {
    if (!faces(matching.lies_a[i]) || !faces(matching.lies_b[j])) continue;
    of_a.push_back({i, j});
    of_b.push_back({j, i});
  }
  return is_unlike(a, b, of_a) || is_unlike(b, a, of_b);
}

}  // namespace

NodeMatching match_nodes(const ContactSide& a, const ContactSide& b) {
  const Sides sides{a, b};
  NodeMatching matching;
  matching.lies_a = lies_of(a, b);
  matching.lies_b = lies_of(b, a);
  const std::vector<int> nearest_b = nearest_nodes(a, b);
  const std::vector<int> nearest_a = nearest_nodes(b, a);
  if (const auto closest = closest_partners(sides, nearest_b, nearest_a)) {
    matching.partners = partners_along(sides, *closest);
  }
  std::vector<bool> paired_a(a.size(), false);
  std::vector<bool> paired_b(b.size(), false);
  for (const auto& [i, j] : matching.partners) {
    paired_a[i] = true;
    paired_b[j] = true;
  }

  // Nodes that do not match their nearest node come first: they show the mistake itself, the others its consequences.
  const bool backwards = runs_backwards(a.points.front(), a.points.back());
  for (const bool nearest_matches : {false, true}) {
    if (const auto i = first_alone(sides, true, matching.lies_a, paired_a, nearest_b, backwards, nearest_matches)) {
      matching.lone = {true, *i, nearest_b[*i], std::abs(offset_along(a, *i, b, nearest_b[*i]))};
      break;
    }
    if (const auto j = first_alone(sides, false, matching.lies_b, paired_b, nearest_a, !backwards, nearest_matches)) {
      matching.lone = {false, *j, nearest_a[*j], std::abs(offset_along(b, *j, a, nearest_a[*j]))};
      break;
    }
  }
  matching.unlike = have_unlike_elements(a, b, matching);
  return matching;
}

Vec2 common_normal(const Vec2& normal_a, const Vec2& normal_b) { return (normal_a - normal_b).normalized(); }

bool runs_backwards(const Vec2& first, const Vec2& last) {
  const Vec2 d = last - first;
  return std::abs(d.x()) > 1e-6 * std::abs(d.y()) ? d.x() < 0.0 : d.y() < 0.0;
}

}  // namespace scabo::mesh
