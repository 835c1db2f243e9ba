// How many solutions a problem has: closed forms of one pair, and what may be said of many.
#include "scabo/contact/questions/uniqueness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

/// W = K^-1, K = [2 -1; -1 1]: K_tt / |K_tn| = W_nn / |W_nt| = 1.
Problem one_pair(double mu, const Vector& q) {
  Problem problem;
  Matrix K(2, 2);
  K << 2.0, -1.0, -1.0, 1.0;
  problem.W = test::inverse(K);
  problem.q = q;
  problem.mu = Vector::Constant(1, mu);
  problem.G.resize(2, 0);
  return problem;
}

UniquenessReport examined(const Problem& problem, const Start& start = {}) {
  return examine_uniqueness(problem, start, solve(problem, start), {});
}

// q = [0.1, 1], mu = 1.5: open, p = [0.8, -0.9] (stick), p = [0.2, -0.3] (slip); the one in the middle has
// index -1.
TEST(OnePair, AllThreeSolutionsAreFoundFromEachOfThem) {
  const Problem problem = one_pair(1.5, Eigen::Vector2d(0.1, 1.0));
  const std::vector<Vector> known{Vector::Zero(2), Eigen::Vector2d(0.8, -0.9), Eigen::Vector2d(0.2, -0.3)};
  const int index[] = {1, 1, -1};
  int sum = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const UniquenessReport report = examined(problem, {known[k], Vector()});
    EXPECT_EQ(report.unique, Uniqueness::several);
    EXPECT_TRUE(report.complete);
    ASSERT_EQ(report.others.size(), 2u);
    for (const Vector& other : report.others)
      EXPECT_LT(std::min({(other - known[(k + 1) % 3]).norm(), (other - known[(k + 2) % 3]).norm()}), 1e-12);
    EXPECT_EQ(report.nearest, -1);
    EXPECT_EQ(report.index, index[k]);
    sum += report.index;
  }
  EXPECT_EQ(sum, 1);
}

TEST(OnePair, BelowTheLimitThereIsOneWhateverTheMotion) {
  std::mt19937 random(3);
  for (double mu : {0.0, 0.3, 0.9, 0.999}) {
    for (int trial = 0; trial < 50; ++trial) {
      const UniquenessReport report =
          examined(one_pair(mu, Eigen::Vector2d(test::uniform(random, -1, 1), test::uniform(random, -1, 1))));
      EXPECT_EQ(report.unique, Uniqueness::proven);
      EXPECT_TRUE(report.others.empty());
      EXPECT_GE(report.index, 0);
    }
  }
}

// The condition is sufficient: here W = [1 1; 1 2], (W^-1)_nn = 2, W_tt = 2, so mu^2 2 2 < 1 means mu < 1/2
// (the limit is 1).
TEST(OnePair, TheConditionHasItsClosedForm) {
  for (double mu : {0.1, 0.5, 1.0}) EXPECT_NEAR(uniqueness_bound(one_pair(mu, Vector::Zero(2))), 4.0 * mu * mu, 1e-12);
}

// Pressed and stuck, then lifted little by little: where three solutions exist the pair stays stuck although
// p = 0 solves the problem as well, up to the end of its branch at |p_t| = mu p_n.
TEST(OnePair, TheBranchOfTheHistoryIsFollowedUnderLoad) {
  const double mu = 1.5;
  Start start;
  int several = 0;
  Vector before;
  for (int k = 0; k <= 60; ++k) {
    const double lift = -0.3 + 0.01 * k;  // q_n; stuck: p = [1 - 2 q_n, q_n - 1]
    const Problem problem = one_pair(mu, Eigen::Vector2d(lift, 1.0));
    const Solution solution = solve(problem, start);
    ASSERT_EQ(solution.status, Status::solved) << lift;
    const bool on_branch = lift <= 0.25 + 1e-9;  // |p_t| = mu p_n at q_n = 1/4
    if (on_branch) {
      EXPECT_LT((solution.p - Eigen::Vector2d(1.0 - 2.0 * lift, lift - 1.0)).norm(), 1e-10) << lift;
      if (k > 0) EXPECT_LT((solution.p - before).norm(), 0.03);  // no jump
    } else {
      EXPECT_LT(solution.p.norm(), 1e-12) << lift;
    }
    const UniquenessReport report = examine_uniqueness(problem, start, solution, {});
    EXPECT_EQ(report.nearest, -1) << lift;
    if (lift > 0.005 && lift < 0.245) {
      EXPECT_EQ(report.unique, Uniqueness::several) << lift;
      EXPECT_LT(solve(problem).p.norm(), 1e-12);  // from nothing: open
      ++several;
    }
    start.p = before = solution.p;
  }
  EXPECT_EQ(several, 24);
}

