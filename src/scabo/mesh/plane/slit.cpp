#include "scabo/mesh/plane/slit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/replace_elements.hpp"

namespace scabo::mesh {

namespace {

/// Distance from the path of a crack, relative to the size of the body, of nodes that lie on it.
constexpr double on_path = 1e-7;
/// Largest angle under which a side of a tip's cell is seen from the tip.
constexpr double largest_angle_from_tip = std::numbers::pi / 8;
/// Rows of cells that are tried besides, where some cannot be joined.
constexpr int extra_layers = 2;
/// Least height over length of the triangle from the tip over a part of a side, where there is a choice.
constexpr double seen_from_tip = 0.2;

/// A side of a cell.
struct CellSide {
  int cell = -1, element = -1;
};

/// The sides of the cells on both sides of a crack, in the direction of its path.
struct CrackSides {
  std::vector<CellSide> left, right;
};

std::uint64_t directed_key(int from, int to) {
  return (static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint32_t>(to);
}
std::uint64_t key_of_ends(const LineElement& element) {
  return directed_key(element.nodes.front(), element.nodes.back());
}
std::uint64_t reverse_key(const LineElement& element) {
  return directed_key(element.nodes.back(), element.nodes.front());
}

/// Positions along a path, in its length.
class PathPositions {
 public:
  PathPositions(const std::vector<Vec2>& path, double tolerance) : path_(path), tolerance_(tolerance) {
    for (std::size_t k = 0; k < path.size(); ++k) {
      box_.add(path[k]);
      ends_.push_back(k == 0 ? 0.0 : ends_.back() + (path[k] - path[k - 1]).norm());
    }
  }
  double length() const { return ends_.back(); }

  /// Positions of a point; more than one where the path crosses itself.
  std::vector<double> of(const Vec2& x) const {
    std::vector<double> found;
    if (((x - box_.low).array() < -tolerance_).any() || ((x - box_.high).array() > tolerance_).any()) return found;
    for (std::size_t k = 0; k + 1 < path_.size(); ++k) {
      const Vec2 along = path_[k + 1] - path_[k];
      const double t = std::clamp((x - path_[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      if ((path_[k] + t * along - x).norm() > tolerance_) continue;
      const double at = ends_[k] + t * along.norm();
      if (found.empty() || at > found.back() + 2.0 * tolerance_) found.push_back(at);
    }
    return found;
  }

  Vec2 at(double position) const {
    std::size_t k = 0;
    while (k + 2 < path_.size() && ends_[k + 1] < position) ++k;
    const double t = (position - ends_[k]) / (ends_[k + 1] - ends_[k]);
    return path_[k] + t * (path_[k + 1] - path_[k]);
  }

 private:
  const std::vector<Vec2>& path_;
  double tolerance_;
  geometry::Box box_;
  std::vector<double> ends_;
};

class Slitter {
 public:
  Slitter(BodyMesh mesh, const model::Body& body, const SlitOptions& options)
      : mesh_(std::move(mesh)),
        body_(body),
        options_(options),
        tolerance_(on_path * geometry::outline_size(body.outline)) {}

  std::variant<BodyMesh, Diagnostic> run() {
    for (const model::Crack& crack : body_.cracks)
      if (auto wrong = find(crack)) return Diagnostic{crack.source, *wrong};
    const auto edges = owners_of_edges();
    double_nodes();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (std::size_t k = 0; k < edges[e].size(); ++k)
        if (edges[e][k].cell >= 0) mesh_.edges[e][k] = element(edges[e][k]);
      if (!mesh_.edges[e].empty()) mesh_.corners[e] = mesh_.edges[e].front().nodes.front();
    }
    index_sides();
    find_tips();
    for (const Tip& tip : tips_)
      if (auto wrong = join_around(tip)) return Diagnostic{body_.cracks[tip.crack].source, *wrong};
    make_faces();
    drop_joined_cells();
    divide_wide_sides();
    return renumbered(mesh_);
  }

 private:
  struct Tip {
    std::size_t crack = 0;
    bool at_end = false;
    int node = -1;
    Vec2 position = Vec2::Zero();
  };

  const LineElement& element(const CellSide& side) const {
    return mesh_.cells[static_cast<std::size_t>(side.cell)].boundary[static_cast<std::size_t>(side.element)];
  }
  const Vec2& at(int node) const { return mesh_.nodes[static_cast<std::size_t>(node)]; }

  /// The sides along a crack; or why there are none.
  std::optional<std::string> find(const model::Crack& crack) {
    const PathPositions path(crack.path, tolerance_);
    std::unordered_map<int, std::vector<double>> positions;
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n)
      if (auto found = path.of(mesh_.nodes[n]); !found.empty())
        positions.emplace(static_cast<int>(n), std::move(found));
    struct Piece {
      double from = 0.0, to = 0.0;
      CellSide side;
    };
    std::vector<Piece> left, right;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (std::size_t i = 0; i < mesh_.cells[c].boundary.size(); ++i) {
        const std::vector<int>& nodes = mesh_.cells[c].boundary[i].nodes;
        const auto start = positions.find(nodes.front()), end = positions.find(nodes.back());
        if (start == positions.end() || end == positions.end()) continue;
        const Vec2 middle = 0.5 * (at(nodes.front()) + at(nodes.back()));
        for (const double from : start->second)
          for (const double to : end->second) {
            const double between = 0.5 * (from + to);
            if ((path.at(between) - middle).norm() > 2.0 * tolerance_) continue;
            const CellSide side{static_cast<int>(c), static_cast<int>(i)};
            if (to > from)
              left.push_back({from, to, side});
            else
              right.push_back({to, from, side});
          }
      }
    CrackSides sides;
    for (auto* pieces : {&left, &right}) {
      std::sort(pieces->begin(), pieces->end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
      double reached = 0.0;
      for (const Piece& piece : *pieces) {
        if (piece.from > reached + 2.0 * tolerance_) break;
        if (piece.from < reached - 2.0 * tolerance_) continue;
        reached = piece.to;
        (pieces == &left ? sides.left : sides.right).push_back(piece.side);
      }
      if (reached < path.length() - 2.0 * tolerance_) {
        const Vec2 x = path.at(reached);
        return fmt::format(
            "no side of a cell runs along crack '{}' from ({:.6g}, {:.6g}) on: a crack follows the sides of the cells "
            "of its mesh and ends at their corners",
            crack.name, x.x(), x.y());
      }
    }
    if (sides.left.size() != sides.right.size())
      return fmt::format("the two sides of crack '{}' have different cells along it: divide them alike", crack.name);
    sides_.push_back(std::move(sides));
    return std::nullopt;
  }

  void index_sides() {
    side_at_.clear();
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (std::size_t i = 0; i < mesh_.cells[c].boundary.size(); ++i)
        side_at_[key_of_ends(mesh_.cells[c].boundary[i])] = {static_cast<int>(c), static_cast<int>(i)};
  }

  /// For each element of each edge the side of a cell that it is.
  std::vector<std::vector<CellSide>> owners_of_edges() {
    index_sides();
    std::vector<std::vector<CellSide>> owners(mesh_.edges.size());
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      for (const LineElement& of_edge : mesh_.edges[e]) {
        const auto found = side_at_.find(key_of_ends(of_edge));
        owners[e].push_back(found == side_at_.end() ? CellSide{} : found->second);
      }
    return owners;
  }

  int copy_of(int node) {
    const Vec2 x = at(node);
    mesh_.nodes.push_back(x);
    return static_cast<int>(mesh_.nodes.size()) - 1;
  }

  void double_nodes() {
    std::unordered_set<std::uint64_t> cut;  // sides of cells, in both directions
    std::set<int> ends;
    for (const CrackSides& crack : sides_)
      for (const CellSide& side : crack.left) {
        cut.insert(key_of_ends(element(side)));
        cut.insert(reverse_key(element(side)));
        ends.insert(element(side).nodes.front());
        ends.insert(element(side).nodes.back());
      }
    std::unordered_map<int, std::vector<int>> cells_at;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (const LineElement& of_cell : mesh_.cells[c].boundary)
        if (ends.contains(of_cell.nodes.front())) cells_at[of_cell.nodes.front()].push_back(static_cast<int>(c));
    // Nodes between the ends of a side have one cell on either side.
    for (const CrackSides& crack : sides_)
      for (const CellSide& side : crack.left) {
        const auto other = side_at_.find(reverse_key(element(side)));
        if (other == side_at_.end()) continue;  // slit already
        std::vector<int>& nodes = mesh_.cells[static_cast<std::size_t>(other->second.cell)]
                                      .boundary[static_cast<std::size_t>(other->second.element)]
                                      .nodes;
        for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i] = copy_of(nodes[i]);
      }
    for (const int node : ends) {
      const std::vector<int>& cells = cells_at[node];
      DisjointSets groups(cells.size());
      std::unordered_map<std::uint64_t, std::size_t> with_side;
      for (std::size_t i = 0; i < cells.size(); ++i)
        for (const LineElement& of_cell : mesh_.cells[static_cast<std::size_t>(cells[i])].boundary) {
          if (of_cell.nodes.front() != node && of_cell.nodes.back() != node) continue;
          if (cut.contains(key_of_ends(of_cell))) continue;
          const auto [low, high] = std::minmax(of_cell.nodes.front(), of_cell.nodes.back());
          const auto [other, is_new] = with_side.emplace(directed_key(low, high), i);
          if (!is_new) groups.join(i, other->second);
        }
      renamed_.clear();
      std::unordered_map<std::size_t, int> number;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto [of_group, is_new] = number.emplace(groups.root(i), node);
        if (is_new && number.size() > 1) of_group->second = copy_of(node);
        if (of_group->second != node) renamed_.emplace_back(cells[i], of_group->second);
      }
      for (const auto& [cell, copy] : renamed_)
        for (LineElement& of_cell : mesh_.cells[static_cast<std::size_t>(cell)].boundary)
          for (int& of_element : of_cell.nodes)
            if (of_element == node) of_element = copy;
      // Keys of sides at this node are those of the file still: cells of one group keep common sides, so that a side
      // that is looked up by another node later has to be found by its new name.
      for (const auto& [cell, copy] : renamed_)
        for (const LineElement& of_cell : mesh_.cells[static_cast<std::size_t>(cell)].boundary) {
          const int front = of_cell.nodes.front(), back = of_cell.nodes.back();
          if (front != copy && back != copy) continue;
          const std::uint64_t before = directed_key(front == copy ? node : front, back == copy ? node : back);
          if (cut.contains(before)) cut.insert(key_of_ends(of_cell)), cut.insert(reverse_key(of_cell));
        }
    }
  }

  void find_tips() {
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const model::Crack& crack = body_.cracks[k];
      const int left_start = element(sides_[k].left.front()).nodes.front(),
                right_start = element(sides_[k].right.front()).nodes.back();
      const int left_end = element(sides_[k].left.back()).nodes.back(),
                right_end = element(sides_[k].right.back()).nodes.front();
      if (left_start == right_start) tips_.push_back({k, false, left_start, crack.path.front()});
      if (left_end == right_end) tips_.push_back({k, true, left_end, crack.path.back()});
    }
    for (const Tip& tip : tips_) tip_nodes_.insert(tip.node);
    for (const CrackSides& crack : sides_)
      for (const auto* face : {&crack.left, &crack.right})
        for (const CellSide& side : *face) on_cracks_.insert(key_of_ends(element(side)));
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (const LineElement& of_cell : mesh_.cells[c].boundary)
        cells_at_[of_cell.nodes.front()].push_back(static_cast<int>(c));
  }

  /// The boundary of the cells `inside` around a tip, from one side face to the other; empty if they cannot be joined.
  std::vector<CellSide> boundary_of(const std::set<int>& inside, const Tip& tip, bool first_layer) const {
    std::unordered_map<int, CellSide> from;  // boundary sides by their first node
    std::size_t count = 0;
    for (const int c : inside) {
      if (joined_.contains(c)) return {};
      const Cell& cell = mesh_.cells[static_cast<std::size_t>(c)];
      for (std::size_t i = 0; i < cell.boundary.size(); ++i) {
        const int start = cell.boundary[i].nodes.front();
        if (start != tip.node && tip_nodes_.contains(start)) return {};
        const auto other = side_at_.find(reverse_key(cell.boundary[i]));
        if (other != side_at_.end() && inside.contains(other->second.cell)) continue;
        if (!from.emplace(start, CellSide{c, static_cast<int>(i)}).second) return {};  // it touches itself
        ++count;
      }
    }
    std::vector<CellSide> chain;
    for (auto next = from.find(tip.node); next != from.end() && chain.size() < count;
         next = from.find(element(chain.back()).nodes.back()))
      chain.push_back(next->second);
    if (chain.size() != count || count < 3 || element(chain.back()).nodes.back() != tip.node) return {};
    // The crack within becomes side faces, which are straight.
    const auto on_ray = [&](const CellSide& side, const CellSide& at_tip) {
      const LineElement &far = element(side), &near = element(at_tip);
      if (!on_cracks_.contains(key_of_ends(far))) return false;
      const int other = near.nodes.front() == tip.node ? near.nodes.back() : near.nodes.front();
      const Vec2 ray = (at(other) - at(tip.node)).normalized();
      return std::all_of(far.nodes.begin(), far.nodes.end(),
                         [&](int node) { return std::abs(cross(ray, Vec2(at(node) - at(tip.node)))) < tolerance_; });
    };
    std::size_t first = 1, last = chain.size() - 1;
    while (first < last && on_ray(chain[first], chain.front())) ++first;
    while (last > first && on_ray(chain[last - 1], chain.back())) --last;
    if (last <= first || first != chain.size() - last) return {};
    if ((at(element(chain[first]).nodes.front()) - at(element(chain[last - 1]).nodes.back())).norm() > tolerance_)
      return {};
    // Except for the first row, a side on a crack, or one of another material, ends the joining.
    const int material = material_of(chain[first]);
    const double least = first_layer ? 1e-6 : seen_from_tip;
    for (std::size_t i = first; i < last; ++i) {
      if (!first_layer && material_of(chain[i]) != material) return {};
      const std::vector<int>& nodes = element(chain[i]).nodes;
      for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const Vec2 a = at(nodes[k]) - at(tip.node), b = at(nodes[k + 1]) - at(tip.node);
        if (!(cross(a, b) > least * (b - a).squaredNorm())) return {};
      }
    }
    return {chain.begin() + static_cast<std::ptrdiff_t>(first), chain.begin() + static_cast<std::ptrdiff_t>(last)};
  }

