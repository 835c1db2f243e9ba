// Two elastic blocks, of which contact alone holds the upper one, have one verdict in every size and unit.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
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

/// Two upright bricks side by side, pressed together by 100 kPa; the left one stands on the ground, the right one hangs
/// from above, and no support holds them sideways: their common motion no pair feels. `unit`: a metre in the model's
/// unit of length; turned by `degrees`.
std::string pressed_bricks(double size, double unit, double degrees, bool right_first, const std::string& more) {
  const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  const auto at = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", unit * (c * x - s * y), unit * (s * x + c * y));
  };
  const auto body = [&](const char* name, double left) {
    return fmt::format(
        "  {}: {{material: m, shape: {{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, "
        "top: edge_3, left: edge_4}}}}}}, mesh: {{size: {:.17g}}}}}\n",
        name, at(left, 0), at(left + 1, 0), at(left + 1, 2), at(left, 2), size * unit);
  };
  const std::string a = body("w", 0.0), b = body("m", 1.0);
  return fmt::format(
      "scabo: 1\nanalysis: {{plane: stress, thickness: {}}}\nmaterials: {{m: {{young: {}, poisson: 0.15}}}}\n"
      "bodies:\n{}contacts: {{joint: {{between: [w.right, m.left], friction: 0.7}}}}\n"
      "supports: [{{on: w.bottom, fix: normal}}, {{on: m.top, fix: normal}}{}]\n"
      "loads: {{left: {{on: w.left, pressure: {}}}, right: {{on: m.right, pressure: {}}}}}\n",
      unit, 5e9 / (unit * unit), right_first ? b + a : a + b, more, 1e5 / (unit * unit), 1e5 / (unit * unit));
}

// The bricks bulge downwards and upwards, which friction resists: with one corner held sideways, which changes nothing,
// there is nothing special about the model.
TEST(PressedBricks, AreSolvedAtEverySizeInEveryUnitAndPosition) {
  for (const double size : {0.5, 0.25, 0.0625, 0.05}) {
    const auto held = run(pressed_bricks(size, 1.0, 0.0, false, ", {on: w.vertex_1, fix: x}"));
    const double shear = contact_of(last(held)).tangential_force;
    if (size == 0.05) EXPECT_NEAR(shear, -7575.41, 0.01);
    const auto expect = [&](const std::string& model) {
      const analysis::StaticSolution solution = run(model);
      const analysis::ContactResult& joint = contact_of(last(solution));
      EXPECT_NEAR(joint.normal_force, 2e5, 1e-8 * 2e5);
      EXPECT_NEAR(joint.tangential_force, shear, 1e-8 * 2e5);
    };
    SCOPED_TRACE(size);
    expect(pressed_bricks(size, 1.0, 0.0, false, ""));
    expect(pressed_bricks(size, 1e3, 0.0, false, ""));
    expect(pressed_bricks(size, 1e-3, 0.0, true, ""));
    expect(pressed_bricks(size, 1.0, 33.0, false, ""));
    expect(pressed_bricks(size, 1.0, 90.0, true, "") + "steps: [{increments: 10}]\n");
  }
}

}  // namespace
}  // namespace scabo::verification
