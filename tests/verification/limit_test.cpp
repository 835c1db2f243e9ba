// Limit loads and factors of safety of a block, from equilibrium by hand: it slides when T = mu N, and turns over its
// corner when the moments of push and weight are equal.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "run.hpp"
#include "scabo/analysis/state/continuation.hpp"

namespace scabo::verification {
namespace {

/// 2 x 1 units of `length`, pressed down by a pressure of `force` per unit of length, N = 2, and pushed by the same
/// along x, T = 1. `sense`: -1 for a push on the other side.
std::string block(const std::string& steps, double mu = 0.3, double length = 1.0, double force = 1e6, int sense = 1) {
  return fmt::format(R"(
scabo: 1
materials: {{steel: {{young: {}, poisson: 0.3}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}}}
  block: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {{size: {}}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  down: {{on: block.top, pressure: {}}}
  push: {{on: block.{}, traction: [{}, 0]}}
contacts:
  base: {{between: [floor.top, block.bottom], friction: {}}}
steps:
{})",
                     2e5 * force, -length, -length, 4 * length, length, 2 * length, length, 0.25 * length, force,
                     sense > 0 ? "left" : "right", sense * force, mu, steps);
}

const std::string slide = "  - {name: down, loads: {down: 1}}\n  - {name: push, limit: {of: push, relative: 1e-4}}\n";

const analysis::Limit& limit_of(const analysis::StaticSolution& solution) {
  last(solution);  // the last equilibrium is solved and certified
  if (!solution.limit) throw std::runtime_error("no limit was looked for");
  return *solution.limit;
}

void expect_bracket(const analysis::StaticSolution& solution, double exact, double relative) {
  const analysis::Limit& limit = limit_of(solution);
  constexpr double rounding = 1e-9;
  EXPECT_LE(limit.solved, exact * (1.0 + rounding));
  EXPECT_GE(limit.beyond, exact * (1.0 - rounding));
  EXPECT_LE(limit.beyond - limit.solved, relative * limit.beyond);
  EXPECT_EQ(limit.outcome, analysis::Outcome::mechanism);
  ASSERT_TRUE(solution.mechanism);
  EXPECT_EQ(solution.mechanism->moving(), 1);
}

TEST(LimitLoad, BlockSlidesAtItsFriction) {
  const auto solution = run(block(slide));
  expect_bracket(solution, 0.6, 1e-4);
  // The last increment is the last equilibrium: friction is that of the factor.
  const analysis::ContactResult& base = contact_of(last(solution));
  EXPECT_NEAR(std::abs(base.tangential_force), limit_of(solution).solved * 1e6, 1e-3);
  EXPECT_NEAR(base.normal_force, 2e6, 1e-3);
}

TEST(LimitLoad, IsTheSameInOtherUnitsAndMirrored) {
  const analysis::Limit one = limit_of(run(block(slide)));
  const analysis::Limit small = limit_of(run(block(slide, 0.3, 1e-3, 1e12)));
  const analysis::Limit mirrored = limit_of(run(block(slide, 0.3, 1.0, 1e6, -1)));
  for (const analysis::Limit& other : {small, mirrored}) {
    EXPECT_NEAR(other.solved, one.solved, 1e-9);
    EXPECT_NEAR(other.beyond, one.beyond, 1e-9);
  }
}

TEST(LimitLoad, BlockTurnsOverItsCorner) {
  const auto solution = run(block(slide, 10.0));
  expect_bracket(solution, 4.0, 1e-4);
  EXPECT_NE(solution.mechanism->bodies[1].rotation, 0.0);
}

TEST(LimitLoad, BeginsWithTheFactorOfTheStepBefore) {
  expect_bracket(run(block("  - {name: down, loads: {down: 1, push: 0.5}}\n"
                           "  - {name: push, limit: {of: [push]}}\n")),
                 0.6, 1e-3);
}

TEST(LimitLoad, OfSeveralLoadsIsTheirCommonFactor) {
  // T / N = 0.5 at every factor, below the coefficient. So stiff a block does not deform under it.
  const std::string steps =
      "  - {name: both, loads: {down: 1, push: 1}}\n  - {name: more, limit: {of: [push, down]}}\n";
  const analysis::Limit limit = limit_of(run(block(steps, 1.0), {"materials.steel.young=2e20"}));
  EXPECT_TRUE(std::isinf(limit.beyond));
  EXPECT_GT(limit.solved, 1e6);
}

TEST(LimitLoad, WithoutFrictionIsZero) {
  const auto solution = run(block(slide, 0.0));
  EXPECT_EQ(limit_of(solution).solved, 0.0);
  EXPECT_LE(limit_of(solution).beyond, 1e-6);
}

TEST(ReducedFriction, GivesTheFactorOfSafetyAgainstSliding) {
  expect_bracket(run(block("  - {name: down, loads: {down: 1, push: 0.25}}\n"
                           "  - {name: weaker, reduce: {friction: base, relative: 1e-4}}\n")),
                 0.6 / 0.25, 1e-4);
}

TEST(ReducedFriction, StartsFromTheCoefficientsOfTheStepBefore) {
  expect_bracket(run(block("  - {name: down, loads: {down: 1, push: 0.25}}\n"
                           "  - {name: wet, friction: {base: 0.2}}\n"
                           "  - {name: weaker, reduce: {friction: [base]}}\n")),
                 0.4 / 0.25, 1e-3);
}

// Of (mu N + c A) / T, with mu N = 0.2, c A = 0.15 and T = 0.25 in the units of the block; alone, the other stays.
TEST(ReducedStrength, OfFrictionAndLastingCohesionGivesTheFactorOfSafety) {
  const auto safety = [](const std::string& reduced, int sense) {
    std::string model = block(fmt::format("  - {{name: down, loads: {{down: 1, push: 0.25}}}}\n"
                                          "  - {{name: weaker, reduce: {{{}, relative: 1e-4}}}}\n",
                                          reduced),
                              0.1, 1.0, 1e6, sense);
    return model.replace(model.find("friction: 0.1"), 13, "friction: 0.1, cohesion: {lasting: 7.5e4}");
  };
  for (const int sense : {1, -1}) {
    expect_bracket(run(safety("friction: base, cohesion: base", sense)), 0.35 / 0.25, 1e-4);
    expect_bracket(run(safety("friction: base", sense)), 0.2 / (0.25 - 0.15), 1e-4);
    expect_bracket(run(safety("cohesion: base", sense)), 0.15 / (0.25 - 0.2), 1e-4);
  }
}

TEST(LimitLoad, GoesOnFromAnyOfItsIncrements) {
  const model::Model model = input::parse_model(block(slide), "test.yaml", {});
  std::vector<analysis::Continuation> states;
  analysis::Options options;
  options.on_accepted = [&](const analysis::RunState& at, const analysis::StaticSolution& solution) {
    states.push_back({at, solution.increments, solution.warnings, {}});
    for (analysis::IncrementResult& increment : states.back().increments) {
      increment.fields = {};
      for (analysis::ContactResult& contact : increment.contacts) contact.pairs = {};
    }
  };
  const auto whole = analysis::solve_static(model, options);
  ASSERT_GT(states.size(), 3u);
  for (const std::size_t k : {std::size_t{0}, states.size() / 2, states.size() - 1}) {
    analysis::Options again;
    again.from = &states[k];
    const auto rest = analysis::solve_static(model, again);
    ASSERT_TRUE(rest.limit);
    EXPECT_EQ(rest.limit->solved, whole.limit->solved);
    EXPECT_EQ(rest.limit->beyond, whole.limit->beyond);
    EXPECT_EQ(rest.increments.size(), whole.increments.size());
  }
}

}  // namespace
}  // namespace scabo::verification
