// What must never happen (the list is in docs/methods/12_contact_solver.md, with the tests of its other entries).
#include <gtest/gtest.h>

#include "scabo/contact/newton/newton.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

// 1. Iterations that flip between two states for ever.
TEST(MustNever, FlipBetweenTwoStatesForEver) {
  std::mt19937 random(81);
  for (int k = 0; k < 300; ++k) {
    const Problem problem = held_problem(random, whole(random, 2, 12), 4.0, 2 + k % 2);
    const Solution solution = solve(problem);
    if (solution.status != Status::solved) {
      EXPECT_GT(problem.mu[0], 1.0) << "problem " << k;
      EXPECT_FALSE(solution.reason.empty());
    }
    EXPECT_LE(solution.trace.size(), 3000u) << "problem " << k;
    for (std::size_t i = 1; i < solution.trace.size(); ++i) {  // where steps are searched, the largest of six falls
      const Iteration& now = solution.trace[i];
      if (now.stage.find("newton") == std::string::npos || now.step_length >= 1.0 || now.step_length <= 0.0) continue;
      double largest = 0.0;
      for (std::size_t j = i; j-- > 0 && i - j <= 6 && solution.trace[j].stage == now.stage;)
        largest = std::max(largest, solution.trace[j].merit);
      EXPECT_LE(now.merit, largest * (1.0 + 1e-12)) << "problem " << k;
    }
  }
}

// 2. A penalty stiffness the user must tune: r over six decades, one answer.
TEST(MustNever, NeedAStiffnessThatTheUserTunes) {
  std::mt19937 random(82);
  for (int k = 0; k < 20; ++k) {
    const Problem problem = held_problem(random, 10, 0.3, 2 + k % 2);
    const Solution reference = solve(problem);
    ASSERT_EQ(reference.status, Status::solved);
    for (double factor : {1e-3, 1e-2, 0.1, 10.0, 1e2, 1e3}) {
      SolverOptions options;
      options.r_factor = factor;
      const Solution solution = solve(problem, {}, options);
      ASSERT_EQ(solution.status, Status::solved) << "problem " << k << ", r times " << factor;
      EXPECT_LT((solution.p - reference.p).cwiseAbs().maxCoeff(), 1e-8 * (1.0 + reference.p.cwiseAbs().maxCoeff()))
          << "problem " << k << ", r times " << factor;
    }
  }
}

// 3. Convergence that changes with units.
TEST(MustNever, ConvergeOtherwiseInOtherUnits) {
  std::mt19937 random(83);
  for (int k = 0; k < 30; ++k) {
    const Problem problem = held_problem(random, 8, 0.8, 2 + k % 2);
    const Solution reference = solve(problem);
    for (const auto& [flexibility, force] : {std::pair(1e-10, 1e6), std::pair(1e9, 1e-3)}) {
      Problem other = problem;
      other.W = problem.W.scaled(flexibility);
      other.q *= flexibility * force;
      const Solution solution = solve(other);
      EXPECT_EQ(solution.status, reference.status);
      EXPECT_EQ(solution.iterations, reference.iterations) << "problem " << k;
      EXPECT_LT((solution.p / force - reference.p).cwiseAbs().maxCoeff(),
                1e-9 * (1.0 + reference.p.cwiseAbs().maxCoeff()));
    }
  }
}

// 5. A singular matrix where bodies touch at zero force.
TEST(MustNever, FailWhereBodiesTouchAtZeroForce) {
  std::mt19937 random(85);
  for (int d : {2, 3})
    for (int k = 0; k < 20; ++k) {
      Problem problem = held_problem(random, 6, 0.9, d);
      problem.q.setZero();
      const Solution touching = solve(problem);
      ASSERT_EQ(touching.status, Status::solved);
      EXPECT_EQ(touching.p, Vector(Vector::Zero(6 * d)));
      for (int i = 0; i < 3; ++i) problem.q[d * i] = -1.0;  // some pressed, some touching
      EXPECT_EQ(solve(problem).status, Status::solved) << "problem " << k;
      // Pressed and let go again: the state of before must not stay.
      const Solution pressed = solve(problem);
      problem.q.setZero();
      const Solution released = solve(problem, {pressed.p, Vector()});
      ASSERT_EQ(released.status, Status::solved);
      EXPECT_LT(released.p.cwiseAbs().maxCoeff(), 1e-9);
    }
}

// 9. A status that is always 0: what is not solved says so.
TEST(MustNever, CallSolvedWhatIsNot) {
  std::mt19937 random(89);
  for (int d : {2, 3}) {
    Problem problem = held_problem(random, 12, 0.9, d);
    problem.q.array() -= 0.5;
    problem.mu.setConstant(0.7);
    for (Judge judge : {Judge::certificate, Judge::natural_map}) {
      SolverOptions options;
      options.judge = judge;
      options.tolerance = 1e-30;  // out of reach of rounding
      const Solution solution = solve(problem, {}, options);
      EXPECT_EQ(solution.status, Status::not_converged);
      EXPECT_FALSE(solution.reason.empty());
      EXPECT_LT(solution.natural_map_residual, 1e-10);  // the best point is handed back all the same
    }
  }
}

// 9. The natural map knows pairs only: at rest without force it is zero, whatever presses on the body.
TEST(MustNever, CallSolvedWhatLeavesABodyOutOfBalance) {
  for (int d : {2, 3}) {
    Problem problem;
    problem.dimension = d;
    problem.W = Matrix(Matrix::Identity(d, d));
    problem.q = Vector::Zero(d);
    problem.mu = Vector::Constant(1, 0.3);
    problem.G = Vector::Unit(d, 0);
    problem.f = Vector::Constant(1, -2.0);
    SolverOptions options;
    options.judge = Judge::natural_map;
    ASSERT_EQ(natural_map_residual(problem, Vector::Zero(d), Vector::Zero(1)), 0.0);
    const Solution solution = solve(problem, {}, options);
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    EXPECT_NEAR(solution.p[0], 2.0, 1e-9);
    EXPECT_LE(solution.certificate.rigid_balance, options.tolerance);
  }
}

}  // namespace
}  // namespace scabo::contact
