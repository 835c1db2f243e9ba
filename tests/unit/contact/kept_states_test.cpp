// A start from the states of the increment before: exact as long as no pair changes its state, and no worse than the
// forces of that increment where loads turn round, fall or end.
#include "scabo/contact/starts/kept_states.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "scabo/contact/newton.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

std::optional<KeptStates> kept_states(const Problem& problem, const Vector& p, const Vector& a) {
  const BDifferentiableEquations equations(problem, 1.0);
  return keep_states(equations, p, a, equations.residual(p, a));
}

/// The problem of the increment that follows `before` when motions without contact and loads are those of `now` in all:
/// slip counts from then on.
Problem next_increment(const Problem& now, const Solution& before) {
  Problem next = now;
  for (Eigen::Index i = 0; i < now.pairs(); ++i) next.q[2 * i + 1] -= before.slip_increment[i];
  return next;
}

Problem times(const Problem& problem, double factor) {
  Problem result = problem;
  result.q *= factor;
  result.f *= factor;
  return result;
}

/// Iterations of Newton's method alone from the forces before; 50 where it does not converge.
int alone(const Problem& problem, const Solution& before) {
  const BDifferentiableEquations equations(problem, 1.0);
  NewtonOptions options;
  options.small = 1e-12;
  const NewtonEnd end = newton(equations, before.p, before.a, options);
  return end.converged ? end.iterations : 50;
}

// Without gaps, Signorini's and Coulomb's laws know no scale: twice the loads, twice the forces.
TEST(KeptStates, LoadsThatGrowInProportionNeedOneIteration) {
  std::mt19937 random(91);
  int solved = 0;
  for (int k = 0; k < 100; ++k) {
    const Problem problem = k % 2 == 0 ? held_problem(random, 20, 0.6) : floating_problem(random, 20, 0.6);
    const Solution first = solve(problem);
    if (first.status != Status::solved || first.p.isZero(0.0)) continue;
    const Problem next = next_increment(times(problem, 2.0), first);
    const auto kept = kept_states(next, first.p, first.a);
    if (!kept) continue;  // few states seem to change, or they leave rigid motions free
    ++solved;
    const double largest = first.p.lpNorm<Eigen::Infinity>();
    EXPECT_LT((kept->p - 2.0 * first.p).lpNorm<Eigen::Infinity>(), 1e-10 * largest) << k;
    const Solution second = solve(next, {first.p, first.a});
    EXPECT_EQ(second.status, Status::solved);
    EXPECT_LE(second.iterations, problem.G.cols() > 0 ? 1 : 20) << k;
    EXPECT_LT((second.p - 2.0 * first.p).lpNorm<Eigen::Infinity>(), 1e-10 * largest) << k;
  }
  EXPECT_GT(solved, 50);
}

// One pair by hand, u = q + p (W = 1), mu = 0.5. Pressed with 4 and dragged: it slips forward, p = (4, -2). Pressed
// with 6 it would carry -3; as it goes on slipping it does. Strained back by 1 it would still carry -mu p_n on kept
// states, although it sticks.
TEST(KeptStates, OnePairByHand) {
  Problem problem;
  problem.W = Matrix(Matrix::Identity(2, 2));
  problem.mu = Vector::Constant(1, 0.5);
  problem.G.resize(2, 0);
  const Vector p = (Vector(2) << 4.0, -2.0).finished();
  problem.q = (Vector(2) << -6.0, 1.0).finished();  // at p it seems to stick: u_t = -1
  auto kept = kept_states(problem, p, Vector());
  ASSERT_TRUE(kept);
  EXPECT_NEAR(kept->p[0], 6.0, 1e-14);
  EXPECT_NEAR(kept->p[1], -3.0, 1e-14);
  problem.q = (Vector(2) << -4.0, 1.0).finished();  // u_t = 1 - 2 = -1: backwards
  kept = kept_states(problem, p, Vector());
  ASSERT_TRUE(kept);
  EXPECT_NEAR(kept->p[1], -2.0, 1e-14);
  const Solution back = solve(problem, {p, Vector()});
  EXPECT_EQ(back.status, Status::solved);
  EXPECT_NEAR(back.p[1], -1.0, 1e-12);
  EXPECT_EQ(back.states.front(), ContactState::stick);
}

