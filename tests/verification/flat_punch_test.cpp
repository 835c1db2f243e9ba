// Closed form: a rigid flat punch of half width a, frictionless, on a half-plane: p = P / (pi sqrt(a^2 - x^2)).
#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

TEST(FlatPunch, ForceWithinAnyPartOfItsWidth) {
  // The ground is ten times as wide as the punch: its finite size changes the shape of the pressure by less than 1 %.
  const auto solution = run(R"(
scabo: 1
analysis: {plane: strain}
materials: {m: {young: 10e9, poisson: 0.3}}
bodies:
  ground: {material: m, shape: {rectangle: {corner: [-10, -10], size: [20, 10]}}, mesh: {size: 0.125}}
  punch: {rigid: true, shape: {rectangle: {corner: [-1, 0], size: [2, 1]}}}
supports:
  - {on: ground.bottom, fix: [x, y]}
  - {on: punch, displacement: [0, -1e-3]}
contacts:
  joint: {between: [ground.top, punch.bottom], friction: 0}
)");
  const analysis::IncrementResult& increment = last(solution);
  const analysis::ContactResult& contact = increment.contacts.front();
  const double P = contact.normal_force;
  ASSERT_EQ(contact.pairs.size(), 33u);
  EXPECT_EQ(contact.open, 0);
  EXPECT_NEAR(increment.reactions[1].y(), -P, 1e-9 * P);

  // Force left of x, from the nodes left of it and the half of an end node that belongs to the element before it (the
  // pressure is nearly even over the two elements at an end node, but for those at the edges of the punch).
  double left = 0.0;
  for (const analysis::PairResult& pair : contact.pairs) {
    const bool end_node = (pair.pair - 1) % 2 == 0;
    if (end_node && std::abs(pair.position.x()) < 0.8) {
      const double exact = P * (0.5 + std::asin(pair.position.x()) / std::numbers::pi);
      EXPECT_NEAR(left + 0.5 * pair.normal_force, exact, 0.01 * P) << "x = " << pair.position.x();
    }
    left += pair.normal_force;
  }
  EXPECT_NEAR(contact.pairs[16].pressure, P / std::numbers::pi, 0.01 * P / std::numbers::pi);
}

}  // namespace
}  // namespace scabo::verification
