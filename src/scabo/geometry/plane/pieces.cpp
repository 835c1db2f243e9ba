#include "scabo/geometry/plane/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"

namespace scabo::geometry {

namespace {

/// Pairs of edges whose boxes overlap, by a sweep along x.
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<const Edge*>& edges, double tolerance) {
  std::vector<Box> boxes;
  for (const Edge* edge : edges) boxes.push_back(box_of(*edge));
  std::vector<std::size_t> order(edges.size()), open;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return boxes[i].low.x() != boxes[j].low.x() ? boxes[i].low.x() < boxes[j].low.x() : i < j;
  });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const std::size_t i : order) {
    std::erase_if(open, [&](std::size_t j) { return boxes[j].high.x() < boxes[i].low.x() - tolerance; });
    for (const std::size_t j : open)
      if (boxes[j].low.y() <= boxes[i].high.y() + tolerance && boxes[j].high.y() >= boxes[i].low.y() - tolerance)
        pairs.push_back(std::minmax(i, j));
    open.push_back(i);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Adds the position of a point on an edge, unless it is known; whether it was added.
bool add_position(std::vector<double>& positions, const Edge& edge, const Vec2& point, double tolerance) {
  const double at = closest_position(edge, point), slack = 3.0 * tolerance / edge.length();
  if ((edge.at(at) - point).norm() > 3.0 * tolerance) return false;
  const bool known =
      std::any_of(positions.begin(), positions.end(), [&](double other) { return std::abs(other - at) <= slack; });
  if (!known) positions.push_back(at);
  return !known;
}

/// Where two edges meet. Curves that touch, or meet tangentially at a corner, are closer than the tolerance over a
/// length in which they must not be cut.
std::vector<Vec2> meetings_of(const Edge& a, const Edge& b, double tolerance) {
  std::vector<Vec2> shared = shared_points(a, b, tolerance);
  if (shared.size() < 2 || (!a.arc && !b.arc)) return shared;
  const double near = 1e-3 * std::min(a.length(), b.length());
  const auto is_end = [&](const Vec2& point) {
    return std::min({(point - a.start).norm(), (point - a.end).norm(), (point - b.start).norm(),
                     (point - b.end).norm()}) <= 3.0 * tolerance;
  };
  std::vector<Vec2> kept;
  std::partition_copy(shared.begin(), shared.end(), std::back_inserter(kept), shared.begin(), is_end);
  shared.resize(shared.size() - kept.size());
  for (const Vec2& point : shared) {
    const auto close = [&](const Vec2& other) { return (other - point).norm() <= near; };
    if (std::none_of(kept.begin(), kept.end(), close)) kept.push_back(point);
  }
  return kept;
}

}  // namespace

std::vector<std::vector<double>> meeting_positions(const std::vector<const Edge*>& edges, double tolerance) {
  std::vector<std::vector<double>> positions(edges.size(), {0.0, 1.0});
  std::vector<std::pair<std::size_t, std::size_t>> along;  // pairs that share more than a point
  for (const auto& [i, j] : near_pairs(edges, tolerance)) {
    const std::vector<Vec2> shared = meetings_of(*edges[i], *edges[j], tolerance);
    for (const Vec2& point : shared) {
      add_position(positions[i], *edges[i], point, tolerance);
      add_position(positions[j], *edges[j], point, tolerance);
    }
    if (shared.size() > 1) along.emplace_back(i, j);
  }
  // What cuts one of two edges that lie on each other cuts both.
  for (bool changed = true; changed;) {
    changed = false;
    const auto hand_on = [&](std::size_t i, std::size_t j) {
      for (const double at : std::vector<double>(positions[i]))
        changed = add_position(positions[j], *edges[j], edges[i]->at(at), tolerance) || changed;
    };
    for (const auto& [i, j] : along) hand_on(i, j), hand_on(j, i);
  }
  for (std::vector<double>& of_edge : positions) std::sort(of_edge.begin(), of_edge.end());
  return positions;
}

Edge part_of(const Edge& edge, double from, double to) {
  Edge part = edge;
  part.start = edge.at(from);
  part.end = edge.at(to);
  if (edge.arc) {
    part.arc->start_angle += from * edge.arc->sweep;
    part.arc->sweep *= to - from;
  }
  return part;
}

Overlap overlap_of(const Outline& a, const Outline& b, double tolerance) {
  const Box box_a = box_of(a), box_b = box_of(b);
  if ((box_a.high.array() < box_b.low.array()).any() || (box_b.high.array() < box_a.low.array()).any())
    return {false, true, true};
  std::vector<const Edge*> edges;
  for (const Outline* outline : {&a, &b})
    for (const Edge& edge : outline->edges) edges.push_back(&edge);
  const std::vector<std::vector<double>> positions = meeting_positions(edges, tolerance);
  Overlap overlap;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const bool of_a = e < a.edges.size();
    const Outline& other = of_a ? b : a;
    for (std::size_t k = 0; k + 1 < positions[e].size(); ++k) {
      const Edge part = part_of(*edges[e], positions[e][k], positions[e][k + 1]);
      const Vec2 middle = part.at(0.5);
      const auto on = std::find_if(other.edges.begin(), other.edges.end(),
                                   [&](const Edge& edge) { return distance_to(edge, middle) <= 4.0 * tolerance; });
      bool &own = of_a ? overlap.first_beyond : overlap.second_beyond,
           &of_other = of_a ? overlap.second_beyond : overlap.first_beyond;
      if (on != other.edges.end()) {
        // The two insides lie on the same side, or on opposite ones.
        const auto foot = foot_on(*on, middle), own_foot = foot_on(part, middle);
        if (foot && own_foot && foot->normal.dot(own_foot->normal) > 0.0)
          overlap.share_area = true;
        else
          own = of_other = true;
      } else if (encloses(other, middle)) {
        overlap.share_area = of_other = true;  // inside and outside of the own outline meet here
        overlap.crossing = part.start;
      } else {
        own = true;
      }
    }
  }
  return overlap;
}

}  // namespace scabo::geometry
