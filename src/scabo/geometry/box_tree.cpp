#include "scabo/geometry/box_tree.hpp"

#include <numeric>

namespace scabo::geometry {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, boxes_.size());
}

std::size_t BoxTree::build(std::size_t begin, std::size_t end) {
  Node node{{}, begin, end};
  for (std::size_t i = begin; i < end; ++i) node.box.add(boxes_[order_[i]]);
  const std::size_t index = nodes_.size();
  nodes_.push_back(node);
  constexpr std::size_t of_leaf = 4;
  if (end - begin <= of_leaf) return index;
  const Vec2 extent = node.box.high - node.box.low;
  const int axis = extent.x() >= extent.y() ? 0 : 1;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t i, std::size_t j) {
    const double x = boxes_[i].low[axis] + boxes_[i].high[axis], y = boxes_[j].low[axis] + boxes_[j].high[axis];
    return x < y || (x == y && i < j);
  });
  build(begin, middle);
  const std::size_t second = build(middle, end);
  nodes_[index].second = second;
  return index;
}

}  // namespace scabo::geometry
