#include "scabo/geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace scabo::geometry {
namespace {

// Against a look at every box.
TEST(BoxTree, FindsWhatLiesWithinADistance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0), extent(0.0, 0.1);
  for (const std::size_t count : {0, 1, 4, 5, 300}) {
    std::vector<Box> boxes(count);
    for (Box& box : boxes) {
      const Vec2 low(place(random), place(random));
      box.add(low);
      box.add(Vec2(low + Vec2(extent(random), extent(random))));
    }
    const BoxTree tree(boxes);
    for (int k = 0; k < 50; ++k) {
      const Vec2 p(1.5 * place(random), 1.5 * place(random));
      const double radius = 5.0 * extent(random);
      std::set<std::size_t> expected, found;
      for (std::size_t i = 0; i < count; ++i)
        if (distance_to(boxes[i], p) <= radius) expected.insert(i);
      tree.within(p, radius, [&](std::size_t i) { EXPECT_TRUE(found.insert(i).second); });
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, NearestFirst) {
  std::vector<Box> boxes(64);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].add(Vec2(static_cast<double>(i), 0.0));
  const BoxTree tree(boxes);
  // The nearest one comes in the first leaf, so that a search that ends there sees no more than a leaf.
  double best = 1e9;
  int seen = 0;
  tree.visit_from(
      {40.2, 0.0},
      [&](std::size_t node) {
        return distance_to(tree.nodes()[node].box, {40.2, 0.0}) < best;
      },
      [&](std::size_t i) {
        ++seen;
        best = std::min(best, distance_to(boxes[i], Vec2(40.2, 0.0)));
      });
  EXPECT_DOUBLE_EQ(best, 40.2 - 40.0);
  EXPECT_LE(seen, 8);
}

}  // namespace
}  // namespace scabo::geometry
