// The end of a mesh of a quadtree: both sides of cracks have nodes of their own, and no node is unused.
#include <algorithm>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "scabo/mesh/plane/quadtree/pieces.hpp"

namespace scabo::mesh::quadtree {

namespace {

/// Gives every fan of cells around a node of a crack a node of its own.
void separate_cracks(Pieces& pieces, const std::vector<DomainLine>& lines) {
  std::vector<int> place(pieces.nodes.size(), -1);
  std::vector<int> cracked;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (!lines[line].crack) continue;
    for (int node : pieces.chains[line]) {
      if (place[node] >= 0) continue;
      place[node] = int(cracked.size());
      cracked.push_back(node);
    }
  }
  if (cracked.empty()) return;
  struct Visit {
    int cell, corner;
    int before, after;  // neighbours in the cell, -1 at a side face
    int fan;
  };
  std::vector<std::vector<Visit>> visits(cracked.size());
  for (std::size_t k = 0; k < pieces.cells.size(); ++k) {
    const PolygonCell& cell = pieces.cells[k];
    const int n = int(cell.nodes.size());
    for (int i = 0; i < n; ++i) {
      if (place[cell.nodes[i]] < 0) continue;
      const int before = i > 0 ? cell.nodes[i - 1] : cell.open ? -1 : cell.nodes[n - 1];
      const int after = i + 1 < n ? cell.nodes[i + 1] : cell.open ? -1 : cell.nodes[0];
      visits[place[cell.nodes[i]]].push_back({int(k), i, before, after, int(visits[place[cell.nodes[i]]].size())});
    }
  }
  for (std::size_t c = 0; c < cracked.size(); ++c) {
    std::vector<Visit>& here = visits[c];
    const auto joined = [&](int neighbour) {
      if (neighbour < 0) return false;
      const auto side = pieces.line_sides.find(side_key(cracked[c], neighbour));
      return side == pieces.line_sides.end() || !lines[side->second].crack;
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (Visit& one : here) {
        for (Visit& other : here) {
          if (one.after < 0 || one.after != other.before || !joined(one.after) || one.fan == other.fan) continue;
          one.fan = other.fan = std::min(one.fan, other.fan);
          changed = true;
        }
      }
    }
    std::vector<std::pair<int, int>> copies{{here.empty() ? 0 : here.front().fan, cracked[c]}};  // fan and its node
    for (const Visit& visit : here) {
      auto known =
          std::find_if(copies.begin(), copies.end(), [&](const auto& copy) { return copy.first == visit.fan; });
      if (known == copies.end()) {
        copies.push_back({visit.fan, int(pieces.nodes.size())});
        known = copies.end() - 1;
        const Vec2 at = pieces.nodes[cracked[c]];
        pieces.nodes.push_back(at);
      }
      pieces.cells[visit.cell].nodes[visit.corner] = known->second;
    }
  }
}

/// Sides of cells on lines, from one node to the next around their cell, each with its cell and its place there.
class SidesOnLines {
 public:
  struct Side {
    int cell, place;
  };

  explicit SidesOnLines(const Pieces& pieces) {
    for (std::size_t k = 0; k < pieces.cells.size(); ++k) {
      const PolygonCell& cell = pieces.cells[k];
      const bool may = k >= pieces.first_cut || std::any_of(cell.nodes.begin(), cell.nodes.end(), [&](int node) {
                         return pieces.holds[node] != Hold::nothing;
                       });
      for (std::size_t i = 0; may && i + (cell.open ? 1 : 0) < cell.nodes.size(); ++i) {
        const int a = cell.nodes[i], b = cell.nodes[i + 1 < cell.nodes.size() ? i + 1 : 0];
        if (pieces.line_sides.count(side_key(a, b))) sides_[key(a, b)] = {int(k), int(i)};
      }
    }
  }

  /// Null if no cell has the side.
  const Side* find(int from, int to) const {
    const auto found = sides_.find(key(from, to));
    return found == sides_.end() ? nullptr : &found->second;
  }

 private:
  static std::uint64_t key(int from, int to) { return (std::uint64_t(from) << 32) | std::uint32_t(to); }
  std::unordered_map<std::uint64_t, Side> sides_;
};

/// The nodes of the cells on both sides of a line, of which `sides` knows the numbers before cracks were separated.
void take_nodes_of_cells(const Pieces& pieces, const SidesOnLines& sides, bool crack, std::vector<int>& left,
                         std::vector<int>& right) {
  const auto ends = [&](const SidesOnLines::Side& side) {
    const std::vector<int>& nodes = pieces.cells[side.cell].nodes;
    const std::size_t next = std::size_t(side.place) + 1;
    return std::pair(nodes[side.place], nodes[next < nodes.size() ? next : 0]);
  };
  const std::vector<int> chain = left;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const SidesOnLines::Side *on_left = sides.find(chain[i], chain[i + 1]),
                             *on_right = sides.find(chain[i + 1], chain[i]);
    if (on_left) std::tie(left[i], left[i + 1]) = ends(*on_left);
    if (on_right) std::tie(right[i + 1], right[i]) = ends(*on_right);
    // Both sides of other lines are one; they may begin or end at the mouth of a crack.
    if (crack) continue;
    auto &from = on_left ? left : right, &to = on_left ? right : left;
    std::copy_n(from.begin() + std::ptrdiff_t(i), 2, to.begin() + std::ptrdiff_t(i));
  }
}

/// Numbers the nodes anew, without those that no cell has.
void leave_out_unused_nodes(PolygonMesh& mesh) {
  std::vector<int> number(mesh.nodes.size(), -1);
  for (const PolygonCell& cell : mesh.cells) {
    for (int node : cell.nodes) number[node] = 0;
  }
  std::vector<Vec2> nodes;
  nodes.reserve(mesh.nodes.size());
  for (std::size_t k = 0; k < number.size(); ++k) {
    if (number[k] < 0) continue;
    number[k] = int(nodes.size());
    nodes.push_back(mesh.nodes[k]);
  }
  mesh.nodes = std::move(nodes);
  for (PolygonCell& cell : mesh.cells) {
    for (int& node : cell.nodes) node = number[node];
  }
  for (std::vector<std::vector<int>>* chains : {&mesh.left, &mesh.right}) {
    for (std::vector<int>& chain : *chains) {
      for (int& node : chain) node = number[node];
    }
  }
}

}  // namespace

PolygonMesh finished(Pieces&& pieces, const std::vector<DomainLine>& lines) {
  const SidesOnLines sides(pieces);
  separate_cracks(pieces, lines);
  PolygonMesh mesh;
  mesh.left = pieces.chains;
  mesh.right = mesh.left;
  for (std::size_t line = 0; line < lines.size(); ++line)
    take_nodes_of_cells(pieces, sides, lines[line].crack, mesh.left[line], mesh.right[line]);
  mesh.nodes = std::move(pieces.nodes);
  mesh.cells = std::move(pieces.cells);
  std::erase_if(mesh.cells, [](const PolygonCell& cell) { return cell.nodes.empty(); });
  leave_out_unused_nodes(mesh);
  return mesh;
}

}  // namespace scabo::mesh::quadtree
