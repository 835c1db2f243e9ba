#include "scabo/mesh/plane/star_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "scabo/mesh/plane/domain_triangles.hpp"
#include "scabo/mesh/plane/polygon_kernel.hpp"
#include "scabo/mesh/plane/refusal.hpp"

namespace scabo::mesh {

namespace {

/// Arcs count as chords that turn by at most this at first; in thin curved shapes by less, as far down as this.
constexpr double coarse_turn = std::numbers::pi / 4, least_turn = std::numbers::pi / 128;
/// Least height over length of a side as seen from the centre of a joined part (polygon_kernel.hpp).
constexpr double well_seen = 0.12;
/// A part with less than this is joined to any neighbour with which it is seen better.
constexpr double poorly_seen = 0.05;
/// The same of any part; if less, arcs are divided into more chords.
constexpr double hardly_seen = 0.02;

using Ends = std::pair<int, int>;

class Division {
 public:
  Division(const Domain& domain, double turn) : domain_(domain), coarse_(coarse_points_of_lines(domain, turn)) {
    const RegionTriangles triangles = triangles_of(coarse_.points, coarse_, domain);
    for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
      const auto& vertices = triangles.triangles[t].vertices;
      parts_.push_back({{vertices.begin(), vertices.end()}, triangles.regions[t]});
      for (std::size_t k = 0; k < 3; ++k) {
        const Ends side = std::minmax(vertices[(k + 1) % 3], vertices[(k + 2) % 3]);
        if (!coarse_.segments.contains(side)) at_side_[side].push_back(t);
      }
    }
    join_parts();
  }

