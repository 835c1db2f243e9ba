// A side of a contact whose elements are to match those of the other side (match.hpp): its break points.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "scabo/mesh/plane/interface.hpp"
#include "scabo/mesh/plane/rays.hpp"

namespace scabo::mesh {

/// For every body the nodes that stay where they are.
using FixedNodes = std::vector<std::set<int>>;

/// The end of an element on an edge, or the end of two.
struct BreakPoint {
  double t = 0.0;  // fraction of the length of the edge
  Vec2 point = Vec2::Zero();
  int before = -1, after = -1;  // last node of the element before, first one of that after; they differ at a mouth
  bool fixed = false;
  bool moved = false;
  bool added = false;
  int event = -1;  // index of the point that both sides have in common
};

/// One side of a contact: the elements of an edge, and its break points, one more than elements.
struct MatchedSide {
  std::shared_ptr<const model::Edge> edge;  // where it has moved, as all points of the side
  Vec2 moved = Vec2::Zero();
  int body = -1, index = -1;
  bool closed = false;
  double length = 0.0;
  std::vector<BreakPoint> breaks;
  std::vector<int> orders;
  std::optional<Rays> rays;  // along which the other side sees it; empty beside a rigid side

  double length_at(std::size_t i) const {  // of the shorter adjacent element
    double shortest = length;
    if (i > 0) shortest = std::min(shortest, (breaks[i].t - breaks[i - 1].t) * length);
    if (i + 1 < breaks.size()) shortest = std::min(shortest, (breaks[i + 1].t - breaks[i].t) * length);
    return shortest;
  }
  std::size_t nearest(double t) const {
    const auto above = std::lower_bound(breaks.begin(), breaks.end(), t,
                                        [](const BreakPoint& at, double value) { return at.t < value; });
    if (above == breaks.begin()) return 0;
    if (above == breaks.end()) return breaks.size() - 1;
    const auto i = static_cast<std::size_t>(above - breaks.begin());
    return t - breaks[i - 1].t < breaks[i].t - t ? i - 1 : i;
  }
};

/// The side of a contact at an edge of an elastic body, moved by `moved`.
MatchedSide side_of(const model::Model& model, int body, int edge, const std::vector<BodyMesh>& bodies,
                    const FixedNodes& fixed, const Vec2& moved);

/// The two sides of a contact between elastic bodies, always in the same order, however the contact names them.
struct SidesToMatch {
  model::Place first, second;
  std::array<Vec2, 2> moved;
};

/// Nothing if the sides of `joint` are not made to match: faces of cracks, rigid bodies, sides refined alike.
std::optional<SidesToMatch> sides_to_match(const model::Model& model, const Joint& joint,
                                           const std::vector<BodyMesh>& bodies);

/// Whether refinement changes the elements of both sides of a contact or tie alike, so that they must match from the
/// beginning: both bodies are one super-element with a mesh.tolerance.
bool is_refined_alike(const model::Model& model, const Joint& joint);

}  // namespace scabo::mesh
