// Improvement of the cells that lines cut: no short sides, no small cells, no unseen sides.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "scabo/mesh/plane/polygon_kernel.hpp"
#include "scabo/mesh/plane/quadtree/pieces.hpp"

namespace scabo::mesh::quadtree {

namespace {

// In parts of the size of a cell. A step that leaves a cell with less clearance than `fair` is taken only if it makes
// no cell much worse; cells with less than `poor`, or with an area below `small`, are merged with a neighbour if that
// helps.
constexpr double fair = 0.08, poor = 0.05, small_area = 0.1;
/// Least sight of a cell beside a hollow arc.
constexpr double seen_beside_arc = 0.01;
/// Least distance of a side on an arc from its centre, in radii: it turns by less than about 90 degrees.
constexpr double least_turned = 0.7;

std::vector<Vec2> corners_of(const Pieces& pieces, const std::vector<int>& nodes) {
  std::vector<Vec2> corners;
  corners.reserve(nodes.size());
  for (int node : nodes) corners.push_back(pieces.nodes[node]);
  return corners;
}

/// The corners of a cell, and where its sides are hollow arcs the points at which their end tangents meet: such a side
/// is seen from where these tangents are seen. Empty if a side turns too far.
std::vector<Vec2> outline_of(const Pieces& pieces, const std::vector<int>& nodes, bool open) {
  if (pieces.curved.empty()) return corners_of(pieces, nodes);
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int a = nodes[i], b = nodes[i + 1 < nodes.size() ? i + 1 : 0];
    const Vec2 &from = pieces.nodes[a], &to = pieces.nodes[b];
    outline.push_back(from);
    const auto side = pieces.line_sides.find(side_key(a, b));
    if (side == pieces.line_sides.end() || (open && i + 1 == nodes.size())) continue;
    const std::optional<geometry::Arc>& arc = pieces.curved[side->second].arc;
    if (!arc) continue;
    const Vec2 middle = 0.5 * (from + to) - arc->centre;
    if (!(middle.norm() > least_turned * arc->radius)) return {};
    if (cross(from - arc->centre, to - arc->centre) >= 0.0) continue;  // it bulges outwards
    outline.push_back(arc->centre + (from - arc->centre).squaredNorm() / middle.squaredNorm() * middle);
  }
  return outline;
}

/// Whether the centre is a point of the domain: of open cells, and of cells around a corner of several regions.
bool is_fixed(const PolygonCell& cell) { return cell.open || !cell.side_regions.empty(); }

/// Of a cell that is to have the given nodes.
double clearance_with(const Pieces& pieces, const PolygonCell& cell, const std::vector<int>& nodes) {
  const std::vector<Vec2> corners = outline_of(pieces, nodes, cell.open);
  if (corners.empty()) return -1.0;
  return is_fixed(cell) ? clearance_from(cell.centre, corners, !cell.open) : best_sight(corners).clearance;
}

double clearance_of(const Pieces& pieces, const PolygonCell& cell) { return clearance_with(pieces, cell, cell.nodes); }

/// The cells around the nodes of cut cells.
class Surroundings {
 public:
  explicit Surroundings(const Pieces& pieces) : cells_of_(pieces.nodes.size()) {
    std::vector<char> wanted(pieces.nodes.size(), 0);
    for (std::size_t k = pieces.first_cut; k < pieces.cells.size(); ++k) {
      for (int node : pieces.cells[k].nodes) wanted[node] = 1;
    }
    for (std::size_t k = 0; k < pieces.cells.size(); ++k) {
      for (int node : pieces.cells[k].nodes) {
        if (wanted[node]) add(node, int(k));
      }
    }
  }

  const std::vector<int>& around(int node) const { return cells_of_[node]; }
  void add(int node, int cell) {
    std::vector<int>& cells = cells_of_[node];
    if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  }
  void remove(int node, int cell) {
    std::vector<int>& cells = cells_of_[node];
    cells.erase(std::remove(cells.begin(), cells.end(), cell), cells.end());
  }

