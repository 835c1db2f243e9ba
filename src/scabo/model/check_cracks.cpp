// Validation of the cracks of a body.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/geometry/plane/pieces.hpp"
#include "scabo/model/body_check.hpp"

namespace scabo::model {

namespace {

bool check_crack(const BodyCheck& of) {
  const Crack& crack = of.body.cracks.front();
  Checking& checking = of.checking;
  const std::string path = of.path + ".cracks.0";
  const std::string& body = of.body.name;
  if (!is_name(crack.name)) {
    checking.error(path, "name",
                   fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin with a "
                               "letter or _",
                               crack.name));
    return false;
  }
  bool good = true;
  if (!checking.vector(path, "tip", crack.tip)) {
    good = false;
  } else if (!encloses(of.outline, crack.tip)) {
    checking.error(path, "tip",
                   fmt::format("the tip {} is not inside body '{}': move the tip", point_text(crack.tip), body));
    good = false;
  }
  const double size = outline_size(of.outline);
  if (!checking.vector(path, "mouth", crack.mouth)) {
    good = false;
  } else if (crack.edge < 0 || crack.edge >= of.edges() || !(crack.at >= 0.0 && crack.at < 1.0) ||
             (of.edge(crack.edge).at(crack.at) - crack.mouth).norm() > 1e-9 * size) {
    checking.error(path, "mouth",
                   fmt::format("{} does not lie on the boundary of '{}': place the mouth of the crack on the boundary",
                               point_text(crack.mouth), body));
    good = false;
  } else if (crack.at > 0.0 && std::min((of.edge(crack.edge).start - crack.mouth).norm(),
                                        (of.edge(crack.edge).end - crack.mouth).norm()) < 1e-6 * size) {
    checking.error(path, "mouth",
                   fmt::format("{} is close to a corner of '{}' but not on it: place the mouth on the corner, or "
                               "farther from it",
                               point_text(crack.mouth), body));
    good = false;
  }
  const auto taken = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), crack.name) != names.end();
  };
  const auto& edges = of.outline.edges;
  const auto& corners = of.outline.corners;
  const bool edge = std::any_of(edges.begin(), edges.end(), [&](const Edge& e) { return taken(e.names); });
  if (edge || std::any_of(corners.begin(), corners.end(), [&](const Corner& c) { return taken(c.names); })) {
    checking.error(path, "",
                   fmt::format("{} of '{}' is also named '{}': give the crack another name",
                               edge ? "an edge" : "a corner", body, crack.name));
    good = false;
  }
  return good;
}

/// The segments of a path as edges.
std::vector<Edge> segments_of(const std::vector<Vec2>& path) {
  std::vector<Edge> segments;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    segments.emplace_back();
    segments.back().start = path[k];
    segments.back().end = path[k + 1];
  }
  return segments;
}

/// The points of a path: inside, and none twice in a row.
bool check_points_of_path(const BodyCheck& of, const std::string& path, const Crack& crack, double tolerance) {
  if (crack.path.size() < 2) {
    of.checking.error(path, "path", "needs two points or more: the ends of the crack");
    return false;
  }
  for (std::size_t k = 0; k < crack.path.size(); ++k) {
    const Vec2& point = crack.path[k];
    if (!of.checking.vector(path, fmt::format("path.{}", k), point)) return false;
    if (!encloses(of.outline, point) && distance_to(of.outline, point) > tolerance) {
      of.checking.error(path, "path",
                        fmt::format("{} lies outside of body '{}': cracks lie inside or end on the boundary",
                                    point_text(point), of.body.name));
      return false;
    }
    if (k > 0 && (point - crack.path[k - 1]).norm() <= 10.0 * tolerance) {
      of.checking.error(path, "path",
                        fmt::format("{} and {} are too close to each other: leave one out",
                                    point_text(crack.path[k - 1]), point_text(point)));
      return false;
    }
  }
  return true;
}

