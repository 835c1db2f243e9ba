#include "scabo/system/same_nodes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scabo::system {
namespace {

TEST(SameNodes, AreInTheSamePlaceToTheLastBit) {
  const double next = std::nextafter(0.1, 1.0);
  const std::vector<Vec2> before{{0.0, 0.0}, {0.1, 2.0}, {3.0, 4.0}, {5.0, 6.0}};
  const std::vector<Vec2> nodes{{3.0, 4.0}, {next, 2.0}, {7.0, 8.0}, {0.1, 2.0}, {0.0, 0.0}};
  EXPECT_EQ(same_nodes(nodes, before), (std::vector<int>{2, -1, -1, 1, 0}));
}

TEST(SameNodes, OnTheFacesOfACrackBelongTogetherInTheirOrder) {
  const Vec2 here(1.0, 1.0), there(2.0, 1.0);
  EXPECT_EQ(same_nodes(std::vector<Vec2>{here, there, here}, std::vector<Vec2>{there, here, there, here}),
            (std::vector<int>{1, 0, 3}));
  EXPECT_EQ(same_nodes(std::vector<Vec2>{here, here, here}, std::vector<Vec2>{here, here}),
            (std::vector<int>{0, 1, -1}));
  EXPECT_EQ(same_nodes(std::vector<Vec2>{here}, std::vector<Vec2>{}), (std::vector<int>{-1}));
}

}  // namespace
}  // namespace scabo::system
