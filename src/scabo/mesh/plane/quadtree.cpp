#include "scabo/mesh/plane/quadtree.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "scabo/mesh/plane/quadtree/curves.hpp"
#include "scabo/mesh/plane/quadtree/cut.hpp"
#include "scabo/mesh/plane/quadtree/forest.hpp"
#include "scabo/mesh/plane/quadtree/pieces.hpp"
#include "scabo/mesh/plane/refusal.hpp"

namespace scabo::mesh {

namespace quadtree {
namespace {

constexpr double margin_of_lists = 1e-6;  // in parts of a cell's size: lines this close to a cell touch it
constexpr double rim = 0.02;              // lines in this outer part of a cell alone demand no refinement

/// How many roots side by side make cells of at most `size` that are square, or nearly so.
std::pair<int, int> root_numbers(const Vec2& extent, double size) {
  const double wanted = std::min(size, extent.minCoeff() > 1e-6 * extent.maxCoeff() ? extent.minCoeff() : size);
  const auto least = [](double ratio) { return std::max(1.0, std::ceil(ratio * (1.0 - 1e-9))); };
  const double nx = least(extent.x() / wanted), ny = least(extent.y() / wanted);
  if (nx * ny > 5e8) return {0, 0};
  for (double n = nx; n <= 1.25 * nx + 1.0; ++n) {
    const double m = extent.y() / (extent.x() / n);
    if (std::abs(m - std::round(m)) < 1e-9 * m && m >= 0.999) return {int(n), int(std::round(m))};
  }
  return {int(nx), int(ny)};
}

/// The tree, divided as wanted size, lines and centres demand.
class Grower {
 public:
  Grower(const Domain& domain, const QuadtreeOptions& options)
      : domain_(domain), options_(options), curves_(domain.lines), regions_(curves_), forest_(make_forest()) {
    forest_.divided = [this](int parent) { hand_down(parent); };
    find_centres();
    list_roots();
    refine(0);
    settle();
  }

  PolygonMesh mesh() {
    for (int attempt = 0; attempt < 24; ++attempt) {
      std::vector<Vec2> trouble;
      const std::vector<int> leaves = forest_.leaves();
      Pieces pieces = cut_leaves(forest_, leaves, lists_, curves_, regions_, patches_, trouble);
      if (options_.curved_sides) pieces.curved = domain_.lines;
      if (trouble.empty()) {
        collapse_short_sides(pieces, options_.shortest_side);
        divide_unseen_cells(pieces);
        merge_small_cells(pieces);
        place_centres(pieces, trouble);
        find_lost_nodes(pieces, trouble);
      }
      if (trouble.empty()) return finished(std::move(pieces), domain_.lines);
      last_trouble_ = trouble.front();
      if (!divide_at(trouble)) break;
    }
    give_up("no division of the squares was found in which lines cut each into sound cells,");
  }

 private:
  [[noreturn]] void give_up(const char* reason) const { throw Refusal(reason, last_trouble_); }

  Forest make_forest() {
    const Vec2 extent = curves_.box.upper - curves_.box.lower;
    const auto& size = options_.size_of_roots ? options_.size_of_roots : domain_.size;
    double largest = 0.0;
    constexpr int samples = 48;
    for (int j = 0; j <= samples; ++j) {
      for (int i = 0; i <= samples; ++i) {
        largest = std::max(largest, size(curves_.box.lower + extent.cwiseProduct(Vec2(i, j) / samples)));
      }
    }
    const auto [nx, ny] = root_numbers(extent, largest);
    last_trouble_ = curves_.box.lower;
    if (nx == 0) give_up("the wanted size makes more than 500 million cells, for a body that begins");
    return Forest(curves_.box.lower, extent.cwiseQuotient(Vec2(nx, ny)), nx, ny);
  }

  Box box_of(const TreeCell& cell) const {
    const Vec2 lower = forest_.lower(cell);
    return {lower, lower + forest_.size(cell.level)};
  }

  void list_roots() {
    const int nx = int(std::round((curves_.box.upper.x() - curves_.box.lower.x()) / forest_.size(0).x()));
    const int ny = int(forest_.cells.size()) / nx;
    for (std::size_t line = 0; line < curves_.curves.size(); ++line) list_block(int(line), 0, 0, nx, ny, nx);
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const int index = y * nx + x;
        TreeCell& cell = forest_.cells[index];
        if (cell.lines >= 0) {
          cell.region = TreeCell::cut;
        } else if (x > 0 && forest_.cells[index - 1].lines < 0) {
          cell.region = forest_.cells[index - 1].region;
        } else {
          cell.region = region_of(cell);
        }
      }
    }
  }

  int region_of(const TreeCell& cell) const { return regions_.at(forest_.middle(cell), forest_.size(cell.level).y()); }

