// More than two thousand random problems: each is solved and certified, or rightly called a mechanism. Seeds
// are fixed.
#include <gtest/gtest.h>

#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/linalg/nonnegative_least_squares.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

struct Tally {
  int problems = 0, solved = 0, mechanisms = 0, worst = 0;
  long iterations = 0;

  void add(const Solution& solution) {
    ++problems;
    solved += solution.status == Status::solved;
    mechanisms += solution.status == Status::mechanism;
    if (solution.status != Status::solved) return;
    iterations += solution.iterations;
    worst = std::max(worst, solution.iterations);
  }
  ~Tally() {
    testing::Test::RecordProperty("problems", problems);
    testing::Test::RecordProperty("solved", solved);
    testing::Test::RecordProperty("mechanisms", mechanisms);
    testing::Test::RecordProperty("iterations, mean",
                                  testing::PrintToString(static_cast<double>(iterations) / std::max(1, solved)));
    testing::Test::RecordProperty("iterations, worst", worst);
  }
};

/// No forces in the friction cones balance f: a motion that f drives and that no extreme ray of a cone
/// resists (Farkas).
bool cannot_be_balanced(const Problem& problem) {
  const Eigen::Index N = problem.pairs();
  Matrix rays(problem.G.cols(), 2 * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    rays.col(2 * i) = (problem.G.dense().row(2 * i) + problem.mu[i] * problem.G.dense().row(2 * i + 1)).transpose();
    rays.col(2 * i + 1) = (problem.G.dense().row(2 * i) - problem.mu[i] * problem.G.dense().row(2 * i + 1)).transpose();
  }
  const Vector v = problem.f + rays * linalg::nonnegative_least_squares(rays, -problem.f);
  return problem.f.dot(v) > 1e-12 * problem.f.squaredNorm() && (rays.transpose() * v).minCoeff() >= -1e-10 * v.norm();
}

void expect_solved_or_mechanism(const Problem& problem, Tally& tally, int k) {
  const Solution solution = solve(problem);
  tally.add(solution);
  switch (solution.status) {
    case Status::solved:
      EXPECT_LT(solution.certificate.worst(), 1e-10) << "problem " << k;
      EXPECT_LT(violation(problem, solution.p, solution.a), 1e-8) << "problem " << k;
      break;
    case Status::mechanism:
      EXPECT_TRUE(cannot_be_balanced(problem)) << "problem " << k;
      EXPECT_GT(problem.f.dot(solution.motion), 0.0) << "problem " << k;
      for (Eigen::Index i = 0; i < problem.pairs(); ++i)  // it presses no gap shut
        EXPECT_GE(problem.G.dense().row(2 * i).dot(solution.motion), -1e-9) << "problem " << k;
      break;
    case Status::not_converged:
    case Status::collapse:
    case Status::infeasible:
      ADD_FAILURE() << "problem " << k << ", " << problem.pairs() << " pairs, mu " << problem.mu[0] << ", "
                    << problem.G.cols() << " rigid motions: " << solution.reason << " after " << solution.iterations;
      break;
  }
  EXPECT_LE(solution.trace.size(), 5000u) << "problem " << k;
}

TEST(RandomProblems, HeldBodies) {
  std::mt19937 random(51);
  Tally tally;
  for (int k = 0; k < 1000; ++k) expect_solved_or_mechanism(held_problem(random, whole(random, 4, 40), 1.0), tally, k);
}

TEST(RandomProblems, FloatingBodies) {
  std::mt19937 random(52);
  Tally tally;
  for (int k = 0; k < 800; ++k)
    expect_solved_or_mechanism(floating_problem(random, whole(random, 4, 40), 1.0), tally, k);
}

// Friction of a few percent: rigid motions that it barely holds.
TEST(RandomProblems, FloatingBodiesOnSlipperyFloors) {
  std::mt19937 random(55);
  Tally tally;
  for (int k = 0; k < 400; ++k)
    expect_solved_or_mechanism(floating_problem(random, whole(random, 4, 40), 0.05), tally, k);
}

// All gaps and slips zero, or all forces of the floating body zero: every pair on a kink.
TEST(RandomProblems, TiesEverywhere) {
  std::mt19937 random(53);
  Tally tally;
  for (int k = 0; k < 200; ++k) {
    const int pairs = whole(random, 4, 40);
    Problem problem = k % 2 == 0 ? held_problem(random, pairs, 1.0) : floating_problem(random, pairs, 1.0);
    for (double& motion : problem.q) motion = static_cast<double>(whole(random, -1, 1));
    if (k % 4 == 0) problem.q.setZero();
    if (k % 8 == 1) problem.f.setZero(), problem.q = problem.q.cwiseAbs();
    expect_solved_or_mechanism(problem, tally, k);
  }
}

// One load path in twenty increments with its history: slip so far counts, forces are the next start.
TEST(RandomProblems, IncrementsFromTheLastAcceptedState) {
  std::mt19937 random(54);
  Tally tally;
  for (int k = 0; k < 20; ++k) {
    const int pairs = whole(random, 4, 30);
    Problem problem = held_problem(random, pairs, 0.8);
    const Vector from = mixed_motion(random, pairs), to = mixed_motion(random, pairs);
    Vector slip = Vector::Zero(pairs);
    Start start;
    for (int increment = 1; increment <= 20; ++increment) {
      const double angle = 0.3 * increment;
      problem.q = 0.1 * increment * (std::cos(angle) * from + std::sin(angle) * to);
      for (int i = 0; i < pairs; ++i) problem.q[2 * i + 1] -= slip[i];
      const Solution solution = solve(problem, start);
      tally.add(solution);
      ASSERT_EQ(solution.status, Status::solved)
          << "path " << k << ", increment " << increment << ": " << solution.reason;
      EXPECT_LT(violation(problem, solution.p, solution.a), 1e-8);
      slip += solution.slip_increment;
      start.p = solution.p;
    }
  }
}

}  // namespace
}  // namespace scabo::contact
