#include "scabo/geometry/plane/touching.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::geometry {

namespace {

constexpr double rounding = 1e-6;        // of the length of an edge
constexpr double facing_cosine = -0.95;  // of the two outward normals
constexpr double least_share = 1e-3;     // of the shorter edge; less is the rounding of coordinates
constexpr int samples = 16;              // along an edge, for curves that come close to each other somewhere

/// Positions along `a` at which it may lie opposite `b`: the part between the feet of the ends of `b`, in its middle
/// and near its ends; points along all of `a`; and, where edges apart may be in contact, the point of an arc that is
/// nearest.
std::vector<double> positions_to_look_at(const Edge& a, const Edge& b, double reach) {
  std::vector<double> positions;
  for (int k = 0; k < samples; ++k) positions.push_back((k + 0.5) / samples);
  const auto start = foot_on(a, b.start), end = foot_on(a, b.end);
  if (start && end) {
    const auto [low, high] = std::minmax({std::clamp(start->t, 0.0, 1.0), std::clamp(end->t, 0.0, 1.0)});
    if ((high - low) * a.length() > least_share * std::min(a.length(), b.length()))
      for (const double s : {1e-3, 0.5, 1.0 - 1e-3}) positions.push_back(low + s * (high - low));
  }
  if (!a.arc || reach <= rounding * a.length()) return positions;
  if (const auto nearest = foot_on(b, a.arc->centre)) {
    const Vec2 ray = nearest->point - a.arc->centre;
    for (const double side : {1.0, -1.0})
      if (const auto own = foot_on(a, a.arc->centre + side * ray)) positions.push_back(own->t);
  }
  return positions;
}

/// Whether some point of `a` lies opposite a point of `b`, not at its ends.
bool lies_on(const Edge& a, const Edge& b, double reach) {
  for (const double t : positions_to_look_at(a, b, reach)) {
    if (t < 0.0 || t > 1.0) continue;
    const Vec2 point = a.at(t);
    const auto foot = foot_on(b, point), own = foot_on(a, point);
    if (!foot || !own || foot->t <= rounding || foot->t >= 1.0 - rounding) continue;
    if ((foot->point - point).norm() <= reach && own->normal.dot(foot->normal) < facing_cosine) return true;
  }
  return false;
}

struct Entry {
  Box box;
  int body = 0, edge = 0;
  double slack = 0.0;
  const Edge* of = nullptr;
};

/// The axis, 0 or 1, along which fewer boxes lie beside each other: y for a tower.
int axis_of_sweep(const std::vector<Entry>& entries) {
  if (entries.empty()) return 0;
  Box all = entries.front().box;
  Vec2 sizes = Vec2::Zero();
  for (const Entry& entry : entries) {
    all.low = all.low.cwiseMin(entry.box.low);
    all.high = all.high.cwiseMax(entry.box.high);
    sizes += entry.box.high - entry.box.low;
  }
  const Vec2 extent = all.high - all.low;
  return sizes.x() * extent.y() <= sizes.y() * extent.x() ? 0 : 1;
}

}  // namespace

std::vector<TouchingEdges> touching_edges(const std::vector<const Outline*>& outlines, double reach) {
  std::vector<Entry> entries;
  for (std::size_t b = 0; b < outlines.size(); ++b) {
    if (outlines[b] == nullptr) continue;
    for (std::size_t e = 0; e < outlines[b]->edges.size(); ++e) {
      const Edge& edge = outlines[b]->edges[e];
      entries.push_back(
          {box_of(edge), static_cast<int>(b), static_cast<int>(e), std::max(reach, rounding * edge.length()), &edge});
    }
  }
  const int along = axis_of_sweep(entries), across = 1 - along;
  std::sort(entries.begin(), entries.end(), [along](const Entry& a, const Entry& b) {
    return a.box.low[along] != b.box.low[along] ? a.box.low[along] < b.box.low[along]
                                                : std::pair(a.body, a.edge) < std::pair(b.body, b.edge);
  });
  std::vector<TouchingEdges> found;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& a = entries[i];
    std::erase_if(open, [&](std::size_t j) {
      return entries[j].box.high[along] + std::max(entries[j].slack, a.slack) < a.box.low[along];
    });
    for (const std::size_t j : open) {
      const Entry& b = entries[j];
      const double slack = std::max(a.slack, b.slack);
      if (a.body == b.body || b.box.high[across] + slack < a.box.low[across] ||
          a.box.high[across] + slack < b.box.low[across])
        continue;
      if (!lies_on(*a.of, *b.of, slack) && !lies_on(*b.of, *a.of, slack)) continue;
      const Entry &first = a.body < b.body ? a : b, &second = a.body < b.body ? b : a;
      found.push_back({first.body, first.edge, second.body, second.edge});
    }
    open.push_back(i);
  }
  std::sort(found.begin(), found.end(), [](const TouchingEdges& a, const TouchingEdges& b) {
    return std::tuple(a.body_a, a.body_b, a.edge_a, a.edge_b) < std::tuple(b.body_a, b.body_b, b.edge_a, b.edge_b);
  });
  return found;
}

}  // namespace scabo::geometry
