#include "scabo/analysis/state/increment_record.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace scabo::analysis {
namespace {

IncrementResult with_growth() {
  IncrementResult increment;
  increment.step = 2;
  increment.step_name = "grow";
  increment.increment = 7;
  increment.reached = 0.875;
  GrowthResult growth;
  growth.load_factor = 1.25;
  growth.cycles = 1e5;
  growth.displacement = 0.5;
  growth.energy = GrowthEnergy{1.0, 2.0, 5.0, 3.0, 4.0, 6.0};
  TipResult tip;
  tip.name = "plate.flaw.end";
  tip.position = Vec2(0.1, -0.2);
  tip.length = 0.3;
  tip.opening = 0.01;
  tip.meets = Vec2(0.5, 0.25);
  tip.K_I = 5.0;
  tip.K_II = -6.0;
  tip.T = 7.0;
  tip.kink = -0.1;
  tip.load_factor = 1.5;
  tip.grows = true;
  tip.range = 8.0;
  growth.tips = {tip, TipResult()};
  increment.growth = growth;
  return increment;
}

TEST(IncrementRecord, GrowthIsReadBackAsItWas) {
  const std::string record = record_of(with_growth());
  const IncrementResult read = increment_of(record);
  EXPECT_EQ(record_of(read), record);
  EXPECT_EQ(read.step_name, "grow");
  ASSERT_TRUE(read.growth.has_value());
  EXPECT_EQ(read.growth->load_factor, 1.25);
  EXPECT_EQ(read.growth->cycles, 1e5);
  EXPECT_EQ(read.growth->displacement, 0.5);
  EXPECT_FALSE(read.growth->reaction.has_value());
  EXPECT_EQ(read.growth->energy->contact, 5.0);
  EXPECT_EQ(read.growth->energy->integral, 4.0);
  EXPECT_EQ(read.growth->energy->remeshing, 6.0);
  ASSERT_EQ(read.growth->tips.size(), 2u);
  const TipResult& tip = read.growth->tips[0];
  EXPECT_EQ(tip.name, "plate.flaw.end");
  EXPECT_EQ(tip.position, Vec2(0.1, -0.2));
  EXPECT_EQ(tip.T, 7.0);
  EXPECT_EQ(tip.opening, 0.01);
  EXPECT_EQ(tip.meets, Vec2(0.5, 0.25));
  EXPECT_FALSE(tip.G.has_value());
  EXPECT_EQ(tip.range, 8.0);
  EXPECT_TRUE(tip.grows && !read.growth->tips[1].grows);
}

TEST(IncrementRecord, ThatIsCutOffOrTooLongIsRefused) {
  const std::string record = record_of(with_growth());
  for (std::size_t length = 0; length < record.size(); length += 7)
    EXPECT_THROW(increment_of(record.substr(0, length)), std::out_of_range) << length;
  EXPECT_THROW(increment_of(record + "x"), std::out_of_range);
}

}  // namespace
}  // namespace scabo::analysis
