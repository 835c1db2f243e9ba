#include "scabo/mesh/plane/quadtree/cut.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::mesh::quadtree {

namespace {

constexpr double touch = 1e-6;  // in parts of the size of a cell: points this close to a node, side or line are on it

struct HalfSide {
  int from, to;
  double size;     // of the leaf on its left; 0 inside a leaf
  int line = -1;   // on which it is
  int beside = 0;  // region on its left if it is on a line
  int next = -1;
};

class Cutter {
 public:
  Cutter(const Forest& forest, const std::vector<int>& leaves, const std::vector<std::vector<int>>& lists,
         const Curves& curves, const RegionFinder& regions, const std::vector<Patch>& patches,
         std::vector<Vec2>& trouble)
      : forest_(forest),
        leaves_(leaves),
        lists_(lists),
        curves_(curves),
        regions_(regions),
        patches_(patches),
        trouble_(trouble),
        numbers_(forest, leaves) {}

  Pieces run() {
    start();
    put_corners_on_nodes();
    put_nodes_on_lines();
    cut_sides();
    join_lines();
    trace();
    return std::move(pieces_);
  }

 private:
  struct Active {
    int leaf;
    int patch;
    double size;
    std::vector<int> polygon;
  };

  const std::vector<int>& list_of(const Active& active) const {
    static const std::vector<int> none;
    const int place = forest_.cells[active.leaf].lines;
    return place < 0 ? none : lists_[place];
  }

  int add_node(const Vec2& at, Hold hold, int line) {
    pieces_.nodes.push_back(at);
    pieces_.holds.push_back(hold);
    pieces_.line_of.push_back(line);
    return int(pieces_.nodes.size()) - 1;
  }

  /// Uncut leaves become cells at once; the others are collected.
  void start() {
    pieces_.nodes = numbers_.positions;
    pieces_.holds.assign(pieces_.nodes.size(), Hold::nothing);
    pieces_.line_of.assign(pieces_.nodes.size(), -1);
    pieces_.chains.resize(curves_.curves.size());
    sectors_.resize(patches_.size());
    corner_node_.assign(curves_.corners.size(), -1);
    along_.resize(curves_.curves.size());
    absent_.assign(pieces_.nodes.size(), 0);
    std::vector<int> polygon;
    for (int index : leaves_) {
      const TreeCell& leaf = forest_.cells[index];
      if (leaf.region == TreeCell::outside) continue;
      numbers_.polygon(leaf, polygon);
      int patch = -1;
      for (std::size_t k = 0; k < patches_.size() && patch < 0; ++k) {
        if (patches_[k].box.contains(forest_.middle(leaf))) patch = int(k);
      }
      const Vec2 size = forest_.size(leaf.level);
      if (leaf.region == TreeCell::cut || patch >= 0) {
        active_.push_back({index, patch, size.maxCoeff(), polygon});
      } else {
        pieces_.cells.push_back({polygon, forest_.middle(leaf), leaf.region, {}, false});
        pieces_.sizes.push_back(size.maxCoeff());
      }
    }
    pieces_.first_cut = pieces_.cells.size();
    // Sides between two leaves of one patch, and nodes that only such sides have, do not exist.
    std::unordered_map<std::uint64_t, int> count;
    for (const Active& active : active_) {
      if (active.patch >= 0) visit(active, [&](int a, int b) { ++count[side_key(a, b)]; });
    }
    for (const Active& active : active_) {
      if (active.patch < 0) continue;
      visit(active, [&](int a, int b) {
        if (count[side_key(a, b)] == 2) {
          inner_.emplace(side_key(a, b), true);
          if (absent_[a] == 0) absent_[a] = 1;
          if (absent_[b] == 0) absent_[b] = 1;
        } else {
          absent_[a] = absent_[b] = 2;
        }
      });
    }
    for (signed char& state : absent_) state = state == 1;
  }

