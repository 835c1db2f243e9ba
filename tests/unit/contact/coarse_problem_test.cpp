// The problem of half as many pairs: what Galerkin and the weakest member's law promise, and where it must
// change nothing.
#include "scabo/contact/newton/coarse_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scabo/contact/newton/coarse_start.hpp"
#include "scabo/contact/solve.hpp"
#include "support/decompositions.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

/// Neighbours along a joint couple most: W = K (x) C, K_ij = exp(-|i - j| / reach), C of one pair.
Matrix joint_flexibility(int pairs, double reach = 6.0) {
  Matrix W(2 * pairs, 2 * pairs);
  const Matrix of_pair = (Matrix(2, 2) << 1.0, 0.2, 0.2, 0.9).finished();
  for (int i = 0; i < pairs; ++i)
    for (int j = 0; j < pairs; ++j) W.block(2 * i, 2 * j, 2, 2) = std::exp(-std::abs(i - j) / reach) * of_pair;
  return W;
}

Problem joint(std::mt19937& random, int pairs, double friction) {
  Problem problem;
  problem.W = joint_flexibility(pairs);
  problem.q = mixed_motion(random, pairs);
  problem.mu = Vector::Constant(pairs, friction);
  problem.G.resize(2 * pairs, 0);
  return problem;
}

Vector random_forces(std::mt19937& random, Eigen::Index size) {
  return Vector::NullaryExpr(size, [&] { return uniform(random, -1.0, 1.0); });
}

