// Every solver names the problems that it does not handle, and it always ends.
#include <gtest/gtest.h>

#include "compare/trial_and_error.hpp"
#include "problems.hpp"

namespace scabo::test {
namespace {

/// The gap cannot be closed: the pair's own motion per force is none.
Problem unsolvable(int dimension) {
  return one_pair(Matrix::Zero(dimension, dimension), -Vector::Ones(dimension), 0.5);
}

/// mu above W_tt / |W_tn|: one pair with several solutions or none (Klarbring, Eur. J. Mech. A 9 (1990) 53).
Problem coupled(double q_t) {
  Matrix W(2, 2);
  W << 1.0, 0.8, 0.8, 1.0;
  return one_pair(W, Vec2(-1.0, q_t), 2.0);
}

TEST(OtherSolvers, SayWhyWhereNothingSolves) {
  for (int dimension : {2, 3})
    for (Method method : frictional_methods(dimension)) {
      const Solution solution = compare::solve_with(method, unsolvable(dimension));
      EXPECT_NE(solution.status, Status::solved) << compare::method_name(method);
      EXPECT_FALSE(solution.reason.empty()) << compare::method_name(method);
    }
  Problem frictionless = unsolvable(2);
  frictionless.mu.setZero();
  const Solution solution = compare::solve_with(Method::quadratic_programme, frictionless);
  EXPECT_EQ(solution.reason, "quadratic_programme: no forces can close the gaps");
}

TEST(OtherSolvers, NeverCertifyWhatIsNot) {
  for (double q_t : {-3.0, -1.0, -0.8, 0.0, 0.5, 3.0})
    for (Method method : frictional_methods(2)) {
      const Problem problem = coupled(q_t);
      const Solution solution = compare::solve_with(method, problem);
      if (solution.status != Status::solved) continue;
      const Vector u = problem.q + problem.W.times(solution.p);
      EXPECT_GE(u[0], -1e-9);
      EXPECT_LE(std::abs(solution.p[1]), 2.0 * solution.p[0] + 1e-9);
      EXPECT_LT(std::abs(u[0] * solution.p[0]), 1e-9);
      EXPECT_LT(u[1] * solution.p[1], 1e-9);
    }
}

TEST(OtherSolvers, RefuseWhatTheyDoNotHandle) {
  std::mt19937 random(3);
  const auto reason = [](Method method, const Problem& problem) {
    const Solution solution = compare::solve_with(method, problem);
    EXPECT_EQ(solution.status, Status::not_converged);
    return solution.reason;
  };
  const Problem space = elastic_problem(random, 3, 3, 0.3);
  EXPECT_EQ(reason(Method::lemke, space), "lemke does not handle problems in space");
  EXPECT_EQ(reason(Method::quadratic_programme, space), "quadratic_programme does not handle friction: mu must be 0");
  Problem strong = elastic_problem(random, 2, 3, 0.3);
  strong.cohesion = Vector::Ones(3);
  EXPECT_EQ(reason(Method::gauss_seidel, strong), "gauss_seidel does not handle cohesion and tension");
  Problem floating = elastic_problem(random, 2, 3, 0.3);
  floating.G = Vector{{1.0, 0.0, 1.0, 0.0, 1.0, 0.0}};
  floating.f = Vector::Constant(1, -1.0);
  EXPECT_EQ(reason(Method::lemke, floating), "lemke does not handle rigid motions that contact alone holds");
}

TEST(OtherSolvers, RefuseWhatIsTooLargeForDenseMatrices) {
  const int N = 3500;
  Eigen::SparseMatrix<double> W(2 * N, 2 * N);
  W.setIdentity();
  Problem problem = one_pair(Matrix::Identity(2, 2), Vec2(-1.0, 0.2), 0.3);
  problem.W = contact::Delassus(W);
  problem.q = Vec2(-1.0, 0.2).replicate(N, 1);
  problem.mu = Vector::Constant(N, 0.3);
  problem.G.resize(2 * N, 0);
  const Solution refused = compare::solve_with(Method::lemke, problem);
  EXPECT_EQ(refused.reason,
            "lemke does not handle more than 3000 contact unknowns (its matrices are dense), here 7000");
  const Solution swept = compare::solve_with(Method::gauss_seidel, problem);  // needs none
  EXPECT_EQ(swept.status, Status::solved);
  EXPECT_LT((swept.p - Vec2(1.0, -0.2).replicate(N, 1)).norm(), 1e-9);
}

TEST(TrialAndError, SaysThatItGoesAround) {
  // Two solutions and none of them where the corrections lead: found by search over coupled pairs.
  std::mt19937 random(1);
  int around = 0;
  for (int k = 0; k < 200; ++k) {
    const Problem problem = elastic_problem(random, 2, 6, 3.0);
    const Solution solution = compare::solve_with(Method::trial_and_error, problem);
    if (solution.status == Status::solved) continue;
    EXPECT_LE(solution.iterations, 200);
    around += solution.reason.find("iterations cycle") != std::string::npos;
  }
  EXPECT_GT(around, 0);
}

TEST(OtherSolvers, EndWithinTheirLimit) {
  std::mt19937 random(2);
  contact::SolverOptions few;
  few.iterations = 1;
  few.tolerance = 1e-15;
  const Problem problem = elastic_problem(random, 3, 8, 0.8);
  for (Method method : frictional_methods(3)) {
    const Solution solution = compare::solve_with(method, problem, {}, few);
    EXPECT_EQ(solution.status == Status::solved, solution.certificate.worst() <= few.tolerance);
    EXPECT_EQ(solution.status == Status::solved, solution.reason.empty()) << compare::method_name(method);
  }
}

}  // namespace
}  // namespace scabo::test
