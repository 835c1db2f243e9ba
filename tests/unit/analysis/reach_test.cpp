#include "scabo/analysis/march/reach.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scabo::analysis {
namespace {

using testing::HasSubstr;

// What rounding leaves of one and the same model differs by a thousand between processors: no model is sure to miss
// its tolerance.
TEST(Reach, ToleranceBelowRoundingIsToldWithTheOneToSet) {
  EXPECT_THAT(tolerance_to_set(1.1e-13, 1e-14, 358),
              HasSubstr("rounding leaves 1.1e-13 in 358 degrees of freedom: set solver.tolerance to 1e-12 or leave"));
  EXPECT_THAT(tolerance_to_set(2e-14, 1e-14, 358), HasSubstr("to 1e-13 or"));
  EXPECT_THAT(tolerance_to_set(4e-14, 1e-14, 358), HasSubstr("to 1e-12 or"));
  EXPECT_EQ(tolerance_to_set(0.9e-14, 1e-14, 358), "");  // not missed
  EXPECT_EQ(tolerance_to_set(5e-11, 1e-14, 358), "");    // more than rounding
}

}  // namespace
}  // namespace scabo::analysis