  template <typename Visitor>
  void visit(const Active& active, Visitor&& visitor) const {
    const std::size_t n = active.polygon.size();
    for (std::size_t k = 0; k < n; ++k) visitor(active.polygon[k], active.polygon[k + 1 < n ? k + 1 : 0]);
  }

  void put_corners_on_nodes() {
    for (const Active& active : active_) {
      for (int line : list_of(active)) {
        for (int corner : {curves_.curves[line].first, curves_.curves[line].last}) {
          if (corner_node_[corner] >= 0) continue;
          for (int node : active.polygon) {
            if (absent_[node] || (pieces_.nodes[node] - curves_.corners[corner]).norm() > touch * active.size) continue;
            if (pieces_.holds[node] == Hold::corner) {
              trouble_.push_back(pieces_.nodes[node]);  // two corners at one node
              continue;
            }
            corner_node_[corner] = node;
            pieces_.nodes[node] = curves_.corners[corner];
            pieces_.holds[node] = Hold::corner;
          }
        }
      }
    }
    for (std::size_t k = 0; k < corner_node_.size(); ++k) {
      if (corner_node_[k] < 0) corner_node_[k] = add_node(curves_.corners[k], Hold::corner, -1);
    }
    for (std::size_t line = 0; line < along_.size(); ++line) {
      const Curve& curve = curves_.curves[line];
      along_[line].push_back({0.0, corner_node_[curve.first]});
      along_[line].push_back({1.0, corner_node_[curve.last]});
    }
  }

  void put_nodes_on_lines() {
    for (const Active& active : active_) {
      for (int line : list_of(active)) {
        const Curve& curve = curves_.curves[line];
        for (int node : active.polygon) {
          if (absent_[node] || pieces_.holds[node] != Hold::nothing) continue;
          const CurvePoint foot = curve.foot(pieces_.nodes[node]);
          if (foot.t <= 0.0 || foot.t >= 1.0) continue;
          if ((foot.point - pieces_.nodes[node]).norm() > touch * active.size) continue;
          pieces_.nodes[node] = foot.point;
          pieces_.holds[node] = Hold::line;
          pieces_.line_of[node] = line;
          along_[line].push_back({foot.t, node});
        }
      }
    }
  }

  bool on_line(int node, int line) const {
    const Curve& curve = curves_.curves[line];
    return pieces_.line_of[node] == line || corner_node_[curve.first] == node || corner_node_[curve.last] == node;
  }

  /// The nodes inside a side of the grid, from its end with the lower number.
  std::vector<int> nodes_inside(int a, int b, const std::vector<int>& lines) {
    if (a > b) std::swap(a, b);
    const Vec2 from = pieces_.nodes[a], to = pieces_.nodes[b];
    const double length = (to - from).norm();
    std::vector<std::pair<double, int>> inside;
    const auto position = [&](const Vec2& point) { return (point - from).dot(to - from) / (length * length); };
    for (int line : lines) {
      for (int corner : {curves_.curves[line].first, curves_.curves[line].last}) {
        const int node = corner_node_[corner];
        const Vec2& at = curves_.corners[corner];
        const double s = position(at);
        if (node == a || node == b || s <= 0.0 || s >= 1.0) continue;
        if (std::abs(cross(at - from, to - from)) > touch * length * length) continue;
        if (std::none_of(inside.begin(), inside.end(), [&](const auto& known) { return known.second == node; })) {
          inside.push_back({s, node});
        }
      }
    }
    for (int line : lines) {
      const Curve& curve = curves_.curves[line];
      const bool a_on = on_line(a, line), b_on = on_line(b, line);
      if (!curve.arc && (a_on || b_on)) continue;
      for (const CurvePoint& crossing : curve.crossings(from, to)) {
        const double near = touch * length;
        if ((crossing.point - curve.start).norm() <= near || (crossing.point - curve.end).norm() <= near) continue;
        if (a_on && (crossing.point - from).norm() <= 10.0 * near) continue;
        if (b_on && (crossing.point - to).norm() <= 10.0 * near) continue;
        const int node = add_node(crossing.point, Hold::line, line);
        inside.push_back({position(crossing.point), node});
        along_[line].push_back({crossing.t, node});
      }
    }
    std::sort(inside.begin(), inside.end());
    std::vector<int> nodes;
    for (const auto& [s, node] : inside) nodes.push_back(node);
    return nodes;
  }