 private:
  std::vector<std::vector<int>> cells_of_;
};

/// Node `gone` moves to `kept` only along its own line, and does not come from outside to a line.
bool may_move(const Pieces& pieces, int gone, int kept) {
  if (pieces.holds[gone] == Hold::corner) return false;
  const auto between = pieces.line_sides.find(side_key(kept, gone));
  if (pieces.holds[gone] != Hold::line) return between == pieces.line_sides.end();
  return between != pieces.line_sides.end() && between->second == pieces.line_of[gone];
}

/// Whether a triangle may vanish whose sides from a third node to `kept` and `gone` become one: not both may be on
/// lines.
bool may_vanish(const Pieces& pieces, const PolygonCell& triangle, int gone, int kept) {
  int third = -1;
  for (int node : triangle.nodes) {
    if (node != kept && node != gone) third = node;
  }
  return third >= 0 &&
         !(pieces.line_sides.count(side_key(kept, third)) && pieces.line_sides.count(side_key(gone, third)));
}

/// The nodes of a cell once `gone` is where `kept` is, empty if it vanishes; nothing if it would be badly shaped.
std::optional<std::vector<int>> nodes_without(const Pieces& pieces, int index, int gone, int kept) {
  const PolygonCell& cell = pieces.cells[index];
  std::vector<int> nodes = cell.nodes;
  const bool has_both = std::find(nodes.begin(), nodes.end(), kept) != nodes.end();
  if (cell.open && has_both && (nodes.front() == nodes.back())) return std::nullopt;
  if (!cell.side_regions.empty() && has_both) return std::nullopt;
  std::replace(nodes.begin(), nodes.end(), gone, kept);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (!cell.open && nodes.size() > 1 && nodes.front() == nodes.back()) nodes.pop_back();
  if (has_both && std::count(nodes.begin(), nodes.end(), kept) > 1) return std::nullopt;
  if (nodes.size() < 3) {
    if (cell.open || !may_vanish(pieces, cell, gone, kept)) return std::nullopt;
    return std::vector<int>();
  }
  const double after = clearance_with(pieces, cell, nodes);
  if (after < fair * pieces.sizes[index] && after < 0.8 * clearance_of(pieces, cell)) return std::nullopt;
  if (!(after > 0.0) && !(clearance_of(pieces, cell) <= 0.0 && polygon_area(corners_of(pieces, nodes)) > 0.0))
    return std::nullopt;
  return nodes;
}

/// The other nodes of the sides of `gone` on lines, and these lines; nothing if `kept` has a side on a line to one of
/// them. A cell on only one side of a piece of a line that vanishes would change the body.
std::optional<std::map<int, int>> sides_that_move(const Pieces& pieces, const std::vector<int>& cells, int gone,
                                                  int kept) {
  std::map<int, int> moved;
  for (int index : cells) {
    for (int node : pieces.cells[index].nodes) {
      if (node == gone || node == kept) continue;
      const auto side = pieces.line_sides.find(side_key(gone, node));
      if (side == pieces.line_sides.end()) continue;
      if (pieces.line_sides.count(side_key(kept, node))) return std::nullopt;
      moved.emplace(node, side->second);
    }
  }
  return moved;
}

/// Puts node `gone` where `kept` is, if the cells around stay well shaped.
bool collapse(Pieces& pieces, Surroundings& surroundings, int kept, int gone) {
  if (!may_move(pieces, gone, kept)) return false;
  std::vector<std::pair<int, std::vector<int>>> changes;  // cell, its nodes
  for (int index : surroundings.around(gone)) {
    std::optional<std::vector<int>> nodes = nodes_without(pieces, index, gone, kept);
    if (!nodes) return false;
    changes.emplace_back(index, std::move(*nodes));
  }
  const auto moved = sides_that_move(pieces, surroundings.around(gone), gone, kept);
  if (!moved) return false;
  for (const auto& [node, line] : *moved) {
    pieces.line_sides.erase(side_key(gone, node));
    pieces.line_sides.emplace(side_key(kept, node), line);
  }
  pieces.line_sides.erase(side_key(kept, gone));
  if (pieces.holds[gone] == Hold::line) {
    std::vector<int>& chain = pieces.chains[pieces.line_of[gone]];
    chain.erase(std::remove(chain.begin(), chain.end(), gone), chain.end());
  }
  for (auto& [cell, nodes] : changes) {
    for (int node : pieces.cells[cell].nodes) surroundings.remove(node, cell);
    for (int node : nodes) surroundings.add(node, cell);
    pieces.cells[cell].nodes = std::move(nodes);
  }
  return true;
}

}  // namespace

