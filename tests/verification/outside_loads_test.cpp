// Gravity and temperature without a place act on bodies of finite size: what the ground weighs or how much it expands
// is nothing to a footing on it.
#include <fmt/format.h>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// A block of 2 x 1 m, 4 t, on ground that reaches to infinity.
std::string block_on_ground(const std::string& ground) {
  return fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials:
  concrete: {{young: 30e9, poisson: 0.2, density: 2000, expansion: 1e-5}}
  rock: {{young: 10e9, poisson: 0.3{}}}
bodies:
  ground:
    material: rock
    outside: true
    shape: {{polygon: {{vertices: [[0, 0], [-2, 0], [-2, -3], [2, -3], [2, 0]]}}}}
    mesh: {{size: 0.5, centre: [0, 0]}}
  block: {{material: concrete, shape: {{rectangle: {{corner: [-1, -3], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
loads:
  weight: {{gravity: [0, -10]}}
  summer: {{temperature: 20}}
contacts: {{joint: {{between: [ground.edge_3, block.bottom], friction: 0.5}}}}
)",
                     ground);
}

TEST(OutsideBody, HasNoWeightAndNoTemperatureOfItsOwn) {
  const auto heavy = run(block_on_ground(", density: 2700, expansion: 8e-6")), light = run(block_on_ground(""));
  const analysis::IncrementResult &with = last(heavy), &without = last(light);
  EXPECT_NEAR(with.contacts.front().normal_force, 4e4, 1e-6);
  EXPECT_TRUE(with.fields.interior[0].empty());
  EXPECT_FALSE(with.fields.interior[1].at(0).loads.empty());
  ASSERT_EQ(with.fields.displacements.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_LT((with.fields.displacements[b] - without.fields.displacements[b]).norm(),
              1e-12 * without.fields.displacements[b].norm());
  EXPECT_NEAR(with.energy.external, without.energy.external, 1e-12 * std::abs(without.energy.external));
}

}  // namespace
}  // namespace scabo::verification
