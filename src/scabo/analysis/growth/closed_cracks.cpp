#include "scabo/analysis/growth/closed_cracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "scabo/mesh/plane/crack_faces.hpp"

namespace scabo::analysis {

namespace {

/// Angles under which an old tip sees the sides of the cells around it: those that represent the field there well, and
/// at most.
constexpr double wide = std::numbers::pi / 6, widest = std::numbers::pi;

}  // namespace

bool ClosedCracks::close(const model::Model& model, const Tip& tip, const Vec2& before) {
  const std::vector<int> ringed = mesh::cracks_with_tractions(model, tip.body);
  const bool has_rings = std::find(ringed.begin(), ringed.end(), tip.crack) != ringed.end();
  const Vec2 now = position_of(model, tip);
  return close_faces(tip, before) && join_at(tip, before, now) && close_at(now, has_rings);
}

/// Opposite nodes of the new part have the same displacement.
bool ClosedCracks::close_faces(const Tip& tip, const Vec2& before) {
  const std::vector<mesh::FacePair> pairs = mesh::face_pairs(mesh_, tip.crack);
  const auto old = std::find_if(pairs.begin(), pairs.end(), [&](const mesh::FacePair& pair) {
    return (at(pair.left) - before).norm() <= tolerance_;
  });
  if (old == pairs.end()) return false;
  old_tip_ = {old->left, old->right};
  for (auto pair = tip.at_end ? old + 1 : pairs.begin(); pair != (tip.at_end ? pairs.end() : old); ++pair)
    same_[pair->right] = pair->left, on_new_.insert({pair->left, pair->right});
  return true;
}

/// The cells at an old tip become one, with those beyond sides that it does not see.
bool ClosedCracks::join_at(const Tip& tip, const Vec2& before, const Vec2& now) {
  Exchange joined;
  const auto reaches_tip = [&](const mesh::LineElement& element) {
    return old_tip_.count(element.nodes.front()) > 0 || old_tip_.count(element.nodes.back()) > 0;
  };
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    if (std::any_of(mesh_.cells[c].boundary.begin(), mesh_.cells[c].boundary.end(), reaches_tip))
      joined.cells.push_back(c);
  std::set<std::vector<int>> faces;
  for (const int face : {2 * tip.crack, 2 * tip.crack + 1})
    for (const mesh::LineElement& element : mesh_.faces[static_cast<std::size_t>(face)])
      if (std::none_of(element.nodes.begin(), element.nodes.end(), [&](int node) { return on_new_.count(node) > 0; }))
        faces.insert(element.nodes);
  constexpr int most_rounds = 8;
  std::optional<Exchange> best;
  for (int round = 0; round < most_rounds; ++round) {
    joined.closed = {};
    joined.closed.centre = before;
    joined.on_faces.clear(), joined.between.clear();
    if (!set_boundary(joined, faces, now)) break;
    const auto& boundary = joined.closed.boundary;
    const auto all_seen = [&](double angle) {
      return std::all_of(boundary.begin(), boundary.end(),
                         [&](const auto& element) { return is_seen(element, before, angle); });
    };
    const bool seen = all_seen(widest);
    if (seen && is_all_around(joined.closed) && add_inside(joined, tip.crack)) best = joined;
    if (all_seen(wide) || !add_beyond(joined, seen ? wide : widest)) break;
  }
  if (!best) return false;
  exchanges_.push_back(*std::move(best));
  return true;
}

/// Adds the cells beyond all sides that are seen under more than an angle, or not at all; whether there are any.
bool ClosedCracks::add_beyond(Exchange& joined, double angle) const {
  std::set<std::vector<int>> hidden;
  std::set<int> begins;
  for (const mesh::LineElement& element : joined.closed.boundary)
    if (!is_seen(element, joined.closed.centre, angle))
      hidden.emplace(element.nodes.rbegin(), element.nodes.rend()), begins.insert(element.nodes.back());
  for (const auto& [right, left] : same_)
    if (begins.count(left) > 0) begins.insert(right);
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    bool beyond = false;
    for (const mesh::LineElement& element : mesh_.cells[c].boundary)
      if (begins.count(element.nodes.front()) > 0 && hidden.erase(same_nodes(element)) > 0) beyond = true;
    if (beyond) joined.cells.push_back(c);
  }
  return hidden.empty();
}