void collapse_short_sides(Pieces& pieces, double shortest) {
  Surroundings surroundings(pieces);
  for (int round = 0; round < 4; ++round) {
    struct Short {
      double length;
      int a, b;
    };
    std::vector<Short> found;
    for (std::size_t k = pieces.first_cut; k < pieces.cells.size(); ++k) {
      const PolygonCell& cell = pieces.cells[k];
      for (std::size_t i = 0; i + (cell.open ? 1 : 0) < cell.nodes.size(); ++i) {
        const int a = cell.nodes[i], b = cell.nodes[i + 1 < cell.nodes.size() ? i + 1 : 0];
        const double length = (pieces.nodes[a] - pieces.nodes[b]).norm();
        if (length < shortest * pieces.sizes[k]) found.push_back({length, std::min(a, b), std::max(a, b)});
      }
    }
    std::sort(found.begin(), found.end(), [](const Short& x, const Short& y) {
      return x.length != y.length ? x.length < y.length : x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    bool changed = false;
    for (const Short& side : found) {
      const auto& around = surroundings.around(side.a);
      const bool there = std::any_of(around.begin(), around.end(), [&](int index) {
        const std::vector<int>& nodes = pieces.cells[index].nodes;
        return std::find(nodes.begin(), nodes.end(), side.b) != nodes.end();
      });
      if (!there) continue;
      const bool a_first = pieces.holds[side.a] >= pieces.holds[side.b];
      const int kept = a_first ? side.a : side.b, gone = a_first ? side.b : side.a;
      if (pieces.holds[kept] == Hold::nothing) continue;
      if (collapse(pieces, surroundings, kept, gone) ||
          (pieces.holds[kept] == pieces.holds[gone] && collapse(pieces, surroundings, gone, kept))) {
        changed = true;
      }
    }
    if (!changed) break;
  }
}

void divide_unseen_cells(Pieces& pieces) {
  for (std::size_t k = pieces.first_cut; k < pieces.cells.size(); ++k) {
    while (!is_fixed(pieces.cells[k]) && pieces.cells[k].nodes.size() > 3) {
      const double clearance = best_sight(corners_of(pieces, pieces.cells[k].nodes)).clearance;
      if (!(clearance < 0.4 * poor * pieces.sizes[k])) break;
      Halves halves = best_division(pieces.cells[k].nodes, pieces.nodes);
      if (halves.first.empty() || !(halves.clearance > clearance || halves.clearance <= 0.0)) break;
      pieces.cells.push_back({std::move(halves.second), Vec2::Zero(), pieces.cells[k].region, {}, false});
      pieces.sizes.push_back(pieces.sizes[k]);
      pieces.cells[k].nodes = std::move(halves.first);
    }
  }
}

namespace {

/// The union of two cells that share one run of sides, none on a line; empty if it is not one polygon.
std::vector<int> united(const Pieces& pieces, const Surroundings& surroundings, const std::vector<int>& first,
                        const std::vector<int>& second) {
  const int n = int(first.size()), m = int(second.size());
  const auto shared = [&](int i) {
    const int a = first[i], b = first[(i + 1) % n];
    if (pieces.line_sides.count(side_key(a, b))) return false;
    for (int j = 0; j < m; ++j) {
      if (second[j] == b && second[(j + 1) % m] == a) return true;
    }
    return false;
  };
  int starts = 0, start = -1, count = 0;
  for (int i = 0; i < n; ++i) {
    if (!shared(i)) continue;
    ++count;
    if (!shared((i + n - 1) % n)) {
      ++starts;
      start = i;
    }
  }
  if (starts != 1 || count >= n || count >= m) return {};
  for (int i = 1; i < count; ++i) {
    const int node = first[(start + i) % n];
    if (pieces.holds[node] != Hold::nothing || surroundings.around(node).size() > 2) return {};
  }
  std::vector<int> nodes;
  for (int i = count; i < n; ++i) nodes.push_back(first[(start + i) % n]);
  const int from = int(std::find(second.begin(), second.end(), first[start]) - second.begin());
  for (int j = 0; j < m - count; ++j) nodes.push_back(second[(from + j) % m]);
  std::vector<int> sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
  return nodes;
}

}  // namespace

void merge_small_cells(Pieces& pieces) {
  Surroundings surroundings(pieces);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t k = pieces.first_cut; k < pieces.cells.size(); ++k) {
      if (is_fixed(pieces.cells[k]) || pieces.cells[k].nodes.empty()) continue;
      const double size = pieces.sizes[k];
      const double own = clearance_of(pieces, pieces.cells[k]);
      if (own >= poor * size && polygon_area(corners_of(pieces, pieces.cells[k].nodes)) >= small_area * size * size)
        continue;
      std::vector<int> neighbours;
      for (int node : pieces.cells[k].nodes) {
        for (int other : surroundings.around(node)) {
          if (other == int(k) || is_fixed(pieces.cells[other]) || pieces.cells[other].region != pieces.cells[k].region)
            continue;
          if (std::find(neighbours.begin(), neighbours.end(), other) == neighbours.end()) neighbours.push_back(other);
        }
      }
      std::sort(neighbours.begin(), neighbours.end());
      int best = -1;
      double best_clearance = 0.0;
      std::vector<int> best_nodes;
      for (int other : neighbours) {
        std::vector<int> nodes = united(pieces, surroundings, pieces.cells[k].nodes, pieces.cells[other].nodes);
        if (nodes.empty()) continue;
        const double larger = std::max(size, pieces.sizes[other]);
        const std::vector<Vec2> outline = outline_of(pieces, nodes, false);
        if (outline.empty()) continue;
        const double clearance = best_sight(outline).clearance;
        // Cells of the tree have 0.5: a neighbour is spoiled less by a cut cell.
        if (clearance < 1.5 * own ||
            clearance < std::min(2.0 * fair * larger, clearance_of(pieces, pieces.cells[other])))
          continue;
        if (clearance > best_clearance) {
          best = other;
          best_clearance = clearance;
          best_nodes = std::move(nodes);
        }
      }
      if (best < 0) continue;
      for (int index : {int(k), best}) {
        for (int node : pieces.cells[index].nodes) surroundings.remove(node, index);
      }
      for (int node : best_nodes) surroundings.add(node, int(k));
      pieces.cells[k].nodes = std::move(best_nodes);
      pieces.cells[best].nodes.clear();
      pieces.sizes[k] = std::max(size, pieces.sizes[best]);
    }
  }
}

