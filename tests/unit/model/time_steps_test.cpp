// What time steps average away of the curves that they follow.
#include "scabo/model/time_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scabo::model {
namespace {

// Of a sine with n steps in a period, more than two: 1 - (sin(pi/n)/(pi/n))^2.
TEST(TimeSteps, AverageASineAway) {
  const Curve sine{"", CurveSine{0.0, 3.0, 5.0, 0.0}, {}};
  for (const double n : {3.0, 5.0, 18.0}) {
    const double x = std::numbers::pi / n;
    EXPECT_NEAR(part_averaged_away(sine, 10.0, 2.0 / n), 1.0 - std::pow(std::sin(x) / x, 2), 1e-12) << n;
  }
  EXPECT_NEAR(part_averaged_away(sine, 10.0, 2.0), 1.0, 1e-12);
  EXPECT_NEAR(2.0 / resolving_step(sine, 10.0), 18.0, 0.5);
  // A load that hardly changes is not averaged away; its mean square is 4 + 4/pi + 0.5 over half a period.
  const Curve on_top{"", CurveSine{2.0, 1.0, 0.5, 0.0}, {}};
  const double mean = 2.0 + 2.0 / std::numbers::pi;
  EXPECT_NEAR(part_averaged_away(on_top, 1.0, 1.0), 1.0 - mean * mean / (4.5 + 8.0 / std::numbers::pi), 1e-12);
}

// A pulse of 0.1 s within 10 s, given from -1 s on: a step of 1 s keeps a tenth of it.
TEST(TimeSteps, AverageAPulseAway) {
  CurveTable table;
  table.first = -1.0, table.last = 9.0;
  for (const auto& [time, value] : {std::pair(-1.0, 0.0), {2.2, 0.0}, {2.2, 7.0}, {2.3, 7.0}, {2.3, 0.0}, {9.0, 0.0}})
    table.points.push_back({(time + 1.0) / 10.0, value});
  const Curve pulse{"", table, {}};
  EXPECT_NEAR(part_averaged_away(pulse, 10.0, 1.0), 0.9, 1e-9);
  EXPECT_NEAR(part_averaged_away(pulse, 10.0, 0.1), 0.0, 1e-9);
  EXPECT_LE(part_averaged_away(pulse, 10.0, resolving_step(pulse, 10.0)), 0.01);
}

TEST(TimeSteps, AverageNothingOfWhatIsConstant) {
  const Curve none{"", CurveTable{{{0.0, 0.0}, {1.0, 0.0}}, 0.0, 1.0}, {}},
      constant{"", CurveTable{{{0.0, 2.0}}, 0.0, 1.0}, {}};
  for (const Curve& curve : {none, constant}) {
    EXPECT_NEAR(part_averaged_away(curve, 5.0, 5.0), 0.0, 1e-15);
    EXPECT_EQ(resolving_step(curve, 5.0), 5.0);
  }
}

}  // namespace
}  // namespace scabo::model
