// An interference given as a negative gap and the same given as a prescribed displacement are one problem: the upper
// block is moved down by 0.1 mm, or 0.1 mm too tall. Small displacements: forces, gaps and slips are the same.
#include "run.hpp"

namespace scabo::verification {
namespace {

const char* const pressed_blocks = R"(
scabo: 1
materials: {stiff: {young: 30e9, poisson: 0.2}, soft: {young: 10e9, poisson: 0.3}}
bodies:
  lower: {material: stiff, shape: {rectangle: {corner: [0, 0], size: [3, 1]}}, mesh: {size: 0.25}}
  upper: {material: soft, shape: {rectangle: {corner: [0, 1], size: [3, 1.5]}}, mesh: {size: 0.25}}
supports:
  - {on: lower.bottom, fix: [x, y]}
  - {on: upper.top_left, fix: [x]}
  - SUPPORT
loads:
  aside: {on: upper.right, pressure: 2e5}
contacts:
  joint: {between: [lower.top, upper.bottom], friction: 0.3, gap: GAP}
)";

std::string with(std::string text, const std::string& support, const std::string& gap) {
  text.replace(text.find("SUPPORT"), 7, support);
  text.replace(text.find("GAP"), 3, gap);
  return text;
}

TEST(Interference, AsANegativeGapOrAsAPrescribedDisplacement) {
  const auto by_gap = run(with(pressed_blocks, "{on: upper.top, fix: [y]}", "-1e-4"));
  const auto by_displacement = run(with(pressed_blocks, "{on: upper.top, displacement: [null, -1e-4]}", "0"));
  const auto &one = last(by_gap).contacts.front(), &other = last(by_displacement).contacts.front();
  ASSERT_GT(one.normal_force, 1e5);
  ASSERT_EQ(one.pairs.size(), other.pairs.size());
  EXPECT_NEAR(one.normal_force, other.normal_force, 1e-8 * one.normal_force);
  EXPECT_NEAR(one.tangential_force, other.tangential_force, 1e-8 * one.normal_force);
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_NEAR(one.pairs[i].normal_force, other.pairs[i].normal_force, 1e-8 * one.normal_force) << "pair " << i;
    EXPECT_NEAR(one.pairs[i].gap, other.pairs[i].gap, 1e-12) << "pair " << i;
    EXPECT_EQ(one.pairs[i].state, other.pairs[i].state) << "pair " << i;
  }
}

}  // namespace
}  // namespace scabo::verification