  int material_of(const CellSide& side) const {
    const std::vector<int>& materials = mesh_.cells[static_cast<std::size_t>(side.cell)].materials;
    return materials.size() > 1 ? materials[static_cast<std::size_t>(side.element)] : materials.front();
  }

  std::optional<std::string> join_around(const Tip& tip) {
    const std::vector<int>& at_tip = cells_at_[tip.node];
    std::set<int> wider(at_tip.begin(), at_tip.end()), inside;
    std::vector<CellSide> chain;
    int joined_layers = 0;
    // Where cells of different sizes meet, fewer rows than one more may do, and a row more than is wanted.
    for (int layer = 0; layer < options_.layers + extra_layers && joined_layers < options_.layers; ++layer) {
      std::vector<CellSide> around = boundary_of(wider, tip, joined_layers == 0);
      if (!around.empty()) {
        inside = wider;
        chain = std::move(around);
        ++joined_layers;
      }
      std::set<int> next = wider;
      for (const int cell : wider)
        for (const LineElement& of_cell : mesh_.cells[static_cast<std::size_t>(cell)].boundary)
          for (const int beside : cells_at_[of_cell.nodes.front()]) next.insert(beside);
      wider = std::move(next);
    }
    if (chain.empty())
      return fmt::format(
          "the cells around the tip ({:.6g}, {:.6g}) of crack '{}' cannot be joined to one: use a finer mesh there, so "
          "that two rows of cells lie between it and other tips and borders of materials",
          tip.position.x(), tip.position.y(), body_.cracks[tip.crack].name);
    Cell cell;
    cell.kind = CellKind::superelement;
    cell.centre = tip.position;
    for (const CellSide& side : chain) {
      cell.boundary.push_back(element(side));
      around_tips_.insert(key_of_ends(element(side)));
      cell.materials.push_back(material_of(side));
    }
    if (std::all_of(cell.materials.begin(), cell.materials.end(), [&](int m) { return m == cell.materials.front(); }))
      cell.materials.resize(1);
    made_.push_back(std::move(cell));
    joined_.insert(inside.begin(), inside.end());
    return std::nullopt;
  }

