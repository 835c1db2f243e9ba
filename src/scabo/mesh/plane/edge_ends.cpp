#include "scabo/mesh/plane/edge_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/rebuilt_side.hpp"

namespace scabo::mesh {

namespace {

bool is_closed(const model::Edge& edge) { return (edge.at(0.0) - edge.at(1.0)).norm() <= 1e-9 * edge.length(); }

/// The ends that face the other edge at its inside; `ray_at`: through an end with its normal.
template <class RayAt>
std::vector<FacedEnd> faced_ends(const model::Edge& edge, const std::array<double, 2>& elements,
                                 const model::Edge& other, double cosine, const RayAt& ray_at) {
  std::vector<FacedEnd> ends;
  for (const std::size_t end : {0u, 1u}) {
    if (is_closed(edge)) break;
    const Vec2 point = edge.at(static_cast<double>(end));
    const std::optional<geometry::Foot> foot = geometry::foot_on(edge, point);
    if (!foot) continue;
    const std::optional<double> t = facing_point(other, ray_at(point, foot->normal), foot->normal, cosine);
    if (t && *t > 0.0 && *t < 1.0) ends.push_back({*t, elements[end]});
  }
  return ends;
}

/// Moves the free break points that are near an end of another edge; each end gets at most one.
void move_near(MatchedSide& side, const std::vector<FacedEnd>& ends) {
  struct Near {
    double distance;  // relative to the adjacent elements
    std::size_t at, end;
  };
  std::vector<Near> near;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const std::size_t i = side.nearest(ends[e].t);
    const double shortest = std::min(side.length_at(i), ends[e].element),
                 distance = std::abs(side.breaks[i].t - ends[e].t) * side.length / shortest;
    if (distance <= coincidence || (distance <= snapping && !side.breaks[i].fixed)) near.push_back({distance, i, e});
  }
  std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  for (const Near& one : near) {
    BreakPoint& at = side.breaks[one.at];
    if (at.event >= 0) continue;
    at.event = static_cast<int>(one.end);
    if (one.distance <= coincidence) continue;
    at.t = ends[one.end].t;
    at.point = side.edge->at(at.t);
    at.moved = true;
  }
}

}  // namespace

std::vector<FacedEnd> ends_of_rigid(const model::Edge& rigid, const model::Edge& elastic) {
  constexpr double none = std::numeric_limits<double>::infinity();
  return faced_ends(rigid, {none, none}, elastic, pairing_cosine, [](const Vec2& point, const Vec2& normal) {
    return Ray{point, normal};
  });
}

std::vector<FacedEnd> ends_of_elastic(const model::Edge& edge, const std::array<double, 2>& elements,
                                      const model::Edge& other, const Rays& rays) {
  return faced_ends(edge, elements, other, sight_cosine,
                    [&](const Vec2& point, const Vec2&) { return rays.through(point); });
}

bool are_within_elements(const std::vector<FacedEnd>& ends, const ContactSide& side) {
  return std::any_of(ends.begin(), ends.end(), [&](const FacedEnd& end) {
    const Vec2 point = side.edge->at(end.t);
    return std::none_of(side.elements.begin(), side.elements.end(), [&](const LineElement& element) {
      const Vec2 &from = side.points[static_cast<std::size_t>(element.nodes.front())],
                 &to = side.points[static_cast<std::size_t>(element.nodes.back())];
      return std::min((point - from).norm(), (point - to).norm()) <= coincidence * (to - from).norm();
    });
  });
}

bool divide_at_ends(MatchedSide side, std::vector<FacedEnd> ends, std::vector<BodyMesh>& bodies, FixedNodes& fixed) {
  if (ends.empty() || !is_ascending(side)) return false;  // or not the nodes of this edge
  std::sort(ends.begin(), ends.end(), [](const FacedEnd& a, const FacedEnd& b) { return a.t < b.t; });
  move_near(side, ends);
  for (const FacedEnd& end : ends) {
    const std::size_t i = side.nearest(end.t);
    if (std::abs(side.breaks[i].t - end.t) * side.length <= coincidence * side.length_at(i)) continue;
    BreakPoint added;
    added.t = end.t;
    added.point = side.edge->at(end.t);
    added.event = 0;
    added.fixed = added.added = true;
    const auto place = std::upper_bound(side.breaks.begin(), side.breaks.end(), end.t,
                                        [](double t, const BreakPoint& at) { return t < at.t; });
    side.breaks.insert(place, added);
  }
  const auto body = static_cast<std::size_t>(side.body);
  const bool changed = rebuild_side(side, pieces_of(side), bodies[body]);
  for (const BreakPoint& at : side.breaks)
    if (at.event >= 0) fixed[body].insert({at.before, at.after});
  return changed;
}

}  // namespace scabo::mesh