  static std::uint64_t way(int from, int to) { return (std::uint64_t(from) << 32) | std::uint32_t(to); }

  void add_half(int from, int to, double size) {
    if (!half_at_.emplace(way(from, to), int(halves_.size())).second) {
      trouble_.push_back(pieces_.nodes[from]);
      return;
    }
    halves_.push_back({from, to, size});
  }

  void cut_sides() {
    std::unordered_map<std::uint64_t, std::vector<int>> known;
    for (const Active& active : active_) {
      const std::vector<int>& lines = list_of(active);
      visit(active, [&](int a, int b) {
        const std::uint64_t key = side_key(a, b);
        if (inner_.count(key)) return;
        auto found = known.find(key);
        if (found == known.end()) found = known.emplace(key, nodes_inside(a, b, lines)).first;
        const std::vector<int>& inside = found->second;
        int last = a;
        for (std::size_t k = 0; k < inside.size(); ++k) {
          const int node = inside[a < b ? k : inside.size() - 1 - k];
          add_half(last, node, active.size);
          last = node;
        }
        add_half(last, b, active.size);
      });
    }
  }

  void join_lines() {
    for (std::size_t line = 0; line < along_.size(); ++line) {
      auto& along = along_[line];
      std::stable_sort(along.begin() + 2, along.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      std::vector<int>& chain = pieces_.chains[line];
      chain.push_back(along[0].second);
      for (std::size_t k = 2; k < along.size(); ++k) chain.push_back(along[k].second);
      chain.push_back(along[1].second);
      const Curve& curve = curves_.curves[line];
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const int a = chain[k], b = chain[k + 1];
        if (a == b || !pieces_.line_sides.emplace(side_key(a, b), int(line)).second) {
          trouble_.push_back(pieces_.nodes[a]);  // a closed curve inside one cell, or two curves between the same nodes
          continue;
        }
        if (!half_at_.count(way(a, b)) && !half_at_.count(way(b, a))) {
          add_half(a, b, 0.0);
          add_half(b, a, 0.0);
        }
        for (const auto& [key, region] : {std::pair(way(a, b), curve.left), std::pair(way(b, a), curve.right)}) {
          if (const auto found = half_at_.find(key); found != half_at_.end()) {
            halves_[found->second].line = int(line);
            halves_[found->second].beside = region;
          }
        }
      }
    }
  }

  void link() {
    // Sides that leave a node, by their angle. Around a face the next side is the first one clockwise from the way
    // back.
    const auto angle = [&](int from, int to) {
      const Vec2 along = pieces_.nodes[to] - pieces_.nodes[from];
      return std::atan2(along.y(), along.x());
    };
    struct Leaving {
      int from;
      double angle;
      int half;
    };
    std::vector<Leaving> leaving;
    for (std::size_t k = 0; k < halves_.size(); ++k) {
      leaving.push_back({halves_[k].from, angle(halves_[k].from, halves_[k].to), int(k)});
    }
    std::sort(leaving.begin(), leaving.end(), [](const Leaving& a, const Leaving& b) {
      return a.from != b.from ? a.from < b.from : a.angle != b.angle ? a.angle < b.angle : a.half < b.half;
    });
    std::vector<int> first(pieces_.nodes.size() + 1, 0);
    for (const Leaving& one : leaving) ++first[one.from + 1];
    for (std::size_t k = 0; k + 1 < first.size(); ++k) first[k + 1] += first[k];
    for (HalfSide& half : halves_) {
      const int from = first[half.to], to = first[half.to + 1];
      if (from == to) continue;
      int place = from;
      const auto back = half_at_.find(way(half.to, half.from));
      if (back != half_at_.end()) {
        while (leaving[place].half != back->second) ++place;
      } else {
        const double way_back = angle(half.to, half.from);
        while (place < to && leaving[place].angle < way_back) ++place;
      }
      half.next = leaving[(place == from ? to : place) - 1].half;
    }
  }

