// An increment that does not converge is tried again by halves: the parts of the way that were tried, on a joint for
// which there are no forces beyond a part of the way that is known.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// A bar whose end, cut at 45 degrees, can only move along the bar (x), and a rigid wall that comes nearer by c =
/// 0.02 / sqrt(2) along the normal while it moves along its face, which drags the end towards it. With mu tan(45) > 1
/// friction draws the end in by more than pressure pushes it back: the pairs jam, and there are no forces at all, once
/// the wall is there, at `closed_at` of its way.
std::string self_locking_bar(double closed_at) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e6, poisson: 0.2}}}}
bodies:
  bar: {{material: m, shape: {{polygon: {{vertices: [[0, 0], [2, 0], [3, 1], [0, 1]]}}}}, mesh: {{size: 2, order: 1}}}}
  wall: {{rigid: true, shape: {{polygon: {{vertices: [[1, -1], [5, -1], [5, 3]]}}}}}}
supports:
  - {{on: bar.edge_4, fix: [x, y]}}
  - {{on: bar.edge_2, fix: y}}
  - {{on: wall, displacement: [0.03, 0.05]}}
contacts: {{joint: {{between: [bar.edge_2, wall.edge_3], friction: 1.5, gap: {:.17g}}}}}
)",
                     closed_at * 0.02 / std::numbers::sqrt2);
}

struct Jam {
  analysis::StaticSolution solution;
  std::vector<double> tried;  // part of the way of every attempt: q_n = gap - part c
  std::vector<bool> accepted;
};

Jam jam(double closed_at, int halvings) {
  Jam result;
  analysis::Options options;
  options.on_problems = [&](const analysis::IncrementResult&, const std::vector<analysis::DiscreteProblem>& problems) {
    for (const analysis::DiscreteProblem& discrete : problems) {
      EXPECT_EQ(discrete.problem.pairs(), 2);
      result.tried.push_back(closed_at - discrete.problem.q[0] / (0.02 / std::numbers::sqrt2));
      result.accepted.push_back(discrete.accepted);
    }
  };
  result.solution =
      analysis::solve_static(input::parse_model(self_locking_bar(closed_at), "test.yaml",
                                                {input::parse_override(fmt::format("solver.halvings={}", halvings))}),
                             options);
  return result;
}

void expect_path(const Jam& jam, const std::vector<double>& tried, double closed_at) {
  ASSERT_EQ(jam.tried.size(), tried.size());
  for (std::size_t k = 0; k < tried.size(); ++k) {
    EXPECT_NEAR(jam.tried[k], tried[k], 1e-12) << "attempt " << k + 1;
    EXPECT_EQ(jam.accepted[k], tried[k] < closed_at) << "attempt " << k + 1;
  }
}

// From every part that was reached the next one is as long as the last that failed, halved.
TEST(Halving, TriesHalvesOfTheWayFromTheLastAcceptedPart) {
  const Jam six = jam(0.7, 6);
  EXPECT_EQ(six.solution.outcome, analysis::Outcome::not_converged);
  expect_path(six, {1.0, 0.5, 1.0, 0.75, 0.625, 0.75, 0.6875, 0.75, 0.71875, 0.703125}, 0.7);
  ASSERT_EQ(six.solution.increments.size(), 1u);
  EXPECT_FALSE(six.solution.increments.at(0).converged);
  EXPECT_EQ(six.solution.increments.at(0).halvings, 6);
  EXPECT_EQ(six.solution.increments.at(0).attempts.size(), 10u);
  EXPECT_NE(six.solution.reason.find("after 6 halvings"), std::string::npos) << six.solution.reason;
  EXPECT_NE(six.solution.reason.find("the problem has no solution"), std::string::npos) << six.solution.reason;
}

TEST(Halving, IsDoneAsOftenAsAllowed) {
  expect_path(jam(0.1, 0), {1.0}, 0.1);
  expect_path(jam(0.1, 1), {1.0, 0.5}, 0.1);
  expect_path(jam(0.1, 4), {1.0, 0.5, 0.25, 0.125, 0.0625, 0.125}, 0.1);
}

/// Two blocks with a joint on a floor, and a push. With a single iteration nothing converges.
std::string blocks(const std::string& contacts, const std::string& steps) {
  return fmt::format(R"(
scabo: 1
materials: {{stone: {{young: 5e9, poisson: 0.2, density: 2000}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [3, 1]}}}}}}
  lower: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {{size: 0.25, order: 1}}}}
  upper: {{material: stone, shape: {{rectangle: {{corner: [0, 1], size: [1, 1]}}}}, mesh: {{size: 0.25, order: 1}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  weight: {{gravity: 9.81}}
  push: {{on: upper.left, traction: [6e3, 0]}}
contacts:
  foot: {{between: [floor.top, lower.bottom], friction: 0.6}}
  joint: {{between: [lower.top, upper.bottom], {}}}
solver: {{iterations: 1, halvings: 3}}
steps: [{}]
)",
                     contacts, steps);
}

// All loads at once from nothing: half of them are the same problem, with half of all forces and motions.
TEST(Halving, IsNotDoneWhereSmallerPartsAreTheSameProblem) {
  const auto halvings = [](const std::string& contacts, const std::string& steps) {
    const auto solution = run(blocks(contacts, steps));
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged) << contacts << steps;
    const int done = solution.increments.back().halvings;
    EXPECT_EQ(solution.reason.find("the same problem, scaled") != std::string::npos, done == 0) << solution.reason;
    return done;
  };
  const std::string together = "{loads: {weight: 1, push: 1}}";
  EXPECT_EQ(halvings("friction: 0.6", together), 0);
  EXPECT_EQ(halvings("friction: {forward: 0.6, backward: 0.5}", together), 0);
  // Lengths and strengths, which loads do not scale; and friction that changes.
  EXPECT_EQ(halvings("friction: 0.6, gap: 1e-9", together), 3);
  EXPECT_EQ(halvings("friction: 0.6, cohesion: 1, tensile_strength: 1", together), 3);
  EXPECT_EQ(halvings("friction: 0.6", "{loads: {weight: 1, push: 1}, friction: {joint: 0.3}}"), 3);
}

// Where the wall stops short of the bar nothing is halved.
TEST(Halving, IsNotDoneWhereTheWholeWayConverges) {
  const Jam free = jam(1.1, 6);
  EXPECT_EQ(last(free.solution).contacts.front().open, 2);
  expect_path(free, {1.0}, 1.1);
}

}  // namespace
}  // namespace scabo::verification
