// Two elastic blocks, of which contact alone holds the upper one, have one verdict in every size and unit.
#include <fmt/format.h>

#include <string>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Two square blocks of `size` m, the lower one fixed at its bottom, the upper one held by contact alone.
struct TwoBlocks {
  std::string name;
  double friction;
  std::string loads;  ///< N stands for a thousandth of the weight of a block
  analysis::Outcome expected;
  double normal_force;  ///< of the joint, in the same unit
  std::string mesh = "order: 1";
  double shift = 0.0;  ///< of the upper block, in sizes
};

/// `unit`: a metre in the model's unit of length. Weight grows with the area.
std::string model_of(const TwoBlocks& blocks, double size, double unit) {
  const double side = size * unit, area = unit * unit, force = 1e3 * size * size;
  std::string loads = blocks.loads;
  for (std::size_t at = 0; (at = loads.find(" N", at)) != std::string::npos;) {
    const std::size_t start = loads.find_last_of(" [", at - 1) + 1;
    const std::string number = fmt::format("{}", std::stod(loads.substr(start, at - start)) * force / 1e3);
    loads.replace(start, at + 2 - start, number);
    at = start + number.size();
  }
  const auto body = [&](double left, double bottom) {
    return fmt::format(
        "{{material: m, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}, mesh: {{size: {}, {}}}}}", left,
        bottom, side, side, 0.25 * side, blocks.mesh);
  };
  return fmt::format(
      "scabo: 1\nanalysis: {{plane: stress, thickness: {}}}\n"
      "materials: {{m: {{young: {}, poisson: 0.2, density: {}, expansion: 1e-5}}}}\n"
      "bodies:\n  lower: {}\n  upper: {}\nsupports: [{{on: lower.bottom, fix: [x, y]}}]\nloads:\n{}"
      "contacts: {{joint: {{between: [lower.top, upper.bottom], friction: {}}}}}\n",
      unit, 1e10 / area, 100.0 / (area * unit), body(0.0, 0.0), body(blocks.shift * side, side), loads,
      blocks.friction);
}

constexpr double sizes[] = {100.0, 10.0, 1.0, 0.1, 0.01, 0.001};

const std::string weight = "  weight: {gravity: [0, -10]}\n";  // 1000 N
const TwoBlocks cases[] = {
    {"at rest", 0.5, weight, analysis::Outcome::solved, 1000},
    {"at rest without friction", 0.0, weight, analysis::Outcome::solved, 1000},
    {"pushed below the friction limit", 0.5, weight + "  push: {on: upper.left, force: [499 N, 0]}\n",
     analysis::Outcome::solved, 1000},
    {"pushed beyond it", 0.5, weight + "  push: {on: upper.left, force: [501 N, 0]}\n", analysis::Outcome::mechanism,
     0},
    {"pushed over", 2.0, weight + "  push: {on: upper.top_left, force: [501 N, 0]}\n", analysis::Outcome::mechanism, 0},
    {"loaded in the middle", 0.5, "  press: {on: upper.top, force: [0, -1000 N]}\n", analysis::Outcome::solved, 1000},
    {"lifted", 0.5, "  lift: {on: upper.top, force: [0, 1000 N]}\n", analysis::Outcome::mechanism, 0},
    {"pushed without weight", 0.5, "  push: {on: upper.left, force: [1000 N, 0]}\n", analysis::Outcome::mechanism, 0},
    {"lifted by as much as its weight", 0.5, weight + "  lift: {on: upper.top, force: [0, 1000 N]}\n",
     analysis::Outcome::solved, 0, "order: 2", 0.25},
    {"squeezed", 0.0, "  left: {on: upper.left, force: [1000 N, 0]}\n  right: {on: upper.right, force: [-1000 N, 0]}\n",
     analysis::Outcome::solved, 0},
    {"squeezed, finite elements", 0.0,
     weight + "  left: {on: upper.left, force: [700 N, 0]}\n  right: {on: upper.right, force: [-700 N, 0]}\n",
     analysis::Outcome::solved, 1000, "kind: fem"},
    {"heated without friction", 0.0, weight + "  summer: {temperature: 3}\n", analysis::Outcome::solved, 1000},
};

TEST(TwoElasticBlocks, HaveOneVerdictInEverySizeAndUnit) {
  for (const TwoBlocks& blocks : cases)
    for (const double size : sizes) {
      SCOPED_TRACE(fmt::format("{}, {} m", blocks.name, size));
      const auto metres = run(model_of(blocks, size, 1.0)), millimetres = run(model_of(blocks, size, 1000.0));
      ASSERT_EQ(metres.outcome, blocks.expected) << metres.reason;
      ASSERT_EQ(millimetres.outcome, blocks.expected) << millimetres.reason;
      if (blocks.expected != analysis::Outcome::solved) continue;
      const double weight_of_block = 1000.0 * size * size;
      const analysis::ContactResult &joint = contact_of(last(metres)), &other = contact_of(last(millimetres));
      EXPECT_NEAR(joint.normal_force / weight_of_block, blocks.normal_force / 1000.0, 1e-8);
      for (std::size_t i = 0; i < joint.pairs.size(); ++i) {
        EXPECT_NEAR(other.pairs[i].normal_force, joint.pairs[i].normal_force, 1e-8 * weight_of_block);
        EXPECT_NEAR(other.pairs[i].tangential_force, joint.pairs[i].tangential_force, 1e-8 * weight_of_block);
      }
    }
}

}  // namespace
}  // namespace scabo::verification
