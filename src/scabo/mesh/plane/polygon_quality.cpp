#include "scabo/mesh/plane/polygon_quality.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>

#include "scabo/mesh/plane/polygon_kernel.hpp"
#include "scabo/mesh/plane/refusal.hpp"

namespace scabo::mesh {
namespace {

constexpr double short_side = 0.1;       // per local size: sides inside that are shorter are collapsed
constexpr double well_visible = 0.1;     // h / L (polygon_kernel.hpp): cells below are improved by moving their corners
constexpr double hardly_visible = 0.02;  // cells that remain below are divided, if that helps
constexpr int unnumbered = -1;

class Improvement {
 public:
  explicit Improvement(DualCells cells) : cells_(std::move(cells)), mesh_(cells_.mesh), triangles_(cells_.triangles) {}

  PolygonMesh finish() {
    collapse_short_sides();
    place_centres();
    improve();
    divide_cells();
    check();
    return renumbered();
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool is_free(int node) const { return at(node) < triangles_.size(); }
  bool inside(int triangle) const { return triangle >= 0 && cells_.region[at(triangle)] >= 0; }

  void points_of(const PolygonCell& cell, std::vector<Vec2>& points) const {
    points.clear();
    for (const int node : cell.nodes) points.push_back(mesh_.nodes[at(node)]);
  }

  // How well a cell is seen from its centre, or from the best one.
  KernelCentre centre_of(int number) {
    const PolygonCell& cell = mesh_.cells[at(number)];
    points_of(cell, points_);
    if (cells_.fixed_centre[at(number)]) return {cell.centre, visibility(points_, cell.centre, cell.open)};
    return kernel_centre(points_);
  }

  // The cells that have a free node.
  std::vector<int> cells_at(int node) const {
    std::vector<int> cells;
    for (int t = node; t >= 0; t = t == node ? partner(node) : -1)
      for (std::size_t i = 0; i < 3; ++i)
        if (const int cell = cells_.cell_of[3 * at(t) + i];
            cell >= 0 && std::find(cells.begin(), cells.end(), cell) == cells.end())
          cells.push_back(cell);
    for (const int t : {node, partner(node)})
      if (const auto found = cells_.second_cell.find(t); found != cells_.second_cell.end())
        cells.insert(cells.end(), found->second.begin(), found->second.end());
    return cells;
  }

  int partner(int node) const {
    const auto found = partner_.find(node);
    return found == partner_.end() ? -1 : found->second;
  }

  // Two centroids that are close to each other become one node between them.
  void collapse_short_sides() {
    for (int t = 0; is_free(t); ++t) {
      if (!inside(t)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const int u = triangles_[at(t)].neighbours[i];
        if (u < t || !inside(u) || triangles_[at(t)].constrained[i]) continue;
        const double size = std::min(cells_.spacing[at(t)], cells_.spacing[at(u)]);
        if ((mesh_.nodes[at(t)] - mesh_.nodes[at(u)]).squaredNorm() >= short_side * short_side * size * size) continue;
        if (merged_.count(t) + merged_.count(u) == 0) collapse(t, u);
      }
    }
  }

  void collapse(int t, int u) {
    std::vector<int> cells = cells_at(t);
    for (const int cell : cells_at(u))
      if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
    double before = 1.0, after = 1.0;
    std::vector<PolygonCell> old;
    for (const int cell : cells) {
      before = std::min(before, centre_of(cell).visibility);
      old.push_back(mesh_.cells[at(cell)]);
    }
    const Vec2 place = mesh_.nodes[at(t)];
    mesh_.nodes[at(t)] = 0.5 * (place + mesh_.nodes[at(u)]);
    for (const int number : cells) {
      PolygonCell& cell = mesh_.cells[at(number)];
      const auto has_t = std::find(cell.nodes.begin(), cell.nodes.end(), t);
      const auto has_u = std::find(cell.nodes.begin(), cell.nodes.end(), u);
      if (has_u != cell.nodes.end()) {
        if (has_t == cell.nodes.end())
          *has_u = t;
        else
          remove_node(cell, has_u - cell.nodes.begin());
      }
      after = std::min(after, cell.nodes.size() < 3 ? -1.0 : centre_of(number).visibility);
    }
    if (after >= std::min(before, well_visible) && after > 0.0) {
      merged_.insert({t, u});
      merged_.insert({u, t});
      partner_[t] = u;
      return;
    }
    mesh_.nodes[at(t)] = place;
    for (std::size_t k = 0; k < cells.size(); ++k) mesh_.cells[at(cells[k])] = old[k];
  }

  // The side that ends at the node, or starts there, vanishes; both lie in one region, for the short side does.
  static void remove_node(PolygonCell& cell, std::ptrdiff_t k) {
    cell.nodes.erase(cell.nodes.begin() + k);
    if (!cell.side_regions.empty())
      cell.side_regions.erase(cell.side_regions.begin() +
                              std::min<std::ptrdiff_t>(k, static_cast<std::ptrdiff_t>(cell.side_regions.size()) - 1));
  }

  void place_centres() {
    visibility_.resize(mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const KernelCentre centre = centre_of(static_cast<int>(c));
      mesh_.cells[c].centre = centre.centre;
      visibility_[c] = centre.visibility;
    }
  }

  // Moves the free nodes of cells that are hard to see to where the cells around them are seen better.
  void improve() {
    for (int round = 0; round < 3; ++round) {
      bool changed = false;
      for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
        if (visibility_[c] >= well_visible) continue;
        const std::vector<int> nodes = mesh_.cells[c].nodes;
        for (const int node : nodes)
          if (is_free(node) && visibility_[c] < well_visible) changed = move_node(node) || changed;
      }
      if (!changed) break;
    }
  }

