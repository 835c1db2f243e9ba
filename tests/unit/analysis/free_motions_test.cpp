// Motions of the pairs without contact forces, kept from increment to increment: a run that keeps them against single
// attempts, which solve for the displacements of all loads and supports together.
#include "scabo/analysis/free_motions.hpp"

#include <gtest/gtest.h>

#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::analysis {
namespace {

/// A block pressed onto another and then pushed, its weight lifted, while the lower one is moved.
std::string blocks(const std::string& steps) {
  return "scabo: 1\n"
         "materials: {rock: {young: 1e9, poisson: 0.25, density: 2000}}\n"
         "bodies:\n"
         "  lower: {material: rock, shape: {rectangle: {corner: [0, 0], size: [3, 1]}}, mesh: {size: 0.25}}\n"
         "  upper: {material: rock, shape: {rectangle: {corner: [1, 1], size: [1, 1]}}, mesh: {size: 0.25}}\n"
         "supports:\n"
         "  - {on: lower.bottom, displacement: [1e-5, 2e-5], name: shift}\n"
         "loads:\n"
         "  down: {on: upper.top, pressure: 1e5}\n"
         "  push: {on: upper.left, traction: [2e4, 0]}\n"
         "contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.6}}\n" +
         steps;
}

Vector pair_forces(const StaticSolution& solution) {
  const ContactResult& contact = solution.increments.back().contacts.front();
  Vector forces(static_cast<Eigen::Index>(2 * contact.pairs.size()));
  for (std::size_t i = 0; i < contact.pairs.size(); ++i) {
    forces[static_cast<Eigen::Index>(2 * i)] = contact.pairs[i].normal_force;
    forces[static_cast<Eigen::Index>(2 * i + 1)] = contact.pairs[i].tangential_force;
  }
  return forces;
}

const char* const in_one =
    "steps:\n"
    "  - {loads: {down: 1, push: 0.5, shift: 1}}\n"
    "  - {loads: {down: 0.7, push: 1, shift: 2}}\n";

/// Two increments and three groups: nothing is kept.
TEST(FreeMotions, AreKeptWhereThereAreMoreIncrementsThanGroups) {
  EXPECT_EQ(free_motions_worth_keeping(input::parse_model(blocks(in_one), "model.yaml")), nullptr);
  const auto kept = free_motions_worth_keeping(
      input::parse_model(blocks("steps: [{increments: 3, loads: {down: 1, push: 1}}]\n"), "model.yaml"));
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(kept->groups(), 2u);  // the loads, which grow together, and the support, whose factor stays 0
}

/// Each step in one increment, or divided once more (curves keep the way the same): the forces are those of the history,
/// which in increments of the same ends is the same whether motions are kept or not.
TEST(FreeMotions, GiveTheForcesOfDisplacementsOfAllLoadsTogether) {
  const std::string again =  // the state stays: further increments, so that motions are kept
      "  - {increments: 4, loads: {down: 0.7, push: 1, shift: 2}}\n";
  const auto model = input::parse_model(blocks(in_one), "model.yaml"),
             longer = input::parse_model(blocks(in_one + again), "model.yaml");
  ASSERT_EQ(free_motions_worth_keeping(model), nullptr);
  ASSERT_NE(free_motions_worth_keeping(longer), nullptr);
  const StaticSolution direct = solve_static(model), kept = solve_static(longer);
  ASSERT_EQ(direct.outcome, Outcome::solved) << direct.reason;
  ASSERT_EQ(kept.outcome, Outcome::solved) << kept.reason;
  const Vector expected = pair_forces(direct), forces = pair_forces(kept);
  EXPECT_GT(expected.lpNorm<Eigen::Infinity>(), 1e3);
  EXPECT_LT((forces - expected).lpNorm<Eigen::Infinity>(), 1e-9 * expected.lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(kept.increments[1].energy.external, direct.increments[1].energy.external,
              1e-9 * direct.increments[1].energy.external);
}

}  // namespace
}  // namespace scabo::analysis