/// A crack meets the boundary with its ends only.
bool check_boundary_of_path(const BodyCheck& of, const std::string& path, const Crack& crack, double tolerance) {
  for (const Edge& segment : segments_of(crack.path))
    for (const Edge& edge : of.outline.edges) {
      const std::vector<Vec2> shared = shared_points(segment, edge, tolerance);
      const bool along = !edge.arc && shared.size() > 1;
      if (along && of.body.imported) continue;  // the file was slit there when it was made
      for (const Vec2& point : shared) {
        const double to_ends = std::min((point - crack.path.front()).norm(), (point - crack.path.back()).norm());
        if (!along && to_ends <= 3.0 * tolerance) continue;
        of.checking.error(path, "path",
                          fmt::format("meets {} at {}, between its ends: cracks lie inside the body, and only their "
                                      "ends may lie on the boundary",
                                      shown_name(edge), point_text(point)));
        return false;
      }
    }
  return true;
}

/// Cracks in a body of many cells.
bool check_paths(const BodyCheck& of) {
  const double tolerance = 1e-9 * outline_size(of.outline);
  std::unordered_set<std::string> names;
  std::vector<std::pair<Edge, std::string>> before;  // segments, and the names of their cracks
  bool good = true;
  for (std::size_t c = 0; c < of.body.cracks.size(); ++c) {
    const Crack& crack = of.body.cracks[c];
    const std::string path = fmt::format("{}.cracks.{}", of.path, c);
    if (!is_name(crack.name)) {
      of.checking.error(path, "name",
                        fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin "
                                    "with a letter or _",
                                    crack.name));
      good = false;
    } else if (!names.insert(crack.name).second) {
      of.checking.error(path, "name",
                        fmt::format("there is already a crack named '{}': give every crack a name of its "
                                    "own",
                                    crack.name));
      good = false;
    }
    if (!check_points_of_path(of, path, crack, tolerance) || !check_boundary_of_path(of, path, crack, tolerance)) {
      good = false;
      continue;
    }
    for (const Edge& segment : segments_of(crack.path)) {
      const auto lies_on = [&](const Edge& other) { return shared_points(segment, other, tolerance).size() > 1; };
      const auto other = std::find_if(before.begin(), before.end(), [&](const auto& b) { return lies_on(b.first); });
      if (other != before.end() && good) {
        of.checking.error(path, "path",
                          fmt::format("lies on {} near {}: cracks may cross, but not lie on each other",
                                      other->second == crack.name ? "itself" : "crack '" + other->second + "'",
                                      point_text(segment.start)));
        good = false;
      }
      before.emplace_back(segment, crack.name);
      for (const Region& region : of.body.regions)
        for (const Edge& edge : region.outline.edges)
          if (good && !edge.arc && lies_on(edge)) {
            of.checking.error(path, "path",
                              fmt::format("lies on the border of region '{}' near {}: cracks may cross "
                                          "borders of regions, but not lie on them",
                                          region.name, point_text(segment.start)));
            good = false;
          }
    }
  }
  return good;
}

}  // namespace

bool check_cracks(const BodyCheck& of) {
  const auto& cracks = of.body.cracks;
  if (cracks.empty()) return true;
  if (of.body.outside) {
    of.checking.error_of_key(of.path, "cracks",
                             "cracks in a body with outside: true are not available in this version: leave them out");
    return false;
  }
  if (of.body.mesh.kind != MeshKind::superelement) return check_paths(of);
  if (!cracks.front().path.empty()) {
    of.checking.error(
        of.path, "cracks.0",
        "a crack with a 'path' needs many cells: write kind: polygons or kind: quadtree, or give 'tip' and "
        "'mouth' of a straight crack");
    return false;
  }
  if (cracks.size() > 1) {
    of.checking.error(of.path, "cracks.1",
                      "a body that is one super-element has at most one crack: write kind: polygons or kind: quadtree");
    return false;
  }
  return check_crack(of);
}

}  // namespace scabo::model
