// A tree of bounding boxes, to find the few of many things that lie near a point.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "scabo/geometry/box.hpp"

namespace scabo::geometry {

/// Distance of a point from a box that is not empty; 0 inside.
inline double distance_to(const Box& box, const Vec2& p) {
  return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).norm();
}

/// Halves the things again and again across the longer side of the box around them, down to four or fewer.
class BoxTree {
 public:
  /// `boxes`: of the things, which are numbered from 0.
  explicit BoxTree(std::vector<Box> boxes);

  struct Node {
    Box box;
    std::size_t begin = 0, end = 0;  ///< its things: item(begin) ... item(end - 1)
    std::size_t second = 0;          ///< its children are the next node and this one; 0: a leaf
  };
  bool empty() const { return nodes_.empty(); }
  const std::vector<Node>& nodes() const { return nodes_; }  ///< the first one is the whole
  const Box& box(std::size_t thing) const { return boxes_[thing]; }
  std::size_t item(std::size_t place) const { return order_[place]; }

  /// Calls act(thing) with all things of every leaf, unless enter(node number) is false of it or of a node above it.
  template <typename Enter, typename Act>
  void visit(const Enter& enter, const Act& act) const {
    if (!empty()) descend(0, enter, act, [](std::size_t, std::size_t) { return false; });
  }
  /// The same; of two children the one whose box is nearer to `p` comes first.
  template <typename Enter, typename Act>
  void visit_from(const Vec2& p, const Enter& enter, const Act& act) const {
    if (!empty())
      descend(0, enter, act, [&](std::size_t first, std::size_t second) {
        return distance_to(nodes_[second].box, p) < distance_to(nodes_[first].box, p);
      });
  }
  /// Calls act(thing) with every thing whose box is within `radius` of `p`.
  template <typename Act>
  void within(const Vec2& p, double radius, const Act& act) const {
    visit([&](std::size_t node) { return distance_to(nodes_[node].box, p) <= radius; },
          [&](std::size_t thing) {
            if (distance_to(boxes_[thing], p) <= radius) act(thing);
          });
  }

 private:
  std::size_t build(std::size_t begin, std::size_t end);

  template <typename Enter, typename Act, typename Swap>
  void descend(std::size_t index, const Enter& enter, const Act& act, const Swap& swapped) const {
    if (!enter(index)) return;
    const Node& node = nodes_[index];
    if (node.second != 0) {
      const bool swap = swapped(index + 1, node.second);
      descend(swap ? node.second : index + 1, enter, act, swapped);
      descend(swap ? index + 1 : node.second, enter, act, swapped);
      return;
    }
    for (std::size_t i = node.begin; i < node.end; ++i) act(order_[i]);
  }

  std::vector<Box> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace scabo::geometry