TEST(OnePair, TheSolutionNearestToTheHistoryIsNamed) {
  const Problem problem = one_pair(1.5, Eigen::Vector2d(0.1, 1.0));
  const UniquenessReport report =
      examine_uniqueness(problem, {Eigen::Vector2d(0.82, -0.91), Vector()}, solve(problem), {});
  ASSERT_GE(report.nearest, 0);
  EXPECT_LT((report.others[static_cast<std::size_t>(report.nearest)] - Eigen::Vector2d(0.8, -0.9)).norm(), 1e-12);
}

// A slider on a rail of slope k, W = [1 k]'[1 k], that friction jams (mu k > 1) while the motion asks it to
// pass: no forces at all. No failure to converge: none of the four combinations of states works.
TEST(JammedSlider, HasNoSolutionAndIsToldSo) {
  const double k = 2.0;
  Problem problem;
  Matrix W(2, 2);
  W << 1.0, k, k, k * k;
  problem.W = W;
  problem.q = Eigen::Vector2d(-1.0, -1.0);  // q_t > k q_n
  problem.G.resize(2, 0);
  problem.mu = Vector::Constant(1, 0.8);  // mu k = 1.6
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::not_converged);
  EXPECT_EQ(why_no_solution(problem, {}),
            "no combination of open, sticking and slipping pairs meets all conditions: the problem has no "
            "solution");
  problem.mu[0] = 0.4;  // mu k = 0.8: passes with p_n = 1 / (1 - mu k)
  const Solution passes = solve(problem);
  ASSERT_EQ(passes.status, Status::solved) << passes.reason;
  EXPECT_NEAR(passes.p[0], 5.0, 1e-9);
  EXPECT_EQ(why_no_solution(problem, {}), "");
}

TEST(SeveralPairs, WithWeakFrictionTheConditionProvesUniqueness) {
  std::mt19937 random(5);
  for (int d : {2, 3}) {
    int proven = 0;
    for (int trial = 0; trial < 30; ++trial) {
      Problem problem = test::held_problem(random, 8, 0.0, d);
      problem.mu = Vector::Ones(8);
      const double at_one = uniqueness_bound(problem);
      ASSERT_LT(at_one, HUGE_VAL);
      problem.mu *= 0.99 / std::sqrt(at_one);
      EXPECT_NEAR(uniqueness_bound(problem), 0.99 * 0.99, 1e-9);
      const Solution solution = solve(problem);
      ASSERT_EQ(solution.status, Status::solved);
      EXPECT_EQ(examine_uniqueness(problem, {}, solution, {}).unique, Uniqueness::proven);
      // The proof holds against every other start.
      for (int start = 0; start < 5; ++start) {
        const Solution other = solve(problem, {test::mixed_motion(random, 8, 1.0, d), Vector()});
        ASSERT_EQ(other.status, Status::solved);
        EXPECT_LT((other.p - solution.p).norm(), 1e-8 * (1.0 + solution.p.norm()));
      }
      ++proven;
    }
    EXPECT_EQ(proven, 30);
  }
}

// Units change nothing.
TEST(SeveralPairs, TheConditionIsFreeOfUnits) {
  std::mt19937 random(6);
  Problem problem = test::held_problem(random, 6, 1.0);
  problem.mu.setConstant(0.4);
  const double bound = uniqueness_bound(problem);
  problem.W = problem.W.scaled(1e-9);
  EXPECT_NEAR(uniqueness_bound(problem), bound, 1e-9 * bound);
}

