// Paths of solutions: a block that slides at the friction limit, one that only a dilatant joint could stop, and random
// problems, whose solutions are asked of the law itself.
#include "scabo/contact/path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/ladder.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/contact/starts/bonded_start.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

constexpr double weight = 10.0, friction = 0.5, width = 2.0, height = 0.1;

/// A low block of five pairs on a floor, pushed by `push`.
Problem pushed_block(double push) {
  std::mt19937 random(3);
  Problem problem;
  constexpr int pairs = 5;
  problem.W = test::elastic_flexibility(random, pairs);
  problem.q = Vector::Zero(2 * pairs);
  problem.mu = Vector::Constant(pairs, friction);
  problem.G = test::block_motions(pairs, width, height);
  problem.f = Eigen::Vector3d(push, -weight, 0.0);
  return problem;
}

/// The same under a ceiling with the same friction, `gap` above it.
Problem between_floor_and_ceiling(double push, double gap) {
  Problem problem = pushed_block(push);
  const Eigen::Index rows = problem.q.size(), pairs = problem.pairs();
  Matrix W = Matrix::Zero(2 * rows, 2 * rows), G(2 * rows, 3);
  W.topLeftCorner(rows, rows) = W.bottomRightCorner(rows, rows) = problem.W.dense();
  G << problem.G.dense(), -test::block_motions(static_cast<int>(pairs), width, -height);  // n = -y, t = -x
  problem.W = W;
  problem.G = G;
  problem.q = Vector::Zero(2 * rows);
  for (Eigen::Index i = 0; i < pairs; ++i) problem.q[rows + 2 * i] = gap;
  problem.mu = Vector::Constant(2 * pairs, friction);
  return problem;
}

/// From the block at rest under its weight; `together`: PathOptions::together.
PathEnd path_under(double push, int together = 0) {
  const Solution at_rest = solve(pushed_block(0.0));
  const Scaled pushed = scaled(pushed_block(push));
  return follow_path(
      pushed.problem,
      {at_rest.p, pushed.stiffness * at_rest.a,
       std::vector<ContactState>(static_cast<std::size_t>(pushed.problem.pairs()), ContactState::stick), 1e-8, 0.0},
      {.together = together});
}

/// From bonded forces, all pairs in this state; `broken` where there are none.
PathEnd path_from_bonded(const Scaled& problem, ContactState state, double margin, double pressure,
                         const PathOptions& options) {
  const auto start = bonded_start(problem.problem, {});
  if (!start) return {};
  const std::vector<ContactState> states(static_cast<std::size_t>(problem.problem.pairs()), state);
  return follow_path(problem.problem, {start->p, start->a, states, margin, pressure}, options);
}

TEST(Path, OfABlockBelowTheFrictionLimitArrives) {
  const double push = 0.9 * friction * weight;
  const PathEnd end = path_under(push);
  ASSERT_EQ(end.how, PathEnd::How::arrived);
  const Scaled pushed = scaled(pushed_block(push));
  EXPECT_LT(test::violation(pushed.problem, end.p, end.a), 1e-12 * weight);
  const Solution solution = solve(pushed_block(push));
  EXPECT_LT((end.p - solution.p).lpNorm<Eigen::Infinity>(), 1e-9 * weight);
}

TEST(Path, OfABlockEndsAtTheFrictionLimitInSliding) {
  const double push = 4.0;
  const PathEnd end = path_under(push * friction * weight);
  EXPECT_EQ(end.how, PathEnd::How::endless);
  EXPECT_NEAR(1.0 - end.left, 1.0 / push, 1e-6);
  ASSERT_EQ(end.motion.size(), 3);
  EXPECT_NEAR(end.motion[0], 1.0, 1e-9);
  EXPECT_NEAR(end.motion.tail(2).norm(), 0.0, 1e-9);
}

// Leaps stop short of the limit, and the path finds it change by change.
TEST(Path, LeapsDoNotPassALimit) {
  const double push = 3.7;  // no leap ends at the limit itself
  const PathEnd end = path_under(push * friction * weight, 16);
  EXPECT_EQ(end.how, PathEnd::How::endless);
  EXPECT_GT(end.leaps, 0);
  EXPECT_NEAR(1.0 - end.left, 1.0 / push, 1e-6);
  ASSERT_EQ(end.motion.size(), 3);
  EXPECT_NEAR(end.motion[0], 1.0, 1e-9);
  const double below = 0.9 * friction * weight;
  const PathEnd solved = path_under(below, 16);
  ASSERT_EQ(solved.how, PathEnd::How::arrived);
  EXPECT_LT(test::violation(scaled(pushed_block(below)).problem, solved.p, solved.a), 1e-12 * weight);
}

