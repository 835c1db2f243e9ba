// The motion of a mechanism, where statics says what it is: a block on a slope slides along it, a slender one turns
// about its toe, the part of a wall above its weakest bed slides along that bed, a tower turns over as one. In every
// unit of length and turned as a whole; the largest displacement is 1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "run.hpp"

namespace scabo::verification {
namespace {

using analysis::BodyMotion;
using analysis::FlowRule;
using analysis::Mechanism;
using analysis::PairMotion;

/// A model of blocks on a rigid floor, drawn upright in metres, in which `unit` is a metre and the whole is turned.
struct Upright {
  double unit = 1.0, degrees = 0.0;
  std::string bodies, contacts, loads;

  Vec2 turned(const Vec2& v) const {
    const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  Vec2 upright(const Vec2& v) const { return Upright{1.0, -degrees, {}, {}, {}}.turned(v); }

  void add(const std::string& name, double left, double bottom, double width, double height, bool rigid = false) {
    std::string vertices;
    for (const Vec2& at : {Vec2(left, bottom), Vec2(left + width, bottom), Vec2(left + width, bottom + height),
                           Vec2(left, bottom + height)}) {
      const Vec2 x = unit * turned(at);
      vertices += fmt::format("{}[{}, {}]", vertices.empty() ? "" : ", ", x.x(), x.y());
    }
    bodies += fmt::format(
        "  {}: {{{}, shape: {{polygon: {{vertices: [{}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
        "edge_4}}}}}}}}\n",
        name, rigid ? std::string("rigid: true") : fmt::format("material: m, mesh: {{size: {}, order: 1}}", 0.5 * unit),
        vertices);
  }
  void touch(const std::string& a, const std::string& b, double friction) {
    contacts += fmt::format("  {}_{}: {{between: [{}, {}], friction: {}}}\n", a.substr(0, a.find('.')),
                            b.substr(0, b.find('.')), a, b, friction);
  }
  /// Acceleration of all bodies along the floor, over that towards it.
  void shake(double part) {
    const Vec2 g = 9.81 * turned({part, -1.0});
    loads += fmt::format("  weight: {{gravity: [{}, {}]}}\n", g.x(), g.y());
  }
  analysis::StaticSolution solved() const {
    return run(fmt::format(
        "scabo: 1\nmaterials: {{m: {{young: 10e9, poisson: 0.2, density: 2000}}}}\nbodies:\n{}supports: [{{on: floor, "
        "fix: [x, y]}}]\nloads:\n{}contacts:\n{}",
        bodies, loads, contacts));
  }
};

/// What holds of every motion by Coulomb's law.
void expect_admissible(const Mechanism& mechanism) {
  EXPECT_EQ(mechanism.rule, FlowRule::coulomb);
  EXPECT_GT(mechanism.work, 0.0);
  double largest = 0.0;
  for (const BodyMotion& body : mechanism.bodies) largest = std::max(largest, body.largest);
  EXPECT_NEAR(largest, 1.0, 1e-14);
  ASSERT_FALSE(mechanism.pairs.empty());
  for (const PairMotion& pair : mechanism.pairs) EXPECT_GT(pair.opening, -1e-8) << pair.contact << ", " << pair.pair;
}

void expect_at_rest(const BodyMotion& body) {
  EXPECT_LT(body.largest, 1e-8);
  EXPECT_FALSE(body.moves());
}

/// A translation by 1 along the floor.
void expect_slides(const Upright& model, const BodyMotion& body) {
  EXPECT_NEAR(model.upright(body.shift).x(), 1.0, 1e-8);
  EXPECT_NEAR(model.upright(body.shift).y(), 0.0, 1e-8);
  EXPECT_LT(std::abs(body.rotation) * body.size, 1e-8);
  EXPECT_FALSE(body.centre().has_value());
}

void expect_turns_about(const Upright& model, const BodyMotion& body, const Vec2& centre) {
  ASSERT_TRUE(body.centre().has_value());
  EXPECT_LT((*body.centre() - model.unit * model.turned(centre)).norm(), 1e-8 * body.size);
}

class MechanismIn : public testing::TestWithParam<std::pair<double, double>> {
 protected:
  Upright upright(double width = 4.0) const {
    Upright model;
    std::tie(model.unit, model.degrees) = GetParam();
    model.add("floor", -2.0, -1.0, width + 4.0, 1.0, true);
    return model;
  }
};

TEST_P(MechanismIn, BlockOnASlopeSlidesAlongIt) {
  for (const double beyond : {1.001, 1.5}) {
    Upright model = upright();
    model.add("block", 0.0, 0.0, 2.0, 1.0);
    model.touch("floor.top", "block.bottom", 0.4);
    model.shake(0.4 * beyond);
    const auto solution = model.solved();
    ASSERT_EQ(solution.outcome, analysis::Outcome::mechanism) << solution.reason;
    ASSERT_TRUE(solution.mechanism.has_value());
    expect_admissible(*solution.mechanism);
    expect_at_rest(solution.mechanism->bodies[0]);
    expect_slides(model, solution.mechanism->bodies[1]);
    for (const PairMotion& pair : solution.mechanism->pairs) {
      EXPECT_NEAR(pair.opening, 0.0, 1e-8);
      EXPECT_NEAR(pair.slip, 1.0, 1e-8);  // of the block, along t: that of the floor is along +x
    }
    // The work of weight over it: rho g A (sin, -cos) . (1, 0).
    const double area = 2.0 * model.unit * model.unit;
    EXPECT_NEAR(solution.mechanism->work / (2000.0 * 9.81 * area * 0.4 * beyond), 1.0, 1e-8);
  }
}

TEST_P(MechanismIn, SlenderBlockTurnsAboutItsToe) {
  // 1 x 3 m: it falls over beyond 1/3, and does not slide at a friction of 0.8.
  for (const double beyond : {1.001, 1.1}) {
    Upright model = upright();
    model.add("block", 0.0, 0.0, 1.0, 3.0);
    model.touch("floor.top", "block.bottom", 0.8);
    model.shake(beyond / 3.0);
    const auto solution = model.solved();
    ASSERT_EQ(solution.outcome, analysis::Outcome::mechanism) << solution.reason;
    ASSERT_TRUE(solution.mechanism.has_value());
    expect_admissible(*solution.mechanism);
    const BodyMotion& block = solution.mechanism->bodies[1];
    expect_turns_about(model, block, {1.0, 0.0});
    EXPECT_LT(block.rotation, 0.0);  // to the right
    // The corner that moves most is the upper left one, sqrt(10) m from the toe.
    EXPECT_NEAR(block.rotation, -1.0 / (std::sqrt(10.0) * model.unit), 1e-8 / model.unit);
    const PairMotion &heel = solution.mechanism->pairs.front(), &toe = solution.mechanism->pairs.back();
    EXPECT_NEAR(std::max(heel.opening, toe.opening), 1.0 / std::sqrt(10.0), 1e-8);
    EXPECT_NEAR(std::min(heel.opening, toe.opening), 0.0, 1e-8);
    EXPECT_NEAR(std::abs(heel.slip) + std::abs(toe.slip), 0.0, 1e-8);
  }
}

TEST_P(MechanismIn, TowerOfTwoFallsOverAsOne) {
  Upright model = upright();
  model.add("lower", 0.0, 0.0, 1.0, 2.0);
  model.add("upper", 0.0, 2.0, 1.0, 2.0);
  model.touch("floor.top", "lower.bottom", 0.8);
  model.touch("lower.top", "upper.bottom", 0.8);
  model.shake(1.01 / 4.0);  // the upper one alone would fall over at 1/2
  const auto solution = model.solved();
  ASSERT_EQ(solution.outcome, analysis::Outcome::mechanism) << solution.reason;
  ASSERT_TRUE(solution.mechanism.has_value());
  expect_admissible(*solution.mechanism);
  expect_turns_about(model, solution.mechanism->bodies[1], {1.0, 0.0});
  expect_turns_about(model, solution.mechanism->bodies[2], {1.0, 0.0});
  EXPECT_EQ(solution.mechanism->most(), 2u);
  for (const PairMotion& pair : solution.mechanism->pairs)
    if (pair.contact == 1) EXPECT_LT(std::abs(pair.opening) + std::abs(pair.slip), 1e-8);
}

TEST_P(MechanismIn, WallSlidesAlongItsWeakBed) {
  Upright model = upright();
  const int courses = 4;
  std::vector<std::pair<double, double>> below;
  std::vector<std::string> names_below;
  std::size_t first_above = 0, count = 1;
  for (int z = 0; z < courses; ++z) {
    const std::vector<double> joints =
        z % 2 == 0 ? std::vector{0.0, 1.0, 2.0, 3.0, 4.0} : std::vector{0.0, 0.5, 1.5, 2.5, 3.5, 4.0};
    std::vector<std::pair<double, double>> spans;
    std::vector<std::string> names;
    for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
      names.push_back(fmt::format("b{}{}", z, k));
      spans.emplace_back(joints[k], joints[k + 1]);
      model.add(names.back(), joints[k], 0.5 * z, joints[k + 1] - joints[k], 0.5);
      ++count;
      if (k > 0) model.touch(names[k - 1] + ".right", names[k] + ".left", 0.8);
      if (z == 0) model.touch("floor.top", names[k] + ".bottom", 0.8);
      for (std::size_t j = 0; j < below.size(); ++j)
        if (std::min(below[j].second, spans[k].second) - std::max(below[j].first, spans[k].first) > 0.1)
          model.touch(names_below[j] + ".top", names[k] + ".bottom", z == 1 ? 0.3 : 0.8);
    }
    below = spans;
    names_below = names;
    if (z == 0) first_above = count;
  }
  model.shake(0.32);
  const auto solution = model.solved();
  ASSERT_EQ(solution.outcome, analysis::Outcome::mechanism) << solution.reason;
  ASSERT_TRUE(solution.mechanism.has_value());
  expect_admissible(*solution.mechanism);
  ASSERT_EQ(solution.mechanism->bodies.size(), count);
  for (std::size_t b = 0; b < first_above; ++b) expect_at_rest(solution.mechanism->bodies[b]);
  for (std::size_t b = first_above; b < count; ++b) expect_slides(model, solution.mechanism->bodies[b]);
  EXPECT_EQ(solution.mechanism->moving(), static_cast<int>(count - first_above));
}

INSTANTIATE_TEST_SUITE_P(Units, MechanismIn,
                         testing::Values(std::pair(1.0, 0.0), std::pair(1e-3, 30.0), std::pair(1e3, -75.0)));

TEST(Mechanism, IsNotThereWhereBodiesAreHeld) {
  Upright model;
  model.add("floor", -2.0, -1.0, 8.0, 1.0, true);
  model.add("block", 0.0, 0.0, 2.0, 1.0);
  model.touch("floor.top", "block.bottom", 0.4);
  model.shake(0.399);
  const auto solution = model.solved();
  EXPECT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  EXPECT_FALSE(solution.mechanism.has_value());
}

// Friction 0.5 on the floor; a ceiling close above, that only a joint which opens as it slides would press against.
TEST(Mechanism, OfACollapseIsThatOfCoulombsLaw) {
  Upright model;
  model.add("floor", -2.0, -1.0, 8.0, 1.0, true);
  model.add("block", 0.0, 0.0, 4.0, 0.5);
  model.add("ceiling", -2.0, 0.501, 8.0, 1.0, true);
  model.touch("floor.top", "block.bottom", 0.5);
  model.touch("block.top", "ceiling.bottom", 0.5);
  const auto solution = run(fmt::format(
      "scabo: 1\nmaterials: {{m: {{young: 5e9, poisson: 0.2, density: 2000}}}}\nbodies:\n{}supports: [{{on: floor, "
      "fix: "
      "[x, y]}}, {{on: ceiling, fix: [x, y]}}]\nloads:\n  weight: {{gravity: [0, -9.81]}}\n  push: {{gravity: [9.81, "
      "0]}}\ncontacts:\n{}steps:\n  - {{name: weight, loads: {{weight: 1}}}}\n  - {{name: push, loads: {{weight: 1, "
      "push: 1}}}}\n",
      model.bodies, model.contacts));
  ASSERT_EQ(solution.outcome, analysis::Outcome::collapse) << solution.reason;
  ASSERT_TRUE(solution.mechanism.has_value());
  expect_admissible(*solution.mechanism);
  expect_slides(model, solution.mechanism->bodies[1]);
}

}  // namespace
}  // namespace scabo::verification