  /// Enters a line in the lists of the roots it touches, by halving of blocks of roots.
  void list_block(int line, int x0, int y0, int x1, int y1, int nx) {
    const Vec2 size = forest_.size(0);
    const Box box{forest_.origin() + size.cwiseProduct(Vec2(x0, y0)),
                  forest_.origin() + size.cwiseProduct(Vec2(x1, y1))};
    if (!curves_.curves[line].meets(box.grown(margin_of_lists * size.minCoeff()))) return;
    if (x1 - x0 == 1 && y1 - y0 == 1) {
      TreeCell& cell = forest_.cells[y0 * nx + x0];
      if (cell.lines < 0) {
        cell.lines = int(lists_.size());
        lists_.emplace_back();
      }
      lists_[cell.lines].push_back(line);
    } else if (x1 - x0 >= y1 - y0) {
      const int middle = (x0 + x1) / 2;
      list_block(line, x0, y0, middle, y1, nx);
      list_block(line, middle, y0, x1, y1, nx);
    } else {
      const int middle = (y0 + y1) / 2;
      list_block(line, x0, y0, x1, middle, nx);
      list_block(line, x0, middle, x1, y1, nx);
    }
  }

  void hand_down(int parent) {
    const TreeCell above = forest_.cells[parent];
    if (above.lines < 0) return;
    const double margin = margin_of_lists * forest_.size(above.level + 1).minCoeff();
    for (int k = 0; k < 4; ++k) {
      TreeCell& cell = forest_.cells[above.child + k];
      const Box box = box_of(cell).grown(margin);
      std::vector<int> list;
      for (int line : lists_[above.lines]) {
        if (curves_.curves[line].meets(box)) list.push_back(line);
      }
      if (list.empty()) {
        cell.region = region_of(cell);
      } else {
        cell.lines = int(lists_.size());
        lists_.push_back(std::move(list));
      }
    }
  }

  /// Divides cells from a number on, and their children, while they are too large.
  void refine(std::size_t from) {
    for (std::size_t k = from; k < forest_.cells.size(); ++k) {
      if (forest_.cells[k].child < 0 && too_large(forest_.cells[k])) forest_.split(int(k));
      if (forest_.cells.size() > 400000000)
        give_up("the wanted sizes make more than 400 million cells, for a body that begins");
    }
  }

  bool too_large(const TreeCell& cell) const {
    if (cell.region == TreeCell::outside || cell.level >= forest_.deepest()) return false;
    const Vec2 size = forest_.size(cell.level);
    const double largest = size.maxCoeff() * (1.0 - 1e-9);
    const Box box = box_of(cell);
    double wanted = domain_.size(0.5 * (box.lower + box.upper));
    for (int k = 0; k < 4; ++k) {
      wanted = std::min(wanted, domain_.size(box.lower + size.cwiseProduct(Vec2(k & 1, k >> 1))));
    }
    if (largest > wanted) return true;
    if (cell.lines < 0) return false;
    const Box inner = box.grown(-rim * size.minCoeff());
    int corner = -1, corners = 0, curves = 0;
    bool apart = false, curved = false;
    std::set<int> seen;
    for (int line : lists_[cell.lines]) {
      const Curve& curve = curves_.curves[line];
      for (int end : {curve.first, curve.last}) {
        if (!inner.contains(curves_.corners[end]) || !seen.insert(end).second) continue;
        corner = end;
        ++corners;
        wanted = std::min(wanted, domain_.size(curves_.corners[end]));
      }
    }
    if (largest > wanted) return true;
    for (int line : lists_[cell.lines]) {
      // Half circles and more would be lost in larger cells, which is noticed only after cutting.
      const Curve& curve = curves_.curves[line];
      if (curve.arc && std::abs(curve.arc->sweep) > 1.6 && largest > 1.5 * curve.arc->radius && curve.meets(inner))
        return true;
    }
    const double least = options_.min_size > 0.0 ? options_.min_size : wanted / 32.0;
    if (0.5 * size.maxCoeff() < least * (1.0 - 1e-9)) return false;
    for (int line : lists_[cell.lines]) {
      const Curve& curve = curves_.curves[line];
      if (!curve.meets(inner)) continue;
      ++curves;
      if (corner >= 0 && curve.first != corner && curve.last != corner) apart = true;
      if (curve.arc && largest > options_.turn * curve.arc->radius) curved = true;
    }
    return corners > 1 || apart || (corner < 0 && curves > 1) || curved;
  }

  /// The points that become centres: where at most one crack or one part of the outside ends.
  void find_centres() {
    const double near = 1e-9 * (curves_.box.upper - curves_.box.lower).norm();
    for (std::size_t corner = 0; corner < curves_.corners.size(); ++corner) {
      const bool wanted = std::any_of(domain_.centres.begin(), domain_.centres.end(), [&](const Vec2& centre) {
        return (centre - curves_.corners[corner]).norm() <= near;
      });
      if (!wanted) continue;
      int cracks = 0, borders = 0, lines = 0;  // borders: of the body
      for (const Curve& curve : curves_.curves) {
        for (int end : {curve.first, curve.last}) {
          if (end != int(corner)) continue;
          ++lines;
          cracks += curve.crack;
          borders += curve.left < 0 || curve.right < 0;
        }
      }
      if ((2 * cracks + borders == 2) || (cracks + borders == 0 && lines >= 2)) {
        patches_.push_back({int(corner), {}});
      }
    }
  }