  bool move_node(int node) {
    const std::vector<int> cells = cells_at(node);
    const auto least = [&](double limit) {
      double value = well_visible;
      for (const int cell : cells) {
        value = std::min(value, centre_of(cell).visibility);
        if (value <= limit) break;
      }
      return value;
    };
    double best = well_visible;
    for (const int cell : cells) best = std::min(best, visibility_[at(cell)]);
    bool moved = false;
    double step = 0.2 * cells_.spacing[at(node)];
    for (int k = 0; k < 5 && best < well_visible; ++k, step *= 0.5) {
      const Vec2 from = mesh_.nodes[at(node)];
      Vec2 best_place = from;
      for (const Vec2& direction : {Vec2(1, 0), Vec2(0.6, 0.8), Vec2(0, 1), Vec2(-0.6, 0.8), Vec2(-1, 0),
                                    Vec2(-0.6, -0.8), Vec2(0, -1), Vec2(0.6, -0.8)}) {
        mesh_.nodes[at(node)] = from + step * direction;
        if (const double value = least(best); value > best) {
          best = value;
          best_place = mesh_.nodes[at(node)];
        }
      }
      mesh_.nodes[at(node)] = best_place;
      moved = moved || best_place != from;
    }
    if (moved)
      for (const int cell : cells) {
        const KernelCentre centre = centre_of(cell);
        mesh_.cells[at(cell)].centre = centre.centre;
        visibility_[at(cell)] = centre.visibility;
      }
    return moved;
  }

  // Cells that no point sees well (at re-entrant corners) become several.
  void divide_cells() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      while (!cells_.fixed_centre[c] && visibility_[c] < hardly_visible) {
        points_of(mesh_.cells[c], points_);
        const std::vector<std::vector<int>> parts = divide_by_diagonal(points_);
        if (parts.empty()) break;
        std::array<PolygonCell, 2> cells;
        std::array<KernelCentre, 2> centres;
        for (std::size_t k = 0; k < 2; ++k) {
          cells[k].region = mesh_.cells[c].region;
          for (const int i : parts[k]) cells[k].nodes.push_back(mesh_.cells[c].nodes[at(i)]);
          points_of(cells[k], points_);
          centres[k] = kernel_centre(points_);
          cells[k].centre = centres[k].centre;
        }
        if (std::min(centres[0].visibility, centres[1].visibility) < 1.5 * visibility_[c]) break;
        mesh_.cells[c] = std::move(cells[0]);
        visibility_[c] = centres[0].visibility;
        mesh_.cells.push_back(std::move(cells[1]));
        visibility_.push_back(centres[1].visibility);
        cells_.fixed_centre.push_back(false);
      }
  }

  void check() const {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      if (!(visibility_[c] > 0.0))
        throw Refusal("no polygon fits between the lines", mesh_.nodes[at(mesh_.cells[c].nodes.front())]);
  }

  // Nodes in the order in which cells meet them; those that no cell has go.
  PolygonMesh renumbered() {
    std::vector<int> number(mesh_.nodes.size(), unnumbered);
    std::vector<Vec2> nodes;
    nodes.reserve(mesh_.nodes.size());
    const auto renumber = [&](int& node) {
      int& now = number[at(node)];
      if (now == unnumbered) {
        now = static_cast<int>(nodes.size());
        nodes.push_back(mesh_.nodes[at(node)]);
      }
      node = now;
    };
    for (PolygonCell& cell : mesh_.cells)
      for (int& node : cell.nodes) renumber(node);
    for (auto* side : {&mesh_.left, &mesh_.right})
      for (std::vector<int>& line : *side)
        for (int& node : line) renumber(node);
    mesh_.nodes = std::move(nodes);
    return std::move(mesh_);
  }

  DualCells cells_;
  PolygonMesh& mesh_;  // of cells_
  const std::vector<Triangle>& triangles_;
  std::vector<double> visibility_;                 // for each cell
  std::unordered_map<int, int> merged_, partner_;  // centroids that became one node
  std::vector<Vec2> points_;
};

}  // namespace

PolygonMesh improved(DualCells cells) { return Improvement(std::move(cells)).finish(); }

}  // namespace scabo::mesh
