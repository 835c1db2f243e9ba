#include "scabo/run/plan.hpp"

#include <gtest/gtest.h>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::run {
namespace {

/// Of a rectangle of 4 x 1, one super-element of 1,600 degrees of freedom.
double seconds_of(const std::string& centre) {
  const model::Model model = input::parse_model(R"(
scabo: 1
materials: {soft: {young: 1e4, poisson: 0.3}}
bodies:
  b: {material: soft, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: 0.05, order: 4, centre: )" +
                                                    centre + R"(}}
supports: [{on: b.left, fix: [x, y]}]
loads: {down: {on: b.top, pressure: 1}}
)",
                                                "b.yaml");
  return plan_of(model, analysis::check(model)).cells;
}

// A scaling centre near a long side makes the super-element slender as its rays see it: it gets its last digits, which
// takes seven times as long as its stiffness. (Measured: 1.6 s at a distance of 0.05 and 14 s at 0.01, of two blocks.)
TEST(Plan, LastDigitsTakeTheirTime) {
  const double away = seconds_of("[2, 0.05]"), near = seconds_of("[2, 0.01]");
  EXPECT_NEAR(near / away, 8.3, 1.0);
  EXPECT_DOUBLE_EQ(seconds_of("[2, 0.05]"), seconds_of("[2, 0.1]"));
  // One block of more rows than last digits are for.
  EXPECT_DOUBLE_EQ(seconds_of("[1.9, 0.01]"), seconds_of("[1.9, 0.1]"));
}

}  // namespace
}  // namespace scabo::run