void place_centres(Pieces& pieces, std::vector<Vec2>& trouble) {
  for (std::size_t k = 0; k < pieces.cells.size(); ++k) {
    PolygonCell& cell = pieces.cells[k];
    if (cell.nodes.empty()) continue;
    if (is_fixed(cell)) {
      if (clearance_of(pieces, cell) < 0.02 * pieces.sizes[k]) trouble.push_back(cell.centre);
      continue;
    }
    if (k < pieces.first_cut && std::all_of(cell.nodes.begin(), cell.nodes.end(),
                                            [&](int node) { return pieces.holds[node] == Hold::nothing; })) {
      continue;  // untouched cell of the tree; its centre is set
    }
    const std::vector<Vec2> outline = outline_of(pieces, cell.nodes, false);
    if (outline.empty()) {
      trouble.push_back(pieces.nodes[cell.nodes.front()]);
      continue;
    }
    const Sight sight = best_sight(outline);
    cell.centre = sight.centre;
    if (outline.size() > cell.nodes.size() && !(sight.clearance > seen_beside_arc * pieces.sizes[k])) {
      const KernelCentre seeing = kernel_centre(outline, seen_beside_arc);
      if (!(seeing.visibility > seen_beside_arc)) trouble.push_back(pieces.nodes[cell.nodes.front()]);
      cell.centre = seeing.centre;
      continue;
    }
    // Sharp corners leave cells with little clearance, which no refinement changes.
    if (!(sight.clearance > 1e-5 * pieces.sizes[k])) trouble.push_back(pieces.nodes[cell.nodes.front()]);
  }
}

void find_lost_nodes(const Pieces& pieces, std::vector<Vec2>& trouble) {
  std::vector<char> has_cell(pieces.nodes.size(), 0);
  for (const PolygonCell& cell : pieces.cells) {
    for (int node : cell.nodes) has_cell[node] = 1;
  }
  for (const std::vector<int>& chain : pieces.chains) {
    for (int node : chain) {
      if (!has_cell[node]) trouble.push_back(pieces.nodes[node]);
    }
  }
}

}  // namespace scabo::mesh::quadtree