  void trace() {
    link();
    std::vector<char> seen(halves_.size(), 0);
    std::vector<int> face;
    for (std::size_t start = 0; start < halves_.size(); ++start) {
      if (seen[start]) continue;
      face.clear();
      int at = int(start);
      while (at >= 0 && !seen[at]) {
        seen[at] = 1;
        face.push_back(at);
        at = halves_[at].next;
      }
      if (at != int(start)) {
        trouble_.push_back(pieces_.nodes[halves_[start].from]);
        continue;
      }
      make_cell(face);
    }
    join_sectors();
  }

  /// Joins the parts of a patch around its corner, which lines that end there divide, to one cell.
  void join_sectors() {
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      std::vector<Sector>& sectors = sectors_[p];
      const Vec2 centre = curves_.corners[patches_[p].corner];
      if (sectors.empty()) continue;
      const auto follows = [&](const Sector& next, const Sector& one) {
        return one.nodes.back() == next.nodes.front() && !one.crack_at_end;
      };
      std::size_t first = 0;
      for (std::size_t k = 0; k < sectors.size(); ++k) {
        if (std::none_of(sectors.begin(), sectors.end(), [&](const Sector& one) { return follows(sectors[k], one); }))
          first = k;
      }
      PolygonCell cell{sectors[first].nodes, centre, sectors[first].region, {}, true};
      cell.side_regions.assign(cell.nodes.size() - 1, cell.region);
      double size = sectors[first].size;
      std::size_t joined = 1;
      for (std::size_t last = first; joined <= sectors.size();) {
        const auto next = std::find_if(sectors.begin(), sectors.end(),
                                       [&](const Sector& one) { return follows(one, sectors[last]); });
        if (next == sectors.end()) break;
        last = std::size_t(next - sectors.begin());
        if (last == first) {
          cell.nodes.pop_back();
          cell.open = false;
          break;
        }
        cell.nodes.insert(cell.nodes.end(), next->nodes.begin() + 1, next->nodes.end());
        cell.side_regions.insert(cell.side_regions.end(), next->nodes.size() - 1, next->region);
        size = std::max(size, next->size);
        ++joined;
      }
      if (joined != sectors.size()) {
        trouble_.push_back(centre);
        continue;
      }
      if (cell.open && sectors.size() == 1) cell.side_regions.clear();
      const int node = corner_node_[patches_[p].corner];
      for (const Sector& sector : sectors) {
        for (int neighbour : {sector.nodes.front(), sector.nodes.back()})
          pieces_.line_sides.erase(side_key(node, neighbour));
      }
      for (std::size_t line = 0; line < pieces_.chains.size(); ++line) {
        const Curve& curve = curves_.curves[line];
        if (curve.first != patches_[p].corner && curve.last != patches_[p].corner) continue;
        std::vector<int>& chain = pieces_.chains[line];
        chain.erase(std::remove(chain.begin(), chain.end(), node), chain.end());
      }
      pieces_.cells.push_back(std::move(cell));
      pieces_.sizes.push_back(size);
    }
  }

