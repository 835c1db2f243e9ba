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
std::string self_locking_bar(double closed_at, const std::string& law) {
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
contacts: {{joint: {{between: [bar.edge_2, wall.edge_3], {}, gap: {:.17g}}}}}
)",
                     law, closed_at * 0.02 / std::numbers::sqrt2);
}

struct Jam {
  analysis::StaticSolution solution;
  std::vector<double> tried;  // part of the way of every attempt: q_n = gap - part c
  std::vector<bool> accepted;
};

Jam jam(double closed_at, int halvings, const std::string& law = "friction: 1.5") {
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
      analysis::solve_static(input::parse_model(self_locking_bar(closed_at, law), "test.yaml",
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

// Without a gap, half of the way is the same problem with half of all forces and motions: it is not tried. A gap and
// strengths are lengths and stresses that the way does not scale.
TEST(Halving, IsNotDoneWhereSmallerPartsAreTheSameProblem) {
  for (const std::string law : {"friction: 1.5", "friction: {forward: 1.5, backward: 1.6}"}) {
    const Jam same = jam(0.0, 4, law);
    expect_path(same, {1.0}, 0.0);
    EXPECT_EQ(same.solution.outcome, analysis::Outcome::not_converged) << law;
    EXPECT_NE(same.solution.reason.find("the same problem, scaled"), std::string::npos) << same.solution.reason;
  }
  expect_path(jam(1e-6, 3), {1.0, 0.5, 0.25, 0.125}, 1e-6);
  const Jam strong = jam(0.0, 3, "friction: 1.5, cohesion: 1e-3, tension: 1e-4");
  expect_path(strong, {1.0, 0.5, 0.25, 0.125}, 0.0);
  EXPECT_EQ(strong.solution.reason.find("the same problem, scaled"), std::string::npos) << strong.solution.reason;
}

// Where the wall stops short of the bar nothing is halved.
TEST(Halving, IsNotDoneWhereTheWholeWayConverges) {
  const Jam free = jam(1.1, 6);
  EXPECT_EQ(last(free.solution).contacts.front().open, 2);
  expect_path(free, {1.0}, 1.1);
}

}  // namespace
}  // namespace scabo::verification