/// Where the nodes lie that are not on the boundary: at the tip, on one of the side faces or between them.
bool ClosedCracks::add_inside(Exchange& joined, int crack) const {
  const std::vector<int> kept = joined.closed.nodes();
  const std::set<int> boundary(kept.begin(), kept.end());
  std::array<std::set<int>, 2> on_face;
  for (const std::size_t k : {0u, 1u})
    for (const mesh::LineElement& element : mesh_.faces[2 * static_cast<std::size_t>(crack) + k])
      on_face[k].insert(element.nodes.begin(), element.nodes.end());
  if (on_face[0].count(kept.front()) == 0) std::swap(on_face[0], on_face[1]);
  if (on_face[0].count(kept.front()) == 0 || on_face[1].count(kept.back()) == 0) return false;
  const auto last = static_cast<int>(joined.closed.boundary.size()) - 1;
  const element::Ring ring = element::ring_of(joined.closed, mesh_.nodes);
  for (const int node : nodes_of(joined.cells)) {
    if (boundary.count(same(node)) > 0) continue;
    const Vec2 arm = at(node) - joined.closed.centre;
    const bool is_tip = old_tip_.count(node) > 0, is_new = on_new_.count(node) > 0;
    std::optional<element::ScaledPoint> point;
    for (const std::size_t k : {0u, 1u}) {
      if (is_tip || is_new || on_face[k].count(node) == 0) continue;
      const Vec2 end = at(k == 0 ? kept.front() : kept.back()) - joined.closed.centre;
      if (std::abs(cross(arm, end)) > tolerance_ * end.norm()) return false;
      point = element::ScaledPoint{arm.norm() / end.norm(), k == 0 ? 0 : last, k == 0 ? -1.0 : 1.0};
    }
    if (is_tip) point = element::ScaledPoint{0.0, 0, -1.0};
    if (is_new) point = element::locate(ring, arm);
    if (is_new && !point) return false;
    if (point)
      joined.on_faces[node] = *point;
    else
      joined.between.push_back(node);
  }
  return true;
}

/// What is left of the boundaries of all its cells: without faces, and without sides that two of them share.
bool ClosedCracks::set_boundary(Exchange& joined, const std::set<std::vector<int>>& faces, const Vec2& new_tip) const {
  struct Side {
    std::vector<int> nodes;
    int material = 0;
  };
  std::map<std::vector<int>, int> sides;  // to the material
  for (const std::size_t c : joined.cells) {
    const mesh::Cell& cell = mesh_.cells[c];
    if (cell.is_open() && cell.centre != new_tip) return false;
    for (std::size_t e = 0; e < cell.boundary.size(); ++e) {
      const std::vector<int>& of_cell = cell.boundary[e].nodes;
      if (faces.count(of_cell) > 0 || old_tip_.count(of_cell.front()) > 0 || old_tip_.count(of_cell.back()) > 0)
        continue;
      const std::vector<int> nodes = same_nodes(cell.boundary[e]), against(nodes.rbegin(), nodes.rend());
      if (sides.erase(against) == 0) sides[nodes] = cell.materials[cell.materials.size() == 1 ? 0 : e];
    }
  }
  std::map<int, Side> from;
  std::set<int> ends;
  for (const auto& [nodes, material] : sides) {
    if (!from.emplace(nodes.front(), Side{nodes, material}).second) return false;
    ends.insert(nodes.back());
  }
  const auto first =
      std::find_if(from.begin(), from.end(), [&](const auto& side) { return ends.count(side.first) == 0; });
  if (first == from.end()) return false;
  for (auto side = first; side != from.end(); side = from.find(joined.closed.boundary.back().nodes.back())) {
    joined.closed.boundary.push_back({side->second.nodes});
    joined.closed.materials.push_back(side->second.material);
    if (joined.closed.boundary.size() > from.size()) return false;
  }
  return joined.closed.boundary.size() == from.size();
}

bool ClosedCracks::is_seen(const mesh::LineElement& element, const Vec2& from, double angle) const {
  constexpr double hardly = 1e-3;
  for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i) {
    const Vec2 first = at(element.nodes[i]) - from, last = at(element.nodes[i + 1]) - from, along = last - first;
    if (cross(first, along) < hardly * along.norm() * std::max(first.norm(), last.norm())) return false;
  }
  const Vec2 first = at(element.nodes.front()) - from, last = at(element.nodes.back()) - from;
  return std::atan2(cross(first, last), first.dot(last)) <= angle;
}

