// Memory does not grow with the number of increments: what is written as it comes is not kept.
#include <gtest/gtest.h>

#include "scabo/input/read_model.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

TEST(StreamedIncrements, KeepTheFieldsOfTheLastOnly) {
  const std::string text = R"(scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  lower: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
  upper: {material: steel, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.5}}
supports: [{on: lower.bottom, fix: [x, y]}]
loads: {press: {on: upper.top, pressure: 1e6}}
contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.3}}
steps: [{name: press, increments: 7}]
)";
  const auto kept = run(text);
  analysis::Options options;
  options.keep_fields = false;
  int seen = 0;
  options.on_increment = [&](const analysis::StaticSolution&, const analysis::IncrementResult& increment) {
    ++seen;
    EXPECT_EQ(increment.fields.displacements.size(), 2u);
    EXPECT_EQ(contact_of(increment).pairs.size(), 9u);
  };
  const auto streamed = analysis::solve_static(input::parse_model(text, "test.yaml"), options);
  EXPECT_EQ(seen, 7);
  ASSERT_EQ(streamed.increments.size(), 7u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(increment_at(streamed, i).fields.displacements.empty());
    EXPECT_TRUE(increment_at(streamed, i).contacts[0].pairs.empty());
  }
  EXPECT_EQ(last(streamed).contacts[0].pairs.size(), 9u);
  EXPECT_EQ(increment_at(streamed, 3).contacts[0].max_pressure, increment_at(kept, 3).contacts[0].max_pressure);
  ASSERT_EQ(last(streamed).fields.displacements.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_EQ(last(streamed).fields.displacements[b], last(kept).fields.displacements[b]);
  EXPECT_EQ(increment_at(streamed, 3).contacts[0].normal_force, increment_at(kept, 3).contacts[0].normal_force);
}

}  // namespace
}  // namespace scabo::verification