TEST(CoarseProblem, FlexibilityIsThatOfTheProlongedForces) {
  std::mt19937 random(1);
  Problem problem = held_problem(random, 30, 1.0);
  const CoarseProblem coarse = coarse_problem(problem);
  const Matrix& W = coarse.problem.W.dense();
  EXPECT_LT((W - W.transpose()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GT(symmetric_eigenvalues(W).minCoeff(), 0.0);
  for (int k = 0; k < 10; ++k) {
    const Vector p = random_forces(random, W.rows()), fine = coarse.prolong(p);
    EXPECT_NEAR(p.dot(W * p), fine.dot(problem.W * fine), 1e-12);
    EXPECT_NEAR(p.dot(coarse.problem.q), fine.dot(problem.q), 1e-12);
  }
}

TEST(CoarseProblem, ProlongedForcesKeepTheirSumAndTheBalanceOfRigidMotions) {
  std::mt19937 random(2);
  const Problem problem = floating_problem(random, 31, 1.0);
  const CoarseProblem coarse = coarse_problem(problem);
  const Vector p = random_forces(random, coarse.problem.q.size()), fine = coarse.prolong(p);
  EXPECT_LT((coarse.problem.G.transpose() * p - problem.G.transpose() * fine).norm(), 1e-13);
  EXPECT_EQ(coarse.problem.f, problem.f);
  for (int k : {0, 1}) {
    double sum = 0.0, fine_sum = 0.0;
    for (Eigen::Index i = k; i < p.size(); i += 2) sum += p[i];
    for (Eigen::Index i = k; i < fine.size(); i += 2) fine_sum += fine[i];
    EXPECT_NEAR(sum, fine_sum, 1e-13);
  }
}

TEST(CoarseProblem, ForcesWithinTheLawsOfTheGroupsAreWithinThoseOfThePairs) {
  std::mt19937 random(3);
  Problem problem = joint(random, 41, 0.0);
  problem.mu = random_forces(random, 41).cwiseAbs();
  problem.cohesion = random_forces(random, 41).cwiseAbs();
  problem.tension = random_forces(random, 41).cwiseAbs();
  const CoarseProblem coarse = coarse_problem(problem);
  for (int k = 0; k < 100; ++k) {
    Vector p(coarse.problem.q.size());  // on the boundary, or on the tip
    for (Eigen::Index i = 0; i < coarse.problem.pairs(); ++i) {
      p[2 * i] = std::max(uniform(random, -2.0, 2.0), -coarse.problem.tension[i]);
      const double side = whole(random, 0, 1) == 0 ? 1.0 : -1.0;
      p[2 * i + 1] = side * coarse.problem.friction_bound(i, p[2 * i], side);
    }
    const Vector fine = coarse.prolong(p);
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
      EXPECT_GE(fine[2 * i], -problem.tension[i] - 1e-14);
      EXPECT_LE(std::abs(fine[2 * i + 1]), problem.friction_bound(i, fine[2 * i], fine[2 * i + 1]) + 1e-14);
    }
  }
}

/// q is made such that the members of a group move as one under the forces of the coarse solution.
TEST(CoarseProblem, IsExactWhereForcesAndMotionsAreThoseOfGroups) {
  std::mt19937 random(4);
  for (double friction : {0.0, 0.3, 1.0}) {
    Problem problem = joint(random, 40, friction);
    const CoarseProblem before = coarse_problem(problem);
    const Solution of_groups = solve(before.problem);
    ASSERT_EQ(of_groups.status, Status::solved);
    const Vector p = before.prolong(of_groups.p), motion = before.problem.q + before.problem.W * of_groups.p;
    for (Eigen::Index i = 0; i < problem.pairs(); ++i)
      problem.q.segment<2>(2 * i) = motion.segment<2>(2 * before.group[static_cast<std::size_t>(i)]);
    problem.q -= problem.W * p;
    const CoarseProblem coarse = coarse_problem(problem);
    EXPECT_LT((coarse.problem.q - before.problem.q).norm(), 1e-13);
    EXPECT_LT(violation(problem, coarse.prolong(solve(coarse.problem).p), Vector()), 1e-9) << "mu " << friction;
  }
}

TEST(CoarseProblem, NeighboursShareAGroupAndTheOddOneStaysAlone) {
  std::mt19937 random(5);
  const CoarseProblem coarse = coarse_problem(joint(random, 9, 0.5));
  EXPECT_EQ(coarse.group, (std::vector<int>{0, 0, 1, 1, 2, 2, 3, 3, 4}));
  EXPECT_EQ(coarse.share[7], 0.5);
  EXPECT_EQ(coarse.share[8], 1.0);
}

TEST(CoarseProblem, GroupsAreNeighboursWhateverTheOrderOfPairs) {
  std::mt19937 random(6);
  const int pairs = 20;
  Problem problem = joint(random, pairs, 0.5);
  Eigen::VectorXi order(2 * pairs);  // every third pair first
  for (int i = 0; i < pairs; ++i)
    for (int k : {0, 1}) order[2 * i + k] = 2 * (7 * i % pairs) + k;
  problem.W = Matrix(problem.W.dense()(order, order));
  const CoarseProblem coarse = coarse_problem(problem);
  for (int i = 0; i < pairs; ++i)
    for (int j = 0; j < i; ++j)
      if (coarse.group[static_cast<std::size_t>(i)] == coarse.group[static_cast<std::size_t>(j)]) {
        EXPECT_LE(std::abs(order[2 * i] - order[2 * j]), 4);
      }
}

TEST(CoarseProblem, PairsThatAreNotCoupledAndBondedOnesAmongOthersStayAlone) {
  std::mt19937 random(7);
  Problem problem = joint(random, 8, 0.5);
  problem.tension = Vector::Zero(8);
  problem.tension[3] = HUGE_VAL;
  const CoarseProblem coarse = coarse_problem(problem);
  EXPECT_EQ(std::count(coarse.group.begin(), coarse.group.end(), coarse.group[3]), 1);
  EXPECT_TRUE(std::isinf(coarse.problem.tension[coarse.group[3]]));
  problem.W = Matrix(Matrix::Identity(16, 16));
  const CoarseProblem same = coarse_problem(problem);
  EXPECT_EQ(same.problem.pairs(), 8);
  EXPECT_EQ(same.problem.W.dense(), problem.W.dense());
  EXPECT_EQ(same.problem.q, problem.q);
}

TEST(CoarseProblem, TwoJointsThatPushEachOtherApartShareNoGroup) {
  std::mt19937 random(8);
  Problem problem = joint(random, 14, 0.5);
  Matrix W = Matrix::Constant(28, 28, -0.01);
  W.topLeftCorner(14, 14) = W.bottomRightCorner(14, 14) = joint_flexibility(7);
  problem.W = W;
  const CoarseProblem coarse = coarse_problem(problem);
  EXPECT_EQ(coarse.problem.pairs(), 8);
  EXPECT_NE(coarse.group[6], coarse.group[7]);
}

/// A long plate that lies on a joint and is pushed, held by contact alone.
Problem plate(int pairs, double reach, double friction, double shear, double ripple) {
  Problem problem;
  problem.W = joint_flexibility(pairs, reach);
  problem.mu = Vector::Constant(pairs, friction);
  problem.q.resize(2 * pairs);
  Matrix G(2 * pairs, 3);
  for (int i = 0; i < pairs; ++i) {
    const double x = 2.0 * i / (pairs - 1.0) - 1.0;
    problem.q[2 * i] = ripple * std::cos(11.0 * x);
    problem.q[2 * i + 1] = shear * std::sin(3.0 * x);
    G.row(2 * i) << 1.0, 0.0, x;
    G.row(2 * i + 1) << 0.0, 1.0, 0.0;
  }
  problem.G = G;
  problem.f = Eigen::Vector3d(-1.0 * pairs, 0.3 * friction * pairs, 0.05 * pairs);
  return problem;
}

TEST(CoarseStart, OfALongFloatingBodyLeadsToTheSolution) {
  for (const Problem& problem : {plate(800, 10.0, 0.5, 3.0, 2.0), plate(800, 60.0, 0.2, 10.0, 5.0)}) {
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    EXPECT_LE(violation(problem, solution.p, solution.a), 1e-9);
  }
}

// Of several bodies pairs may be redundant. A force that moves nothing would be at the bound of friction.
TEST(CoarseStart, IsOfOneBodyAndWithoutForcesThatMoveNothing) {
  std::mt19937 random(11);
  Problem problem = floating_problem(random, 60, 0.5);
  Matrix W = problem.W.dense(), G = problem.G.dense();
  for (int k = 1; k < W.rows(); k += 8) W.row(k).setZero(), W.col(k).setZero(), G.row(k).setZero();
  problem.W = W, problem.G = G, problem.mu.setConstant(0.5);
  const std::optional<CoarseStart> start = coarse_start(problem, Vector::Zero(G.cols()));
  ASSERT_TRUE(start);
  for (int k = 1; k < W.rows(); k += 8) EXPECT_EQ(start->point.p[k], 0.0);
  EXPECT_GT(start->point.p.norm(), 0.0);
  Matrix of_two(G.rows(), 2 * G.cols());
  of_two << G, G;
  problem.G = of_two;
  problem.f = Vector(problem.f.replicate(2, 1));
  ASSERT_GT(problem.G.cols(), 3);
  EXPECT_FALSE(coarse_start(problem, Vector::Zero(problem.G.cols())));
}

TEST(CoarseStart, IterationsOnFewerPairsAreCountedApartAndStandInTheTrace) {
  std::mt19937 random(10);
  Problem problem = joint(random, 200, 0.7);
  problem.W = joint_flexibility(200, 60.0);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_GT(solution.coarse_iterations, 0);
  std::vector<std::string> stages;
  for (const Iteration& at : solution.trace)
    if (stages.empty() || stages.back() != at.stage) stages.push_back(at.stage);
  EXPECT_EQ(stages, (std::vector<std::string>{"newton, 25 pairs", "newton, 50 pairs", "newton, 100 pairs",
                                              "newton from fewer pairs"}));
  EXPECT_EQ(solution.trace.front().iteration, 0);
  EXPECT_EQ(solution.trace.back().iteration, solution.iterations + solution.coarse_iterations);
  const Solution again = solve(problem, {solution.p, {}});  // with history there are none
  EXPECT_EQ(again.coarse_iterations, 0);
  EXPECT_EQ(solve(joint(random, 47, 0.7)).coarse_iterations, 0);
}

/// All laws, immovable tangents, bodies that contact alone holds.
TEST(CoarseStart, RandomProblemsOfManyPairsAreCertified) {
  std::mt19937 random(11);
  for (int k = 0; k < 60; ++k) {
    const int pairs = whole(random, 48, 110);
    Problem problem =
        k % 3 == 0 ? floating_problem(random, pairs, 1.0) : joint(random, pairs, uniform(random, 0.0, 1.0));
    if (k % 3 == 1) {
      problem.cohesion = Vector::Constant(pairs, uniform(random, 0.0, 0.3));
      problem.tension = Vector::Constant(pairs, uniform(random, 0.0, 0.2));
      if (k % 2 == 0) problem.tension.segment(10, 5).setConstant(HUGE_VAL);
    } else if (k % 3 == 2) {
      problem.mu += 0.3 * random_forces(random, pairs).cwiseAbs();
      Matrix W = problem.W.dense();
      W.row(1).setZero(), W.col(1).setZero();  // a support holds the first pair along the joint
      problem.W = W;
      problem.q[1] = 0.0;
    }
    if (k % 3 != 0 && k % 4 == 0) problem.W = joint_flexibility(pairs, 30.0);
    const Solution solution = solve(problem);
    if (k % 3 == 0 && solution.status == Status::mechanism) continue;
    ASSERT_EQ(solution.status, Status::solved) << "problem " << k << ": " << solution.reason;
    EXPECT_LT(solution.certificate.worst(), 1e-10) << "problem " << k;
    if (problem.tension.size() == 0) {
      EXPECT_LT(violation(problem, solution.p, solution.a), 1e-8) << "problem " << k;
    }
  }
}

}  // namespace
}  // namespace scabo::contact