/// Whether the boundary of an open cell goes once around its centre.
bool ClosedCracks::is_all_around(const mesh::Cell& cell) const {
  double around = 0.0;
  for (const mesh::LineElement& element : cell.boundary) {
    const Vec2 first = at(element.nodes.front()) - cell.centre, last = at(element.nodes.back()) - cell.centre;
    around += std::atan2(cross(first, last), first.dot(last));
  }
  return std::abs(around - 2.0 * std::numbers::pi) < 1e-6;
}

std::set<int> ClosedCracks::nodes_of(const std::vector<std::size_t>& cells) const {
  std::set<int> nodes;
  for (const std::size_t c : cells) {
    const std::vector<int> of_cell = mesh_.cells[c].nodes();
    nodes.insert(of_cell.begin(), of_cell.end());
  }
  return nodes;
}

ClosedCracks::Sides ClosedCracks::sides() const {
  Sides sides;
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    for (std::size_t e = 0; e < mesh_.cells[c].boundary.size(); ++e) sides[mesh_.cells[c].boundary[e].nodes] = {c, e};
  return sides;
}

/// The cells around a copy of the boundary of a tip's cell, if they are a ring between it and the next copy
/// (mesh/plane/tip_rings.hpp), which takes its place.
std::vector<std::size_t> ClosedCracks::ring_around(const Sides& sides, const Vec2& tip,
                                                   std::vector<mesh::LineElement>& copy) const {
  const auto is_radial = [&](const mesh::LineElement& element) {
    const Vec2 first = at(element.nodes.front()) - tip, last = at(element.nodes.back()) - tip;
    return std::abs(cross(first, last)) <= tolerance_ * std::max(first.norm(), last.norm());
  };
  std::vector<std::size_t> cells;
  std::vector<mesh::LineElement> next;
  for (const mesh::LineElement& element : copy) {
    const auto beyond = sides.find({element.nodes.rbegin(), element.nodes.rend()});
    if (beyond == sides.end()) return {};
    const auto [c, e] = beyond->second;
    const std::vector<mesh::LineElement>& boundary = mesh_.cells[c].boundary;
    const std::size_t count = boundary.size();
    if (!is_radial(boundary[(e + 1) % count]) || !is_radial(boundary[(e + count - 1) % count])) return {};
    cells.push_back(c);
    for (std::size_t k = 2; k + 1 < count; ++k) next.push_back(boundary[(e + k) % count]);
  }
  copy = std::move(next);
  return cells;
}

/// The cell around a new tip, with its rings if there are any, has no crack.
bool ClosedCracks::close_at(const Vec2& tip, bool has_rings) {
  const auto open = std::find_if(mesh_.cells.begin(), mesh_.cells.end(), [&](const mesh::Cell& cell) {
    return cell.is_open() && !cell.held && cell.centre == tip;
  });
  if (open == mesh_.cells.end()) return false;
  const auto number = static_cast<std::size_t>(open - mesh_.cells.begin());
  const std::vector<std::size_t>& joined = exchanges_.back().cells;
  if (std::find(joined.begin(), joined.end(), number) != joined.end()) return true;
  Exchange whole{{number}, *open};
  const Sides all = has_rings ? sides() : Sides();
  const auto is_joined = [&](std::size_t cell) {
    return std::find(joined.begin(), joined.end(), cell) != joined.end();
  };
  for (std::vector<mesh::LineElement> copy = open->boundary; has_rings;) {
    const std::vector<std::size_t> ring = ring_around(all, tip, copy);
    if (ring.empty() || std::any_of(ring.begin(), ring.end(), is_joined)) break;
    whole.cells.insert(whole.cells.end(), ring.begin(), ring.end());
    whole.closed.boundary = copy;
  }
  whole.closed.materials = {open->materials.front()};
  for (mesh::LineElement& element : whole.closed.boundary) element.nodes = same_nodes(element);
  if (whole.closed.is_open()) return false;
  const std::vector<int> kept = whole.closed.nodes();
  const std::set<int> boundary(kept.begin(), kept.end());
  const element::Ring outer = element::ring_of(whole.closed, mesh_.nodes);
  for (const int node : nodes_of(whole.cells)) {
    if (boundary.count(same(node)) > 0) continue;
    if (on_new_.count(node) == 0) {
      whole.between.push_back(node);
      continue;
    }
    const auto point = element::locate(outer, at(node) - tip);
    if (!point) return false;
    whole.on_faces[node] = *point;
  }
  exchanges_.push_back(std::move(whole));
  return true;
}

}  // namespace scabo::analysis