TEST(KeptStates, OpenPairsAndThoseWithStrengthByHand) {
  Problem problem;
  problem.W = Matrix(Matrix::Identity(4, 4));
  problem.mu = Vector::Constant(2, 0.5);
  problem.tension = (Vector(2) << 0.0, 3.0).finished();
  problem.cohesion = (Vector(2) << 0.0, 1.0).finished();
  problem.G.resize(4, 0);
  problem.q = (Vector(4) << 1.0, 1.0, 5.0, 0.25).finished();
  // The first is open, the second is pulled by less than its strength and sticks; now it seems to open, but the start
  // keeps it.
  const auto kept = kept_states(problem, (Vector(4) << 0.0, 0.0, -1.0, 0.5).finished(), Vector());
  ASSERT_TRUE(kept);
  EXPECT_LT((kept->p - (Vector(4) << 0.0, 0.0, -5.0, -0.25).finished()).norm(), 1e-14);
}

TEST(KeptStates, NoneWithoutForcesAndWhereAllPairsSlip) {
  std::mt19937 random(92);
  Problem problem = held_problem(random, 4, 0.6);
  EXPECT_FALSE(kept_states(problem, Vector::Zero(8), Vector()));
  problem.mu.setConstant(0.5);
  problem.G = block_motions(4, 2.0, 0.5);
  problem.f = Eigen::Vector3d(0.0, -4.0, 0.0);
  Vector p(8);
  for (int i = 0; i < 4; ++i) p[2 * i] = 1.0, p[2 * i + 1] = -0.5;
  EXPECT_FALSE(kept_states(problem, p, Vector::Zero(3)));  // nothing holds the block along the joint
}

/// A campaign of loads: each increment from the state before, with what the solver needs and what Newton's method alone
/// would need from the same forces.
struct Campaign {
  int increments = 0, iterations = 0, alone = 0;
};
void follow(const Problem& problem, const std::vector<double>& factors, Campaign& campaign) {
  Solution state;
  state.p = Vector::Zero(problem.q.size());
  state.a = Vector::Zero(problem.G.cols());
  Vector slip = Vector::Zero(problem.pairs());
  for (const double factor : factors) {
    Problem now = times(problem, factor);
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) now.q[2 * i + 1] -= slip[i];
    now.f[1] = problem.f[1];  // the weight is there from the start
    const Solution next = solve(now, {state.p, state.a});
    ASSERT_EQ(next.status, Status::solved) << factor << ": " << next.reason;
    EXPECT_LT(violation(now, next.p, next.a), 1e-9) << factor;
    if (!state.p.isZero(0.0)) {
      ++campaign.increments;
      campaign.iterations += next.iterations;
      campaign.alone += alone(now, state);
    }
    slip += next.slip_increment;
    state = next;
  }
}

/// A block of 24 pairs with three rigid motions, pressed by its weight and pushed and turned by what friction can hold.
Problem pushed_block(std::mt19937& random) {
  Problem problem = held_problem(random, 24, 0.0);
  problem.mu.setConstant(uniform(random, 0.3, 0.6));
  problem.q *= 0.02;
  problem.G = block_motions(24, 2.0, 0.5);
  problem.f = Eigen::Vector3d(12.0 * problem.mu[0], -24.0, uniform(random, -2.0, 2.0));
  return problem;
}

TEST(KeptStates, PushedToAndFroItTakesNoMoreIterationsThanFromTheForcesBefore) {
  std::mt19937 random(93);
  Campaign forward, reversed;
  for (int k = 0; k < 30; ++k) {
    const Problem problem = pushed_block(random);
    follow(problem, {0.2, 0.4, 0.6, 0.8, 1.0}, forward);
    follow(problem, {1.0, 0.5, -0.5, -1.0, 1.0, 0.0}, reversed);
  }
  EXPECT_EQ(forward.increments, 120);
  EXPECT_LT(forward.iterations, forward.alone);
  EXPECT_LE(reversed.iterations, reversed.alone + reversed.increments / 4);  // what was tried in vain
  std::printf("growing: %d iterations, from the forces before %d; to and fro: %d and %d\n", forward.iterations,
              forward.alone, reversed.iterations, reversed.alone);
}

TEST(KeptStates, LoadsThatAreTakenAwayLeaveNothing) {
  std::mt19937 random(94);
  for (int k = 0; k < 20; ++k) {
    const Problem problem = held_problem(random, 12, 0.6);
    const Solution pressed = solve(problem);
    ASSERT_EQ(pressed.status, Status::solved);
    Problem apart = problem;
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) apart.q[2 * i] = 1.0 + 0.1 * static_cast<double>(i);
    const Solution end = solve(apart, {pressed.p, pressed.a});
    EXPECT_EQ(end.status, Status::solved);
    EXPECT_LT(end.p.lpNorm<Eigen::Infinity>(), 1e-12 * (1.0 + pressed.p.lpNorm<Eigen::Infinity>()));
  }
}

}  // namespace
}  // namespace scabo::contact