  bool is_kept(const CellSide& side) const {
    return !joined_.contains(side.cell) || around_tips_.contains(key_of_ends(element(side)));
  }

  void make_faces() {
    mesh_.faces.clear();
    for (const CrackSides& crack : sides_) {
      std::vector<LineElement> left, right;
      for (const CellSide& side : crack.left)
        if (is_kept(side)) left.push_back(element(side));
      for (auto side = crack.right.rbegin(); side != crack.right.rend(); ++side)
        if (is_kept(*side)) right.push_back(element(*side));
      mesh_.faces.push_back(std::move(right));
      mesh_.faces.push_back(std::move(left));
    }
    for (std::vector<LineElement>& edge : mesh_.edges)
      std::erase_if(edge, [&](const LineElement& of_edge) {
        const auto side = side_at_.find(key_of_ends(of_edge));
        return side != side_at_.end() && !is_kept(side->second);
      });
  }

  void drop_joined_cells() {
    std::vector<Cell> cells;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      if (!joined_.contains(static_cast<int>(c))) cells.push_back(std::move(mesh_.cells[c]));
    cells.insert(cells.end(), made_.begin(), made_.end());
    mesh_.cells = std::move(cells);
  }

  void divide_wide_sides() {
    Replacements replacements;
    for (const Cell& cell : made_)
      for (const LineElement& wide : cell.boundary) {
        const Vec2 a = at(wide.nodes.front()) - cell.centre, b = at(wide.nodes.back()) - cell.centre;
        const double angle = std::abs(std::atan2(cross(a, b), a.dot(b)));
        const int parts = static_cast<int>(std::ceil(angle / largest_angle_from_tip - 1e-6));
        if (parts > 1 && !replacements.contains({wide.nodes.rbegin(), wide.nodes.rend()}))
          replacements[wide.nodes] = divided(wide, parts);
      }
    if (!replacements.empty()) replace_elements(mesh_, replacements);
  }