  /// Least measure of the centres of all parts.
  double seen() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Part& part : parts_)
      if (!part.corners.empty()) least = std::min(least, centre_of(part).visibility);
    return least;
  }

  PolygonMesh mesh() {
    PolygonMesh mesh;
    mesh.nodes = coarse_.points;
    number_lines(mesh);
    for (const Part& part : parts_) {
      if (part.corners.empty()) continue;
      PolygonCell cell;
      cell.region = part.region;
      for (std::size_t i = 0; i < part.corners.size(); ++i)
        for (const int node : side_nodes(mesh, part.corners[i], part.corners[(i + 1) % part.corners.size()]))
          cell.nodes.push_back(node);
      cell.centre = centre_of(part).centre;
      mesh.cells.push_back(std::move(cell));
    }
    return mesh;
  }

 private:
  struct Part {
    std::vector<int> corners;  // counter-clockwise; empty: joined to another
    int region = 0;
  };
  struct Candidate {
    double seen = 0.0;
    std::vector<int> corners;
  };

  std::vector<Vec2> points_of(const std::vector<int>& corners) const {
    std::vector<Vec2> points;
    for (const int corner : corners) points.push_back(coarse_.points[static_cast<std::size_t>(corner)]);
    return points;
  }

  /// The same, and along arcs that are hollow as seen from inside the points where tangents at the points of the line
  /// meet: who sees these tangents sees the arc.
  std::vector<Vec2> fine_points_of(const std::vector<int>& corners) const {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      points.push_back(coarse_.points[static_cast<std::size_t>(a)]);
      const auto found = coarse_.segments.find(std::minmax(a, b));
      if (found == coarse_.segments.end()) continue;
      const LinePoints::Segment& segment = found->second;
      const auto& line = domain_.lines[static_cast<std::size_t>(segment.line)];
      const bool forwards = segment.from == a;
      if (!line.arc || (line.arc->sweep > 0.0) == forwards) continue;
      const int step = forwards ? 1 : -1, first = forwards ? segment.first : segment.last;
      const int last = forwards ? segment.last : segment.first;
      for (int k = first; k != last; k += step) {
        const Vec2 from = line.points[static_cast<std::size_t>(k)] - line.arc->centre,
                   to = line.points[static_cast<std::size_t>(k + step)] - line.arc->centre, middle = 0.5 * (from + to);
        points.push_back(line.arc->centre + from.squaredNorm() / middle.squaredNorm() * middle);
      }
    }
    return points;
  }

  /// The point from which the part is seen best; its measure is that of the coarse sides, 0 if not all of an arc is
  /// seen.
  KernelCentre centre_of(const Part& part) const {
    const std::vector<Vec2> fine = fine_points_of(part.corners);
    KernelCentre centre = kernel_centre(fine, std::numeric_limits<double>::infinity());
    if (!(centre.visibility > 0.0)) return centre;
    centre.visibility = std::min(centre.visibility, visibility(points_of(part.corners), centre.centre));
    return centre;
  }

  /// The union of two parts with the common side `side`; nothing if they have separate common sides.
  std::optional<std::vector<int>> joined(const Part& a, const Part& b, const Ends& side) const {
    const auto start_of = [&](const Part& part) {
      for (std::size_t i = 0; i < part.corners.size(); ++i)
        if (Ends(std::minmax(part.corners[i], part.corners[(i + 1) % part.corners.size()])) == side) return i;
      return part.corners.size();
    };
    const std::size_t na = a.corners.size(), nb = b.corners.size();
    std::size_t i = start_of(a), j = start_of(b);
    if (i == na || j == nb) return std::nullopt;
    // The common chain runs forwards in a and backwards in b: find its ends.
    std::size_t before = 0, after = 0;
    while (before + 2 < std::min(na, nb) && a.corners[(i + na - before - 1) % na] == b.corners[(j + 2 + before) % nb])
      ++before;
    while (before + after + 2 < std::min(na, nb) &&
           a.corners[(i + 2 + after) % na] == b.corners[(j + nb - after - 1) % nb])
      ++after;
    std::vector<int> corners;
    const std::size_t inner = before + after + 1;  // common sides
    for (std::size_t k = 0; k <= na - inner; ++k) corners.push_back(a.corners[(i + 1 + after + k) % na]);
    for (std::size_t k = 1; k < nb - inner; ++k) corners.push_back(b.corners[(j + 1 + before + k) % nb]);
    std::vector<int> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;  // around a hole
    return corners;
  }

  Candidate candidate(const Ends& side, const std::vector<std::size_t>& sides) const {
    const Part &a = parts_[sides[0]], &b = parts_[sides[1]];
    Candidate made;
    if (sides[0] == sides[1] || a.region != b.region) return made;
    auto corners = joined(a, b, side);
    if (!corners) return made;
    made.corners = std::move(*corners);
    made.seen = centre_of({made.corners, a.region}).visibility;
    return made;
  }

  /// Whether joining the two parts at a side is worth it.
  bool is_better(const Ends& side, const Candidate& candidate) const {
    if (candidate.seen > well_seen) return true;
    if (candidate.corners.empty()) return false;
    double worse = poorly_seen;
    for (const std::size_t part : at_side_.at(side)) worse = std::min(worse, centre_of(parts_[part]).visibility);
    return worse < poorly_seen && candidate.seen > worse;
  }

  void join_parts() {
    std::map<Ends, Candidate> candidates;
    for (const auto& [side, sides] : at_side_)
      if (sides.size() == 2) candidates[side] = candidate(side, sides);
    while (true) {
      auto best = candidates.end();
      for (auto at = candidates.begin(); at != candidates.end(); ++at)
        if ((best == candidates.end() || at->second.seen > best->second.seen) && is_better(at->first, at->second))
          best = at;
      if (best == candidates.end()) return;
      const std::size_t kept = at_side_[best->first][0], gone = at_side_[best->first][1];
      parts_[kept].corners = best->second.corners;
      parts_[gone].corners.clear();
      for (auto& [side, sides] : at_side_) {
        bool changed = false;
        for (std::size_t& part : sides) {
          changed = changed || part == kept || part == gone;
          if (part == gone) part = kept;
        }
        if (!changed || sides.size() != 2) continue;
        if (sides[0] == sides[1])
          candidates.erase(side);
        else
          candidates[side] = candidate(side, sides);
      }
    }
  }

  /// All points of the lines as nodes, in `left` and `right`.
  void number_lines(PolygonMesh& mesh) const {
    for (std::size_t l = 0; l < domain_.lines.size(); ++l) {
      const auto& points = domain_.lines[l].points;
      std::vector<int> chain(points.size(), -1);
      chain.front() = coarse_.lines[l].front();
      chain.back() = coarse_.lines[l].back();
      for (std::size_t i = 0; i + 1 < coarse_.lines[l].size(); ++i) {
        const LinePoints::Segment& segment =
            coarse_.segments.at(std::minmax(coarse_.lines[l][i], coarse_.lines[l][i + 1]));
        chain[static_cast<std::size_t>(segment.first)] = segment.from;
        chain[static_cast<std::size_t>(segment.last)] = segment.to;
      }
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (chain[k] >= 0) continue;
        chain[k] = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(points[k]);
      }
      mesh.left.push_back(chain);
    }
    mesh.right = mesh.left;
  }

  /// Nodes of the side from corner a on, without b.
  std::vector<int> side_nodes(PolygonMesh& mesh, int a, int b) {
    std::vector<int> nodes;
    if (const auto found = coarse_.segments.find(std::minmax(a, b)); found != coarse_.segments.end()) {
      const LinePoints::Segment& segment = found->second;
      const std::vector<int>& chain = mesh.left[static_cast<std::size_t>(segment.line)];
      nodes.assign(chain.begin() + segment.first, chain.begin() + segment.last + 1);
      if (segment.from != a) std::reverse(nodes.begin(), nodes.end());
      nodes.pop_back();
      return nodes;
    }
    const auto [found, is_new] = cuts_.try_emplace(std::minmax(a, b));
    if (is_new) {
      const Vec2 &from = coarse_.points[static_cast<std::size_t>(std::min(a, b))],
                 &to = coarse_.points[static_cast<std::size_t>(std::max(a, b))];
      const double size = domain_.size(0.5 * (from + to));
      const double count = std::max(1.0, std::ceil((to - from).norm() / size - 1e-9));
      for (int k = 1; k < count; ++k) {
        found->second.push_back(static_cast<int>(mesh.nodes.size()));
        mesh.nodes.push_back(from + k / count * (to - from));
      }
    }
    nodes.push_back(a);
    if (a < b)
      nodes.insert(nodes.end(), found->second.begin(), found->second.end());
    else
      nodes.insert(nodes.end(), found->second.rbegin(), found->second.rend());
    return nodes;
  }

  const Domain& domain_;
  LinePoints coarse_;
  std::vector<Part> parts_;
  std::map<Ends, std::vector<std::size_t>> at_side_;  // parts on both sides, where no line is
  std::map<Ends, std::vector<int>> cuts_;             // nodes between the ends of new sides, from the lower number
};

}  // namespace

PolygonMesh star_cells(const Domain& domain) {
  for (double turn = coarse_turn;; turn *= 0.5) {
    Division division(domain, turn);
    const double seen = division.seen();
    if (seen > hardly_seen || (seen > 0.0 && turn <= least_turn)) return division.mesh();
    if (turn <= least_turn) throw Refusal("a part between two arcs is too thin for its sides");
  }
}

}  // namespace scabo::mesh
