// Which cracks divide a body.
#include "scabo/analysis/growth/split.hpp"

#include <gtest/gtest.h>

namespace scabo::analysis {
namespace {

void add_loop(geometry::Outline& outline, const std::vector<Vec2>& corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    geometry::Edge& edge = outline.edges.emplace_back();
    edge.start = corners[k];
    edge.end = corners[(k + 1) % corners.size()];
  }
}

/// A square of side 10 with square holes of side 1 about (3, 5) and (7, 5), and cracks.
bool split_by(const std::vector<std::vector<Vec2>>& cracks) {
  model::Body body;
  add_loop(body.outline, {{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  for (const double x : {2.5, 6.5}) {
    body.outline.holes.push_back(static_cast<int>(body.outline.edges.size()));
    add_loop(body.outline, {{x, 4.5}, {x, 5.5}, {x + 1, 5.5}, {x + 1, 4.5}});
  }
  for (const std::vector<Vec2>& path : cracks) {
    model::Crack& crack = body.cracks.emplace_back();
    crack.path = path;
  }
  return is_split(body);
}

TEST(Split, ByACrackFromEdgeToEdge) {
  EXPECT_FALSE(split_by({}));
  EXPECT_FALSE(split_by({{{1, 1}, {2, 2}}}));
  EXPECT_FALSE(split_by({{{0, 1}, {9, 1}}}));
  EXPECT_TRUE(split_by({{{0, 1}, {5, 2}, {10, 1}}}));
  EXPECT_TRUE(split_by({{{0, 1}, {2, 1}, {2, 0}}}));
}

TEST(Split, ByCracksOverHoles) {
  const std::vector<Vec2> left{{0, 5}, {2.5, 5}}, between{{3.5, 5}, {6.5, 5}}, right{{7.5, 5}, {10, 5}};
  EXPECT_FALSE(split_by({left}));
  EXPECT_FALSE(split_by({left, between}));
  EXPECT_TRUE(split_by({left, between, right}));
  EXPECT_FALSE(split_by({between, right}));
}

TEST(Split, ByCracksThatMeetCracks) {
  const std::vector<Vec2> edge{{0, 2}, {5, 2}};
  EXPECT_FALSE(split_by({edge, {{4, 2}, {4, 3}}}));
  EXPECT_TRUE(split_by({edge, {{4, 2}, {4, 0}}}));
  EXPECT_FALSE(split_by({edge, {{5, 2}, {6, 2}}}));  // tip to tip
  EXPECT_TRUE(split_by({edge, {{5, 2}, {10, 2}}}));
  EXPECT_FALSE(split_by({edge, {{0, 2}, {3, 1}}}));           // from the same mouth
  EXPECT_TRUE(split_by({{{1, 1}, {3, 1}, {3, 3}, {2, 1}}}));  // with itself
}

}  // namespace
}  // namespace scabo::analysis