  void make_cell(const std::vector<int>& face) {
    std::vector<int> nodes;
    std::vector<Vec2> places;
    double size = 0.0;
    int region = -2;
    bool consistent = true;
    for (int half : face) {
      nodes.push_back(halves_[half].from);
      places.push_back(pieces_.nodes[halves_[half].from]);
      size = std::max(size, halves_[half].size);
      if (halves_[half].line < 0) continue;
      if (region != -2 && region != halves_[half].beside) consistent = false;
      region = halves_[half].beside;
    }
    if (region == -1 && consistent) return;
    const double area = polygon_area(places);
    if (size == 0.0) {  // between lines alone
      for (std::size_t k = 0; k < places.size(); ++k) size = std::max(size, (places[k] - places[0]).norm());
    }
    if (!consistent || !(area > 1e-12 * size * size)) {
      trouble_.push_back(places.front());  // lines that meet, or a closed chain of lines inside a cell
      return;
    }
    if (region == -2) {
      Vec2 middle = Vec2::Zero();
      for (const Vec2& place : places) middle += place / double(places.size());
      region = regions_.at(middle, 0.2 * size);
      if (region < 0) return;
    }
    add_cell(std::move(nodes), region, size);
  }

  void add_cell(std::vector<int> nodes, int region, double size) {
    const int n = int(nodes.size());
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      const int centre = corner_node_[patches_[p].corner];
      const auto found = std::find(nodes.begin(), nodes.end(), centre);
      if (found == nodes.end()) continue;
      std::rotate(nodes.begin(), found, nodes.end());
      if (std::count(nodes.begin(), nodes.end(), centre) != 1 || n < 3 ||
          !pieces_.line_sides.count(side_key(centre, nodes[1])) ||
          !pieces_.line_sides.count(side_key(centre, nodes.back()))) {
        trouble_.push_back(pieces_.nodes[centre]);
        return;
      }
      const bool crack_at_end = curves_.curves[pieces_.line_sides.at(side_key(centre, nodes.back()))].crack;
      nodes.erase(nodes.begin());
      sectors_[p].push_back({std::move(nodes), region, size, crack_at_end});
      return;
    }
    for (int k = 0; k < n; ++k) {
      if (n < 3 || nodes[(k + 1) % n] != nodes[(k + n - 1) % n]) continue;
      // A tip inside the cell: the division that begins there.
      const Halves halves = best_division(nodes, pieces_.nodes, k);
      if (halves.first.empty()) {
        trouble_.push_back(pieces_.nodes[nodes[k]]);
        return;
      }
      add_cell(halves.first, region, size);
      add_cell(halves.second, region, size);
      return;
    }
    pieces_.cells.push_back({std::move(nodes), Vec2::Zero(), region, {}, false});
    pieces_.sizes.push_back(size);
  }

  /// Part of a patch between two lines that end at its corner, or all around the tip of a crack.
  struct Sector {
    std::vector<int> nodes;  // counter-clockwise, without the corner
    int region;
    double size;
    bool crack_at_end;  // the line from the last node to the corner is a crack
  };

  const Forest& forest_;
  const std::vector<int>& leaves_;
  const std::vector<std::vector<int>>& lists_;
  const Curves& curves_;
  const RegionFinder& regions_;
  const std::vector<Patch>& patches_;
  std::vector<Vec2>& trouble_;
  ForestNodes numbers_;
  Pieces pieces_;
  std::vector<Active> active_;
  std::vector<signed char> absent_;
  std::unordered_map<std::uint64_t, bool> inner_;  // sides inside a patch
  std::vector<int> corner_node_;
  std::vector<std::vector<std::pair<double, int>>> along_;  // position and node, the two ends first
  std::vector<HalfSide> halves_;
  std::vector<std::vector<Sector>> sectors_;  // for each patch
  std::unordered_map<std::uint64_t, int> half_at_;
};

}  // namespace

Pieces cut_leaves(const Forest& forest, const std::vector<int>& leaves, const std::vector<std::vector<int>>& lists,
                  const Curves& curves, const RegionFinder& regions, const std::vector<Patch>& patches,
                  std::vector<Vec2>& trouble) {
  return Cutter(forest, leaves, lists, curves, regions, patches, trouble).run();
}

}  // namespace scabo::mesh::quadtree
