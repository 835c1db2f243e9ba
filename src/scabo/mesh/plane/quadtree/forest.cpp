#include "scabo/mesh/plane/quadtree/forest.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/error.hpp"

namespace scabo::mesh::quadtree {

Forest::Forest(const Vec2& origin, const Vec2& root_size, int nx, int ny)
    : origin_(origin), root_size_(root_size), nx_(nx), ny_(ny) {
  cells.reserve(std::size_t(nx) * ny);
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) cells.push_back({x, y});
  }
  deepest_ = 28;  // twice the coordinates of the deepest cells are whole numbers below 2^30
  while ((std::int64_t(std::max(nx, ny)) << (deepest_ + 1)) >= (std::int64_t(1) << 30) && deepest_ > 0) --deepest_;
}

Vec2 Forest::lower(const TreeCell& cell) const { return origin_ + size(cell.level).cwiseProduct(Vec2(cell.x, cell.y)); }

Vec2 Forest::middle(const TreeCell& cell) const {
  return origin_ + size(cell.level).cwiseProduct(Vec2(cell.x + 0.5, cell.y + 0.5));
}

void Forest::split(int index) {
  const TreeCell parent = cells[index];
  ensure(parent.child < 0 && parent.level < deepest_, "a cell of the quadtree cannot be divided");
  cells[index].child = int(cells.size());
  for (int k = 0; k < 4; ++k) {
    cells.push_back({2 * parent.x + (k & 1), 2 * parent.y + (k >> 1), parent.level + 1, -1, parent.region, -1});
  }
  if (divided) divided(index);
}

int Forest::find(int level, int x, int y) const {
  if (x < 0 || y < 0 || (x >> level) >= nx_ || (y >> level) >= ny_) return -1;
  int index = (y >> level) * nx_ + (x >> level);
  for (int down = level - 1; down >= 0 && cells[index].child >= 0; --down) {
    index = cells[index].child + ((x >> down) & 1) + 2 * ((y >> down) & 1);
  }
  return index;
}

int Forest::leaf_at(const Vec2& point) const {
  const Vec2 fine = size(deepest_);
  const auto number = [&](double distance, double step, int roots) {
    const double last = double((std::int64_t(roots) << deepest_) - 1);
    return int(std::clamp(std::floor(distance / step), 0.0, last));
  };
  return find(deepest_, number(point.x() - origin_.x(), fine.x(), nx_), number(point.y() - origin_.y(), fine.y(), ny_));
}

void Forest::balance() {
  std::vector<int> waiting = leaves();
  for (std::size_t k = 0; k < waiting.size(); ++k) {
    const TreeCell cell = cells[waiting[k]];
    if (cell.child >= 0 || cell.level < 2 || cell.region == TreeCell::outside) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        for (;;) {
          const int other = find(cell.level, cell.x + dx, cell.y + dy);
          if (other < 0 || cells[other].level >= cell.level - 1 || cells[other].region == TreeCell::outside) break;
          split(other);
          for (int child = 0; child < 4; ++child) waiting.push_back(cells[other].child + child);
        }
      }
    }
  }
}

std::vector<int> Forest::leaves() const {
  std::vector<int> found, open;
  found.reserve(cells.size());
  for (int root = 0; root < nx_ * ny_; ++root) {
    open.push_back(root);
    while (!open.empty()) {
      const int index = open.back();
      open.pop_back();
      if (cells[index].child < 0) {
        found.push_back(index);
      } else {
        for (int child = 3; child >= 0; --child) open.push_back(cells[index].child + child);
      }
    }
  }
  return found;
}

ForestNodes::ForestNodes(const Forest& forest, const std::vector<int>& leaves) {
  std::size_t inside = 0;
  for (int leaf : leaves) {
    const TreeCell& cell = forest.cells[leaf];
    if (cell.region == TreeCell::outside) continue;
    depth_ = std::max(depth_, cell.level);
    ++inside;
  }
  std::size_t places = 64;
  while (places < 5 * inside / 2) places *= 2;
  keys_.assign(places, ~std::uint64_t(0));
  values_.assign(places, -1);
  mask_ = places - 1;
  positions.reserve(inside + inside / 4);
  const Vec2 unit = forest.size(depth_) / 2.0;
  for (int leaf : leaves) {
    const TreeCell& cell = forest.cells[leaf];
    if (cell.region == TreeCell::outside) continue;
    const std::uint32_t step = std::uint32_t(2) << (depth_ - cell.level);
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t x = std::uint32_t(cell.x + (k & 1)) * step, y = std::uint32_t(cell.y + (k >> 1)) * step;
      if (insert(x, y) == int(positions.size())) {
        positions.push_back(forest.origin() + unit.cwiseProduct(Vec2(x, y)));
      }
    }
  }
}

namespace {
std::size_t hash_of(std::uint64_t key) {
  key *= 0x9e3779b97f4a7c15ULL;
  return key ^ (key >> 32);
}
}  // namespace

int ForestNodes::find(std::uint32_t x, std::uint32_t y) const {
  const std::uint64_t key = (std::uint64_t(y) << 32) | x;
  for (std::size_t at = hash_of(key) & mask_;; at = (at + 1) & mask_) {
    if (keys_[at] == key) return values_[at];
    if (values_[at] < 0) return -1;
  }
}

int ForestNodes::insert(std::uint32_t x, std::uint32_t y) {
  const std::uint64_t key = (std::uint64_t(y) << 32) | x;
  std::size_t at = hash_of(key) & mask_;
  for (; values_[at] >= 0; at = (at + 1) & mask_) {
    if (keys_[at] == key) return values_[at];
  }
  if (positions.size() > mask_ * 3 / 4) {
    // Rare: strongly graded trees have up to four nodes for each leaf.
    const std::vector<std::uint64_t> keys = std::move(keys_);
    const std::vector<int> values = std::move(values_);
    mask_ = 2 * mask_ + 1;
    keys_.assign(mask_ + 1, ~std::uint64_t(0));
    values_.assign(mask_ + 1, -1);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (values[k] < 0) continue;
      std::size_t place = hash_of(keys[k]) & mask_;
      while (values_[place] >= 0) place = (place + 1) & mask_;
      keys_[place] = keys[k];
      values_[place] = values[k];
    }
    return insert(x, y);
  }
  keys_[at] = key;
  return values_[at] = int(positions.size());
}

void ForestNodes::polygon(const TreeCell& leaf, std::vector<int>& nodes) const {
  nodes.clear();
  const std::uint32_t half = std::uint32_t(1) << (depth_ - leaf.level);
  const std::uint32_t x = std::uint32_t(leaf.x) * 2 * half, y = std::uint32_t(leaf.y) * 2 * half;
  const std::uint32_t around[8][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (int k = 0; k < 8; ++k) {
    if (k % 2 == 1 && leaf.level == depth_) continue;
    const int node = find(x + around[k][0] * half, y + around[k][1] * half);
    if (node >= 0) nodes.push_back(node);
  }
}

}  // namespace scabo::mesh::quadtree