  /// Balances the tree and makes room around the centres until neither changes anything.
  void settle() {
    for (;;) {
      const std::size_t before = forest_.cells.size();
      forest_.balance();
      for (Patch& patch : patches_) make_room(patch);
      if (forest_.cells.size() == before) return;
    }
  }

  void make_room(Patch& patch) {
    const Vec2& centre = curves_.corners[patch.corner];
    for (;;) {
      const int index = forest_.leaf_at(centre);
      const TreeCell leaf = forest_.cells[index];
      const Vec2 size = forest_.size(leaf.level);
      const Vec2 number = (centre - forest_.origin()).cwiseQuotient(size);
      const int x = int(std::lround(number.x())), y = int(std::lround(number.y()));
      const Vec2 middle = forest_.origin() + size.cwiseProduct(Vec2(x, y));
      patch.box = {middle - size, middle + size};
      if (!is_free(patch, size.maxCoeff())) {
        if (leaf.level >= forest_.deepest()) {
          last_trouble_ = centre;
          give_up("there is no room for the cell of a crack tip");
        }
        forest_.split(index);
        continue;
      }
      bool changed = false;
      for (int k = 0; k < 4; ++k) {
        const int other = forest_.find(leaf.level, x - 1 + (k & 1), y - 1 + (k >> 1));
        if (other < 0 || forest_.cells[other].child >= 0) continue;
        if (forest_.cells[other].level < leaf.level && forest_.cells[other].region != TreeCell::outside) {
          forest_.split(other);
          changed = true;
        }
      }
      if (!changed) return;
    }
  }

  /// Whether no other corner or line is in the box of a centre, and no other centre near it.
  bool is_free(const Patch& patch, double size) const {
    const Vec2& centre = curves_.corners[patch.corner];
    for (const Patch& other : patches_) {
      if (other.corner == patch.corner) continue;
      if ((curves_.corners[other.corner] - centre).cwiseAbs().maxCoeff() < 3.01 * size) return false;
    }
    const Box box = patch.box.grown(0.1 * size);
    for (const Curve& curve : curves_.curves) {
      const bool ends = curve.first == patch.corner || curve.last == patch.corner;
      if (ends) {
        const Vec2& other = curves_.corners[curve.first == patch.corner ? curve.last : curve.first];
        if (curve.first == curve.last || box.contains(other)) return false;
        if (curve.arc && size > options_.turn * curve.arc->radius) return false;
      } else if (curve.meets(box)) {
        return false;
      }
    }
    return true;
  }

  /// Divides the largest leaves around points at which the lines leave no valid cells: between leaves of one size what
  /// an arc cuts off can be united with a neighbour.
  bool divide_at(const std::vector<Vec2>& points) {
    std::set<int> found;
    for (const Vec2& point : points)
      for (const int index : largest_around(point)) found.insert(index);
    for (const int index : found) forest_.split(index);
    settle();
    return !found.empty();
  }

  /// Leaves of the body that can be divided.
  std::vector<int> largest_around(const Vec2& point) const {
    const Vec2 near = 1e-3 * forest_.size(forest_.cells[forest_.leaf_at(point)].level);
    std::vector<int> largest;
    for (int k = 0; k < 4; ++k) {
      const int index = forest_.leaf_at(point + near.cwiseProduct(Vec2(k & 1 ? 1 : -1, k >> 1 ? 1 : -1)));
      const TreeCell& leaf = forest_.cells[index];
      if (leaf.region == TreeCell::outside || leaf.level >= forest_.deepest()) continue;
      if (!largest.empty() && leaf.level > forest_.cells[largest.front()].level) continue;
      if (!largest.empty() && leaf.level < forest_.cells[largest.front()].level) largest.clear();
      largest.push_back(index);
    }
    return largest;
  }

  const Domain& domain_;
  const QuadtreeOptions& options_;
  Vec2 last_trouble_ = Vec2::Zero();
  Curves curves_;
  RegionFinder regions_;
  Forest forest_;
  std::vector<std::vector<int>> lists_;  // lines that touch a cell
  std::vector<Patch> patches_;
};

}  // namespace
}  // namespace quadtree

PolygonMesh quadtree_mesh(const Domain& domain, const QuadtreeOptions& options) {
  ensure(!domain.lines.empty(), "a domain without lines");
  return quadtree::Grower(domain, options).mesh();
}

}  // namespace scabo::mesh
