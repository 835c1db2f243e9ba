// The cells of a quadtree with several equal roots side by side, and the numbers of their nodes.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh::quadtree {

/// A rectangle. It covers [x, x + 1] by [y, y + 1] in units of the roots' size divided by 2^level.
struct TreeCell {
  static constexpr int outside = -1, cut = -2;  // values of `region` that are not regions

  int x = 0, y = 0;
  int level = 0;
  int child = -1;        ///< index of the first of four children: lower left, lower right, upper left, upper right
  int region = outside;  ///< of a leaf: the region that contains all of it, or `outside`, or `cut`
  int lines = -1;        ///< place of its list of lines, if lines touch it
};

class Forest {
 public:
  /// nx * ny roots, the lower left one with its lower left corner at `origin`.
  Forest(const Vec2& origin, const Vec2& root_size, int nx, int ny);

  std::vector<TreeCell> cells;  ///< the roots first, row by row
  /// Called with the index of a cell that has just been divided; its children have its region.
  std::function<void(int)> divided;

  Vec2 size(int level) const { return root_size_ / double(std::int64_t(1) << level); }
  Vec2 lower(const TreeCell& cell) const;  ///< lower left corner
  Vec2 middle(const TreeCell& cell) const;
  const Vec2& origin() const { return origin_; }
  int deepest() const { return deepest_; }  ///< level that cannot be divided, limited by the range of whole numbers

  void split(int cell);
  /// The leaf that contains the cell (x, y) of a level, or the cell itself if it is divided further; -1: not covered.
  int find(int level, int x, int y) const;
  int leaf_at(const Vec2& point) const;  ///< points beyond the border belong to the nearest cell
  void balance();                        ///< splits leaves, not those outside, until neighbours differ by one level
  std::vector<int> leaves() const;       ///< in a fixed order

 private:
  Vec2 origin_, root_size_;
  int nx_, ny_, deepest_;
};

/// Nodes at the corners of all leaves that are not outside, and the polygons of these leaves.
class ForestNodes {
 public:
  ForestNodes(const Forest& forest, const std::vector<int>& leaves);

  std::vector<Vec2> positions;
  /// Nodes of a leaf, counter-clockwise from its lower left corner, hanging nodes included.
  void polygon(const TreeCell& leaf, std::vector<int>& nodes) const;

 private:
  int find(std::uint32_t x, std::uint32_t y) const;
  int insert(std::uint32_t x, std::uint32_t y);

  int depth_ = 0;  // of the deepest leaf
  std::vector<std::uint64_t> keys_;
  std::vector<int> values_;
  std::size_t mask_ = 0;
};

}  // namespace scabo::mesh::quadtree