  /// An element as equal parts of its parameter, with new nodes on the same curve.
  std::vector<LineElement> divided(const LineElement& whole, int parts) {
    const int order = static_cast<int>(whole.nodes.size()) - 1;
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
    Matrix points(2, order + 1);
    for (int i = 0; i <= order; ++i) points.col(i) = at(whole.nodes[static_cast<std::size_t>(i)]);
    std::vector<LineElement> made;
    int before = whole.nodes.front();
    for (int part = 0; part < parts; ++part) {
      LineElement& element_made = made.emplace_back();
      element_made.nodes.push_back(before);
      for (int i = 1; i <= order; ++i) {
        if (part + 1 == parts && i == order) {
          element_made.nodes.push_back(whole.nodes.back());
          break;
        }
        const double eta =
            -1.0 + (2.0 * part + 1.0 + basis.points()[static_cast<std::size_t>(i)]) / static_cast<double>(parts);
        mesh_.nodes.push_back(points * basis.values(eta));
        element_made.nodes.push_back(static_cast<int>(mesh_.nodes.size()) - 1);
      }
      before = element_made.nodes.back();
    }
    return made;
  }

  BodyMesh mesh_;
  const model::Body& body_;
  SlitOptions options_;
  double tolerance_;
  std::vector<CrackSides> sides_;                        // of each crack
  std::unordered_map<std::uint64_t, CellSide> side_at_;  // by its ends, in the direction of its cell
  std::vector<std::pair<int, int>> renamed_;             // cell, and what a node is called there
  std::unordered_map<int, std::vector<int>> cells_at_;   // by end nodes of their sides
  std::unordered_set<std::uint64_t> on_cracks_;          // sides of cells
  std::vector<Tip> tips_;
  std::unordered_set<int> tip_nodes_;
  std::vector<Cell> made_;                         // around tips
  std::unordered_set<std::uint64_t> around_tips_;  // their sides
  std::unordered_set<int> joined_;                 // cells that became part of them
};

}  // namespace

std::variant<BodyMesh, Diagnostic> slit(BodyMesh mesh, const model::Body& body, const SlitOptions& options) {
  return Slitter(std::move(mesh), body, options).run();
}

}  // namespace scabo::mesh
