#include "scabo/analysis/growth/split.hpp"

#include <algorithm>
#include <numeric>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"

namespace scabo::analysis {

namespace {

/// Sets of closed boundaries and cracks that are joined.
class Joined {
 public:
  explicit Joined(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), std::size_t{0}); }

  /// False if they were joined already.
  bool join(std::size_t one, std::size_t other) {
    one = root_of(one), other = root_of(other);
    parents_[one] = other;
    return one != other;
  }

 private:
  std::size_t root_of(std::size_t at) const {
    while (parents_[at] != at) at = parents_[at];
    return at;
  }
  std::vector<std::size_t> parents_;
};

bool is_on(const std::vector<Vec2>& path, const Vec2& x, double tolerance) {
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Vec2 along = path[k + 1] - path[k];
    const double part = std::clamp((x - path[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    if ((path[k] + part * along - x).norm() <= tolerance) return true;
  }
  return false;
}

/// Whether a path ends on itself.
bool meets_itself(const std::vector<Vec2>& path, bool at_end, double tolerance) {
  std::vector<Vec2> rest = path;
  rest.erase(at_end ? rest.end() - 1 : rest.begin());
  return is_on(rest, at_end ? path.back() : path.front(), tolerance);
}

/// The closed boundary of an edge: 0 the outer one, then those of the holes.
std::size_t loop_of(const geometry::Outline& outline, std::size_t edge) {
  return static_cast<std::size_t>(std::upper_bound(outline.holes.begin(), outline.holes.end(), static_cast<int>(edge)) -
                                  outline.holes.begin());
}

}  // namespace

bool is_split(const model::Body& body) {
  const double tolerance = 1e-8 * geometry::outline_size(body.outline);
  const std::size_t loops = body.outline.holes.size() + 1;
  Joined joined(loops + body.cracks.size());
  struct Junction {
    std::size_t one, other;
    Vec2 at;
  };
  std::vector<Junction> junctions;  // of two cracks, of which both may end there
  for (std::size_t c = 0; c < body.cracks.size(); ++c) {
    const std::vector<Vec2>& path = body.cracks[c].path;
    for (const bool at_end : {false, true}) {
      const Vec2& here = at_end ? path.back() : path.front();
      const auto& edges = body.outline.edges;
      const auto edge = std::find_if(edges.begin(), edges.end(), [&](const geometry::Edge& one) {
        return geometry::distance_to(one, here) <= tolerance;
      });
      if (edge != edges.end()) {
        const std::size_t loop = loop_of(body.outline, static_cast<std::size_t>(edge - edges.begin()));
        if (!joined.join(loop, loops + c)) return true;
        continue;
      }
      if (meets_itself(path, at_end, tolerance)) return true;
      for (std::size_t other = 0; other < body.cracks.size(); ++other) {
        if (other == c || !is_on(body.cracks[other].path, here, tolerance)) continue;
        const bool known = std::any_of(junctions.begin(), junctions.end(), [&](const Junction& one) {
          return one.one == other && one.other == c && (one.at - here).norm() <= tolerance;
        });
        if (!known && !joined.join(loops + other, loops + c)) return true;
        junctions.push_back({c, other, here});
        break;
      }
    }
  }
  return false;
}

}  // namespace scabo::analysis