// The index by counting: where all solutions are known, their indices sum to 1.
TEST(FewPairs, IndicesOfAllSolutionsSumToOne) {
  std::mt19937 random(11);
  int several = 0, counted = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Problem problem = test::held_problem(random, test::whole(random, 1, 3), 0.0);
    problem.mu = Vector::Constant(problem.mu.size(), 10.0);
    for (Eigen::Index i = 0; i < problem.q.size(); ++i) problem.q[i] = test::uniform(random, -1, 1);  // no ties
    const auto all = all_solutions(problem, 1e-10);
    ASSERT_TRUE(all.has_value());
    ASSERT_FALSE(all->empty());
    int sum = 0;
    bool regular = true;
    for (const Vector& p : *all) {
      const int index = index_of(problem, p, Vector());
      regular = regular && index != 0;
      sum += index;
    }
    several += all->size() > 1;
    if (!regular) continue;
    ++counted;
    EXPECT_EQ(sum, 1) << trial << ", " << all->size() << " solutions";
  }
  EXPECT_GT(counted, 180);
  EXPECT_GT(several, 0);
}

// Rigid motions that contact alone holds change nothing of the index: +1 without friction, however many there are.
TEST(FewPairs, IndexOfABodyThatOnlyContactHolds) {
  std::mt19937 random(12);
  for (int m : {1, 2, 3}) {
    int counted = 0;
    for (int trial = 0; trial < 40; ++trial) {
      Problem problem = test::held_problem(random, 6, 0.2);
      problem.G = Matrix::Random(12, m);
      problem.f = -problem.G.transpose() * (Vector(12) << 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0).finished();
      for (double mu : {0.0, 0.01}) {
        problem.mu.setConstant(mu);
        const Solution solution = solve(problem);
        if (solution.status != Status::solved) continue;
        const int index = index_of(problem, solution.p, solution.a);
        EXPECT_GE(index, 0) << m << " motions, mu " << mu;
        counted += index;
      }
    }
    EXPECT_GT(counted, 20) << m;
  }
}

// A pair that a support holds along the joint carries any force within the cone there, which moves nothing: no second
// solution.
TEST(ManyPairs, ForcesThatMoveNothingAreNoSecondSolution) {
  const int N = 7;
  Matrix W = 0.01 * Matrix::Identity(2 * N, 2 * N);
  W.row(2 * N - 1).setZero();
  Problem problem;
  problem.W = W;
  problem.q = Vector::Constant(2 * N, -1.0);
  problem.q[2 * N - 1] = 0.0;
  problem.mu = Vector::Constant(N, 0.3);
  problem.G.resize(2 * N, 0);
  const UniquenessReport report = examined(problem);
  EXPECT_EQ(report.unique, Uniqueness::not_decided);
  EXPECT_TRUE(report.others.empty());
}

// A pair that lets go: the motion left is rounding of the one before, and no solutions are made of it.
TEST(FewPairs, RoundingIsNoSecondSolution) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 50; ++trial) {
    Problem problem = test::held_problem(random, 3, 0.0);
    problem.mu = Vector::Constant(3, 0.1);
    for (Eigen::Index i = 0; i < 6; ++i) problem.q[i] = 1e-17 * test::uniform(random, -1, 1);
    const Start before{Vector::Constant(6, 1.0), Vector()};
    const Solution solution = solve(problem, before);
    if (solution.status != Status::solved) continue;
    EXPECT_TRUE(examine_uniqueness(problem, before, solution, {}).others.empty()) << trial;
  }
}

TEST(ManyPairs, SecondSolutionIsFoundFromOtherStarts) {
  // Eight independent copies of the pair with three solutions: too many to enumerate.
  const Problem one = one_pair(1.5, Eigen::Vector2d(0.1, 1.0));
  const int N = 8;
  Problem problem;
  Matrix W = Matrix::Zero(2 * N, 2 * N);
  problem.q.resize(2 * N);
  for (int i = 0; i < N; ++i) {
    W.block(2 * i, 2 * i, 2, 2) = one.W.dense();
    problem.q.segment<2>(2 * i) = one.q;
  }
  problem.W = W;
  problem.mu = Vector::Constant(N, 1.5);
  problem.G.resize(2 * N, 0);
  const UniquenessReport report = examined(problem);
  EXPECT_EQ(report.unique, Uniqueness::several);
  EXPECT_FALSE(report.complete);
  for (const Vector& other : report.others) EXPECT_LE(certify(problem, other, Vector(), {1.0, 1.0}).worst(), 1e-10);
}

}  // namespace
}  // namespace scabo::contact
