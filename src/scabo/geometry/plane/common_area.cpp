#include "scabo/geometry/plane/common_area.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/pieces.hpp"

namespace scabo::geometry {

namespace {

bool meet(const Box& a, const Box& b, double slack) {
  return (a.low.array() <= b.high.array() + slack).all() && (b.low.array() <= a.high.array() + slack).all();
}

/// The edges that reach a box, chains as the straight lines that they consist of.
std::vector<Edge> edges_in(const Outline& outline, const Box& box, double slack) {
  std::vector<Edge> edges;
  for (const Edge& edge : outline.edges) {
    if (!edge.is_chain()) {
      if (meet(box_of(edge), box, slack)) edges.push_back(edge);
      continue;
    }
    for (int i = 0; i < edge.segments(); ++i) {
      Edge line;
      line.start = edge.chain_point(i);
      line.end = edge.chain_point(i + 1);
      if (meet(box_of(line), box, slack)) edges.push_back(line);
    }
  }
  return edges;
}

/// Whether beside the middle of a part of one boundary, which meets the other one at its ends only or lies on it, the
/// other outline has its inside where the own one has it.
bool shares_side(const Edge& part, const Outline& other, const std::vector<Edge>& others, double tolerance) {
  const Vec2 middle = part.at(0.5);
  const auto on = std::find_if(others.begin(), others.end(),
                               [&](const Edge& edge) { return distance_to(edge, middle) <= 4.0 * tolerance; });
  if (on == others.end()) return encloses(other, middle);
  const auto foot = foot_on(*on, middle), own_foot = foot_on(part, middle);
  return foot && own_foot && foot->normal.dot(own_foot->normal) > 0.0;
}

}  // namespace

std::optional<Vec2> common_area(const Outline& a, const Outline& b, double tolerance) {
  const Box box_a = box_of(a), box_b = box_of(b);
  const Box common{box_a.low.cwiseMax(box_b.low), box_a.high.cwiseMin(box_b.high)};
  if ((common.high - common.low).minCoeff() <= tolerance) return {};
  const std::array<const Outline*, 2> outlines{&a, &b};
  const std::array<std::vector<Edge>, 2> near{edges_in(a, common, tolerance), edges_in(b, common, tolerance)};
  std::vector<const Edge*> edges;
  for (const std::vector<Edge>& of_one : near)
    for (const Edge& edge : of_one) edges.push_back(&edge);
  if (edges.empty()) {  // each outline has the whole common box inside or outside
    const Vec2 middle = 0.5 * (common.low + common.high);
    return encloses(a, middle) && encloses(b, middle) ? std::optional(middle) : std::nullopt;
  }
  const std::vector<std::vector<double>> positions = meeting_positions(edges, tolerance);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t other = e < near[0].size() ? 1 : 0;
    for (std::size_t k = 0; k + 1 < positions[e].size(); ++k) {
      const Edge part = part_of(*edges[e], positions[e][k], positions[e][k + 1]);
      if (shares_side(part, *outlines[other], near[other], tolerance)) return part.at(0.5);
    }
  }
  return {};
}

}  // namespace scabo::geometry
