// Pairs that supports on both sides hold along the normal take no part in contact; nothing parts them where the
// supports press them into each other.
#include <fmt/format.h>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// The lower block's top is held at its height, the upper block's bottom is moved by `down` (upwards where positive) in
/// `increments`; `gap` between them.
std::string held_joint(double lift, double gap, int increments = 1) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.2}}}}
bodies:
  lower: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
  upper: {{material: m, shape: {{rectangle: {{corner: [0, 1], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
supports:
  - {{on: lower.bottom, fix: [x, y]}}
  - {{on: lower.top, fix: y}}
  - {{on: upper.top_left, fix: x}}
  - {{on: upper.bottom, displacement: [null, {}], name: lift}}
loads: {{aside: {{on: upper.right, pressure: 1e3}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], gap: {}}}}}
steps: [{{increments: {}}}]
)",
                     lift, gap, increments);
}

std::string complaint_about(const std::string& text) {
  try {
    run(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(HeldPairs, PressedIntoEachOtherAreAMistakeOfTheModel) {
  const std::string complaint = complaint_about(held_joint(-1e-3, 0.0));
  EXPECT_NE(complaint.find("contacts.joint: supports on both sides of the pair at (0, 1) keep it at an overlap of "
                           "0.001, which no contact force can remove: free one side there"),
            std::string::npos)
      << complaint;
  // The gap counts, and the factor of the increment.
  EXPECT_NE(complaint_about(held_joint(-1e-3, 0.75e-3)).find("an overlap of 0.00025,"), std::string::npos);
  EXPECT_NE(complaint_about(held_joint(-1e-3, 0.75e-3, 8)).find("an overlap of 0.000125,"), std::string::npos);
}

TEST(HeldPairs, ThatTouchOrPartAreNone) {
  for (const auto& [lift, gap] : {std::pair{0.0, 0.0}, {1e-3, 0.0}, {-1e-3, 1e-3}, {-1e-3, 2e-3}}) {
    const auto solution = run(held_joint(lift, gap));
    const auto& joint = last(solution).contacts.front();
    EXPECT_TRUE(joint.pairs.empty());
    EXPECT_EQ(joint.normal_force, 0.0);
  }
}

}  // namespace
}  // namespace scabo::verification
