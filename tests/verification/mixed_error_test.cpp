// The estimated error of a model of super-elements and finite elements is relative to the energy of all of them.
#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

const char* const soft_below = R"(
scabo: 1
materials: {soft: {young: 1e7, poisson: 0.3}, stiff: {young: 1e9, poisson: 0.3}}
bodies:
  base: {material: soft, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.25}}
  block: {material: stiff, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.25}}
supports: [{on: base.bottom, fix: [x, y]}]
loads: {push: {on: block.right, traction: [-1e3, 2e2]}}
contacts: {joint: {between: [base.top, block.bottom], bond: true}}
output: {error: true}
)";

// Under a load that grows from nothing twice the stored energy is |u|^2 = u'K u. Nearly all of it is in the base.
TEST(ErrorEstimate, IsRelativeToTheEnergyOfFiniteElementsToo) {
  const auto solution = run(soft_below);
  const analysis::IncrementResult& increment = last(solution);
  ASSERT_TRUE(increment.error.has_value());
  const analysis::ErrorEstimate& error = *increment.error;
  ASSERT_EQ(error.bodies.size(), 2u);
  ASSERT_TRUE(error.bodies[0].has_value());
  ASSERT_TRUE(error.bodies[1].has_value());
  const double norm = std::sqrt(2.0 * increment.energy.elastic);  // of this mesh, 0.1 % below that of the wider one
  EXPECT_NEAR(increment.energy.external, increment.energy.elastic, 1e-10 * increment.energy.elastic);
  EXPECT_GT(error.bodies[1]->absolute, 0.0);
  EXPECT_NEAR(error.bodies[1]->relative / (error.bodies[1]->absolute / norm), 1.0, 1e-2);
  EXPECT_NEAR(error.relative, std::hypot(error.bodies[0]->relative, error.bodies[1]->relative), 1e-12 * error.relative);
}

}  // namespace
}  // namespace scabo::verification