TEST(Path, TakesTheSoftnessBack) {
  // Two equal pairs at every point: W is singular, forces are not unique, their sums are.
  const Problem one = pushed_block(0.9 * friction * weight);
  Problem twice = one;
  const Eigen::Index rows = one.q.size();
  Matrix W(2 * rows, 2 * rows), G(2 * rows, 3);
  W << one.W.dense(), one.W.dense(), one.W.dense(), one.W.dense();
  G << one.G.dense(), one.G.dense();
  twice.W = W;
  twice.G = G;
  twice.q = Vector::Zero(2 * rows);
  twice.mu = Vector::Constant(2 * one.pairs(), friction);
  const Scaled problem = scaled(twice);
  const auto start = bonded_start(problem.problem, {});
  ASSERT_TRUE(start);
  const PathEnd end = follow_path(
      problem.problem,
      {start->p, start->a, std::vector<ContactState>(static_cast<std::size_t>(twice.pairs()), ContactState::stick)});
  ASSERT_EQ(end.how, PathEnd::How::arrived);
  EXPECT_LT(test::violation(problem.problem, end.p, end.a), 1e-11 * weight);
  const Solution solution = solve(one);
  EXPECT_LT((end.p.head(rows) + end.p.tail(rows) - solution.p).lpNorm<Eigen::Infinity>(), 1e-9 * weight);
}

// From states in which no pair sticks nothing holds the block. Held softly it takes the path to where some do.
TEST(Path, TakesBackWhatHoldsABodyThatSlides) {
  const Scaled pushed = scaled(pushed_block(0.9 * friction * weight));
  const Solution solution = solve(pushed_block(0.9 * friction * weight));
  PathStart start{solution.p, pushed.stiffness * solution.a, {}, 1e-6, 0.0};
  start.states.assign(static_cast<std::size_t>(pushed.problem.pairs()), ContactState::slip);
  for (Eigen::Index i = 1; i < start.p.size(); i += 2) start.p[i] = -std::abs(start.p[i]);
  EXPECT_EQ(follow_path(pushed.problem, start).how, PathEnd::How::broken);
  for (const double hold : {1e-9, 1e-6, 1e-3}) {
    PathOptions options;
    options.hold = hold;
    const PathEnd end = follow_path(pushed.problem, start, options);
    ASSERT_EQ(end.how, PathEnd::How::arrived) << hold;
    EXPECT_LT((end.p - solution.p).lpNorm<Eigen::Infinity>(), 1e-9 * weight) << hold;
    EXPECT_LT(test::violation(pushed.problem, end.p, end.a), 1e-11 * weight) << hold;
  }
}

// Pushed by 1.5 times what friction carries, from bonded pairs with the block held: what holds it in the end is half of
// that, however far it has moved.
TEST(Path, OfAHeldBlockThatIsLetGoEndsInSliding) {
  const Scaled pushed = scaled(pushed_block(1.5 * friction * weight));
  PathOptions options;
  options.hold = 1e-6;
  const PathEnd end = path_from_bonded(pushed, ContactState::stick, 1e-2, 0.0, options);
  ASSERT_EQ(end.how, PathEnd::How::endless);
  const double for_each_pair = 1.0 / std::sqrt(static_cast<double>(pushed.problem.pairs()));  // of the push
  EXPECT_NEAR(end.left * end.p.lpNorm<Eigen::Infinity>(), 0.5 * friction * weight * for_each_pair, 1e-6 * weight);
  ASSERT_EQ(end.motion.size(), 3);
  EXPECT_NEAR(end.motion[0], 1.0, 1e-6);
  EXPECT_NEAR(end.motion.tail(2).norm(), 0.0, 1e-6);
}

// Where bodies are held a leap that leads away leaves a point that another path begins with.
TEST(Path, BeginsAgainWhereALeapLeadsAway) {
  std::mt19937 random(12);
  int followed = 0, arrived = 0, leaps = 0;
  for (int k = 0; k < 200; ++k) {
    const Problem problem = test::floating_problem(random, test::whole(random, 6, 30), 1.0);
    if (solve(problem).status != Status::solved) continue;
    const Scaled in_forces = scaled(problem);
    ++followed;
    const PathEnd end = path_from_bonded(in_forces, ContactState::slip, 1e-6, 0.0, {.hold = 1e-6, .together = 64});
    leaps += end.leaps;
    if (end.how != PathEnd::How::arrived) continue;
    ++arrived;
    EXPECT_LT(test::violation(in_forces.problem, end.p, end.a), 1e-8 * std::max(1.0, end.p.lpNorm<Eigen::Infinity>()))
        << k;
  }
  EXPECT_GT(followed, 150);
  EXPECT_GT(arrived, 0.75 * followed);
  EXPECT_GT(leaps, 100);
}

