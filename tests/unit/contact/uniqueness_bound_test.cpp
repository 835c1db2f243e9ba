// The condition of uniqueness where coefficients of friction differ, against closed forms and against all solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/questions/uniqueness.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

Problem held(const Matrix& W, const Vector& mu, int dimension = 2) {
  Problem problem;
  problem.dimension = dimension;
  problem.W = W;
  problem.q = Vector::Zero(W.rows());
  problem.mu = mu;
  problem.G.resize(W.rows(), 0);
  return problem;
}

// Normals of two pairs coupled, W_nn = [1 c; c 1], tangents of flexibility d_i^2 on their own: the first matrix of the
// condition is [mu_1 d_1^2, -c m; -c m, mu_2 d_2^2] / (1 - c^2), m = sqrt(mu_1 mu_2) d_1 d_2, the second diag(mu_1,
// mu_2).
TEST(UniquenessBound, OfTwoCoupledPairsWithUnequalFriction) {
  const double c = 0.6;
  for (const auto& [mu_1, mu_2] : {std::pair{0.2, 0.9}, {0.9, 0.2}, {0.05, 0.5}, {0.0, 0.7}})
    for (const auto& [d_1, d_2] : {std::pair{1.0, 1.0}, {1.0, 2.0}, {3.0, 0.5}}) {
      Matrix W = Matrix::Zero(4, 4);
      W(0, 0) = W(2, 2) = 1.0;
      W(0, 2) = W(2, 0) = c;
      W(1, 1) = d_1 * d_1;
      W(3, 3) = d_2 * d_2;
      const double a = mu_1 * d_1 * d_1, b = mu_2 * d_2 * d_2,
                   normal = (0.5 * (a + b) + std::hypot(0.5 * (a - b), c * std::sqrt(a * b))) / (1.0 - c * c),
                   tangential = std::max(mu_1, mu_2);
      EXPECT_NEAR(uniqueness_bound(held(W, Eigen::Vector2d(mu_1, mu_2))), normal * tangential, 1e-12)
          << mu_1 << ", " << mu_2 << "; " << d_1 << ", " << d_2;
    }
}

// Tangents coupled, W_tt = [1 c; c 1]: diag(mu_1, mu_2), and [mu_1, c m; c m, mu_2] with m = sqrt(mu_1 mu_2).
TEST(UniquenessBound, OfCoupledTangentsWithUnequalFriction) {
  const double c = -0.7, mu_1 = 0.3, mu_2 = 0.8;
  Matrix W = Matrix::Identity(4, 4);
  W(1, 3) = W(3, 1) = c;
  const double tangential = 0.5 * (mu_1 + mu_2) + std::hypot(0.5 * (mu_1 - mu_2), c * std::sqrt(mu_1 * mu_2));
  EXPECT_NEAR(uniqueness_bound(held(W, Eigen::Vector2d(mu_1, mu_2))), mu_2 * tangential, 1e-12);
  // In space, the second tangents coupled less: the same largest eigenvalue.
  Matrix V = Matrix::Identity(6, 6);
  V(1, 4) = V(4, 1) = c;
  V(2, 5) = V(5, 2) = 0.5 * c;
  EXPECT_NEAR(uniqueness_bound(held(V, Eigen::Vector2d(mu_1, mu_2), 3)), mu_2 * tangential, 1e-12);
}

/// A pair of W = [1 1; 1 2] that has three solutions at mu = 1.5 for this motion, beside one that has one.
Problem three_solutions_beside_one(bool first) {
  Matrix W = Matrix::Zero(4, 4);
  W.topLeftCorner(2, 2) = W.bottomRightCorner(2, 2) = (Matrix(2, 2) << 1.0, 1.0, 1.0, 2.0).finished();
  Problem problem = held(W, first ? Eigen::Vector2d(1.5, 0.01) : Eigen::Vector2d(0.01, 1.5));
  const Eigen::Vector2d leaning(0.1, 1.0), pressed(-1.0, 0.2);
  problem.q << (first ? leaning : pressed), (first ? pressed : leaning);
  return problem;
}

TEST(UniquenessBound, OnePairWithMuchFrictionIsNotOutvotedByAnother) {
  for (const bool first : {true, false}) {
    const Problem problem = three_solutions_beside_one(first);
    EXPECT_NEAR(uniqueness_bound(problem), 4.0 * 1.5 * 1.5, 1e-12);  // 4 mu^2, as of the pair alone
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    const UniquenessReport report = examine_uniqueness(problem, {}, solution, {});
    EXPECT_EQ(report.unique, Uniqueness::several);
    EXPECT_EQ(report.others.size(), 2u);
    EXPECT_TRUE(report.complete);
  }
}

// The bound promises one solution: where it is below 1, trying all states finds one, whatever the motion.
TEST(UniquenessBound, BelowOneAllStatesTogetherGiveOneSolution) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 100; ++trial) {
    Problem problem = test::held_problem(random, test::whole(random, 2, 4), 0.0);
    for (double& mu : problem.mu) mu = std::pow(10.0, test::uniform(random, -2.0, 1.0));
    problem.mu *= 0.999 / std::sqrt(uniqueness_bound(problem));
    ASSERT_NEAR(uniqueness_bound(problem), 0.999 * 0.999, 1e-9);  // of second degree in the coefficients
    const auto all = all_solutions(problem, 1e-10);
    ASSERT_TRUE(all.has_value());
    EXPECT_EQ(all->size(), 1u) << trial;
  }
}

}  // namespace
}  // namespace scabo::contact