// A path of held bodies that turns back may begin again where it is: after two changes without a smaller t here.
TEST(Path, BeginsAgainWhereItTurnsBack) {
  const auto arrived = [](int again) {
    std::mt19937 random(5);
    int arrived = 0;
    for (int k = 0; k < 60; ++k) {
      const Scaled in_forces = scaled(test::floating_problem(random, test::whole(random, 30, 50), 2.0));
      const PathEnd end = path_from_bonded(in_forces, ContactState::stick, 1e-2, 0.0,
                                           {.hold = 1e-6, .patience = 2, .together = 64, .again = again});
      if (end.how != PathEnd::How::arrived) continue;
      ++arrived;
      EXPECT_LT(test::violation(in_forces.problem, end.p, end.a), 1e-8 * std::max(1.0, end.p.lpNorm<Eigen::Infinity>()))
          << k;
    }
    return arrived;
  };
  const int once = arrived(0), again = arrived(8);
  EXPECT_GT(again, once);
}

// Forces of floor and ceiling, both pressed, would balance any push: no mechanism. But a joint that slides does not
// open, nothing presses the block against the ceiling, and it slides when friction on the floor is used up.
TEST(Collapse, OfABlockThatOnlyDilatancyWouldHold) {
  for (const double gap : {1e-3, 1.0})
    for (const double push : {1.5, 3.0}) {
      const Problem problem = between_floor_and_ceiling(push * friction * weight, gap);
      EXPECT_FALSE(find_mechanism(problem));
      const Solution at_rest = solve(between_floor_and_ceiling(0.0, gap));
      ASSERT_EQ(at_rest.status, Status::solved);
      const Solution solution = solve(problem, {at_rest.p, at_rest.a});
      ASSERT_EQ(solution.status, Status::collapse) << solution.reason;
      EXPECT_NEAR(solution.held, 1.0 / push, 1e-5);
      ASSERT_EQ(solution.motion.size(), 3);
      EXPECT_NEAR(solution.motion[0], 1.0, 1e-9);
      EXPECT_LT(solution.iterations, 60);
    }
}

TEST(Collapse, IsNotSaidBelowTheFrictionLimit) {
  const Solution at_rest = solve(between_floor_and_ceiling(0.0, 1e-3));
  const Solution solution = solve(between_floor_and_ceiling(0.99 * friction * weight, 1e-3), {at_rest.p, at_rest.a});
  EXPECT_EQ(solution.status, Status::solved) << solution.reason;
}

// Pushed to the right the block slips forward on the floor below (slip is its motion along t of the pairs).
TEST(Path, FindsTheFrictionLimitOfEachDirection) {
  const auto block = [](double push) {
    Problem problem = pushed_block(push);
    problem.mu_backward = Vector::Constant(problem.pairs(), 0.4 * friction);
    return problem;
  };
  const Solution at_rest = solve(block(0.0));
  double held[2] = {};
  for (const int way : {0, 1}) {
    const double push = (way == 0 ? 4.0 : -4.0) * friction * weight;
    const Scaled pushed = scaled(block(push));
    const PathEnd end = follow_path(pushed.problem, {at_rest.p, pushed.stiffness * at_rest.a,
                                                     std::vector<ContactState>(5, ContactState::stick), 1e-8, 0.0});
    ASSERT_EQ(end.how, PathEnd::How::endless);
    held[way] = 4.0 * (1.0 - end.left);
  }
  EXPECT_NEAR(std::max(held[0], held[1]), 1.0, 1e-5);
  EXPECT_NEAR(std::min(held[0], held[1]), 0.4, 1e-5);
}

class PathOfRandomProblems : public testing::TestWithParam<int> {};  // PathOptions::together

TEST_P(PathOfRandomProblems, EndsInSolutions) {
  std::mt19937 random(12);
  int solvable = 0, arrived = 0, leaps = 0;
  for (int k = 0; k < 300; ++k) {
    Problem problem = k % 2 == 0 ? test::floating_problem(random, test::whole(random, 2, 12), 1.0)
                                 : test::held_problem(random, test::whole(random, 2, 12), 1.0);
    if (k % 3 == 0)  // friction that differs by direction
      problem.mu_backward = Vector::NullaryExpr(problem.pairs(), [&] { return test::uniform(random, 0.05, 1.0); });
    const bool slides_freely = problem.mu[0] == 0.0 && problem.G.cols() > 1;  // its position is not determined
    if (slides_freely || solve(problem).status != Status::solved) continue;
    ++solvable;
    const Scaled in_forces = scaled(problem);
    const PathEnd end = path_from_bonded(in_forces, ContactState::stick, 1e-2, 1.0, {.together = GetParam()});
    leaps += end.leaps;
    if (end.how != PathEnd::How::arrived) continue;
    ++arrived;
    EXPECT_LT(test::violation(in_forces.problem, end.p, end.a), 1e-9 * std::max(1.0, end.p.lpNorm<Eigen::Infinity>()))
        << k;
  }
  EXPECT_GT(solvable, 200);
  EXPECT_GT(arrived, 0.95 * solvable);
  EXPECT_EQ(leaps > 100, GetParam() > 0) << leaps;
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithLeaps, PathOfRandomProblems, testing::Values(0, 4, 64));

}  // namespace
}  // namespace scabo::contact
