// Bodies that contact alone holds: solved without springs, or a mechanism, or held up to a motion that
// nothing drives.
#include "scabo/contact/questions/rigid_motions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/neutral_motions.hpp"
#include "scabo/contact/unit_motions.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

/// A block on a floor, `gap` above it. Loads [force_x, force_y, moment / L].
Problem block(int pairs, double friction, const Eigen::Vector3d& f, double gap = 0.0, double height = 0.2) {
  std::mt19937 random(41);
  Problem problem;
  problem.W = Matrix(1e-3 * elastic_flexibility(random, pairs));
  problem.q = Vector::Zero(2 * pairs);
  for (int i = 0; i < pairs; ++i) problem.q[2 * i] = gap;
  problem.mu = Vector::Constant(pairs, friction);
  problem.G = block_motions(pairs, 2.0, height);
  problem.f = f;
  return problem;
}

TEST(BlockOnAnIncline, SlidesExactlyWhenItsAngleExceedsThatOfFriction) {
  for (double friction : {0.05, 0.2, 0.7, 1.0})
    for (double factor : {0.5, 0.9, 0.999, 1.0 - 1e-6, 1.0 + 1e-6, 1.001, 1.5}) {
      const double angle = std::atan(friction * factor), weight = 30.0;
      for (double sense : {-1.0, 1.0}) {
        const Problem problem = block(5, friction, {sense * weight * std::sin(angle), -weight * std::cos(angle), 0.0});
        const Solution solution = solve(problem);
        SCOPED_TRACE(testing::Message() << "mu " << friction << ", tan(angle) / mu " << factor << ", sense " << sense);
        if (factor < 1.0) {
          ASSERT_EQ(solution.status, Status::solved) << solution.reason;
          EXPECT_LT(solution.certificate.worst(), 1e-10);
          EXPECT_LT(violation(problem, solution.p, solution.a), 1e-9);
        } else {
          ASSERT_EQ(solution.status, Status::mechanism);
          EXPECT_GT(solution.motion.dot(problem.f), 0.0);
          EXPECT_GT(sense * solution.motion[0], 0.5 * solution.motion.norm());  // down the slope
          EXPECT_FALSE(solution.reason.empty());
        }
      }
    }
}

TEST(FloatingBlock, TipsExactlyWhenItsWeightLeavesItsBase) {
  // Half width 1: the resultant leaves the base when |moment / L| > weight.
  for (double moment : {-0.999, -0.5, 0.5, 1.0 - 1e-6}) {
    const Solution solution = solve(block(5, 0.3, {0.0, -10.0, 10.0 * moment}));
    EXPECT_EQ(solution.status, Status::solved) << moment << ": " << solution.reason;
  }
  for (double moment : {-1.001, 1.0 + 1e-6, 2.0}) {
    const Solution solution = solve(block(5, 0.3, {0.0, -10.0, 10.0 * moment}));
    ASSERT_EQ(solution.status, Status::mechanism) << moment;
    EXPECT_GT(moment * solution.motion[2], 0.0);
  }
}

TEST(FloatingBlock, HoveringAndPushedDownLands) {
  for (double gap : {1e-9, 1e-3, 0.1, 10.0, 1e3})
    for (double friction : {0.0, 0.3}) {
      const Problem problem = block(5, friction, {0.0, -10.0, 2.0}, gap);
      const Solution solution = solve(problem);
      ASSERT_EQ(solution.status, Status::solved) << "gap " << gap << ": " << solution.reason;
      EXPECT_LT(solution.certificate.worst(), 1e-10);
      double normal = 0.0;
      for (int i = 0; i < 5; ++i) normal += solution.p[2 * i];
      EXPECT_NEAR(normal, 10.0, 1e-8);
    }
}

TEST(FloatingBlock, PressedIntoTheFloorIsPushedOut) {
  const Problem problem = block(5, 0.3, {0.0, -10.0, 0.0}, -0.05);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_GT(solution.a[1], 0.04);
}

TEST(FloatingBlock, TouchingAtZeroForceIsSolvedWithoutForces) {
  for (double gap : {0.0, 0.1}) {
    const Solution solution = solve(block(5, 0.3, {0.0, 0.0, 0.0}, gap));
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    EXPECT_EQ(solution.p, Vector(Vector::Zero(10)));
    EXPECT_EQ(solution.undetermined.cols(), 3);  // nothing loads it, nothing holds it
  }
}

TEST(FloatingBlock, OnePairUnderItsMiddle) {
  Problem problem = block(1, 0.5, {0.0, -10.0, 0.0});
  Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::solved) << solution.reason;
  EXPECT_NEAR(solution.p[0], 10.0, 1e-9);
  problem.f[2] = 0.1;  // a pencil on its tip, pushed
  solution = solve(problem);
  ASSERT_EQ(solution.status, Status::mechanism);
  EXPECT_GT(solution.motion.dot(problem.f), 0.0);
}

TEST(Mechanism, FrictionlessPushedSideways) {
  const Problem problem = block(6, 0.0, {1.0, -10.0, 0.0});
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::mechanism);
  const Vector motion = solution.motion.normalized();
  EXPECT_NEAR(motion[0], 1.0, 1e-9);
  EXPECT_LT((problem.G * motion)(Eigen::seq(0, 11, 2)).cwiseAbs().maxCoeff(), 1e-9);  // changes no gap
}

TEST(Mechanism, PulledOff) {
  const Solution solution = solve(block(6, 0.9, {0.0, 1.0, 0.0}));
  ASSERT_EQ(solution.status, Status::mechanism);
  EXPECT_GT(solution.motion[1], 0.5 * solution.motion.norm());
}

TEST(Mechanism, NoContactAtAll) {
  Problem problem = block(1, 0.3, {1.0, 0.0, 0.0});
  problem.W = Delassus(), problem.q.resize(0), problem.mu.resize(0), problem.G.resize(0, 3);
  EXPECT_EQ(solve(problem).status, Status::mechanism);
}

TEST(UndeterminedMotions, WhatNothingHoldsAndNothingDrives) {
  const Solution solution = solve(block(6, 0.0, {0.0, -10.0, 0.0}));  // frictionless, pressed straight down
  ASSERT_EQ(solution.status, Status::solved) << solution.reason;
  ASSERT_EQ(solution.undetermined.cols(), 1);
  EXPECT_NEAR(std::abs(solution.undetermined(0, 0)), 1.0, 1e-9);
  EXPECT_NEAR(solution.undetermined.col(0).tail(2).norm(), 0.0, 1e-9);

  EXPECT_EQ(solve(block(6, 0.5, {0.0, -10.0, 0.0})).undetermined.cols(), 0);  // friction holds it
}

// The last digits of the normals would decide about the forces: their sum times these digits would have to vanish, for
// which the block would move by 1e12 times its deformation.
TEST(UndeterminedMotions, NormalsThatDeviateByRoundingHoldNothing) {
  for (const int pairs : {6, 60, 200}) {
    const Problem exact = block(pairs, 0.0, {0.0, -10.0, 1.0});
    Problem rounded = exact;
    Matrix G = exact.G.dense();
    for (int i = 0; i < pairs; ++i) G(2 * i, 0) = 1e-13 * (i * 7 % 5 - 2);
    rounded.G = G;
    ASSERT_TRUE(without_neutral(rounded, 0.0));
    EXPECT_EQ(without_neutral(rounded, 0.0)->neutral.cols(), 1);
    const Solution expected = solve(exact), solution = solve(rounded);
    ASSERT_EQ(expected.status, Status::solved) << expected.reason;
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    EXPECT_LT((solution.p - expected.p).cwiseAbs().maxCoeff(), 1e-8 * expected.p.maxCoeff()) << pairs;
    EXPECT_NEAR(solution.a[0], 0.0, 1e-9);
    EXPECT_EQ(solution.undetermined.cols(), 1);
  }
}

TEST(UndeterminedMotions, StayWhereTheyWere) {
  const Problem problem = block(20, 0.0, {0.0, -10.0, 1.0});
  const Solution solution = solve(problem, {Vector(), Eigen::Vector3d(0.3, 0.0, 0.0), {}});
  ASSERT_EQ(solution.status, Status::solved) << solution.reason;
  EXPECT_NEAR(solution.a[0], 0.3, 1e-12);
}

TEST(UndeterminedMotions, InclinationsFarAboveRoundingAndFrictionHold) {
  Problem inclined = block(20, 0.0, {0.0, -10.0, 0.0});
  Matrix G = inclined.G.dense();
  for (int i = 0; i < 20; ++i) G(2 * i, 0) = 1e-6 * (i % 2 == 0 ? 1.0 : -1.0);
  inclined.G = G;
  EXPECT_FALSE(without_neutral(inclined, 0.0));
  EXPECT_FALSE(without_neutral(block(20, 1e-9, {0.0, -10.0, 0.0}), 0.0));
}

// Two blocks side by side on one floor do not know of each other.
TEST(FloatingBlock, TwoOfThemAreSolvedLikeEach) {
  const Problem one = block(4, 0.4, {2.0, -10.0, 3.0}), two = block(5, 0.2, {-1.0, -20.0, 0.0}, 0.01);
  Problem both;
  Matrix W = Matrix::Zero(18, 18);
  W.topLeftCorner(8, 8) = one.W.dense();
  W.bottomRightCorner(10, 10) = two.W.dense();
  both.W = W;
  both.q.resize(18);
  both.q << one.q, two.q;
  both.mu.resize(9);
  both.mu << one.mu, two.mu;
  Matrix G = Matrix::Zero(18, 6);
  G.topLeftCorner(8, 3) = one.G.dense();
  G.bottomRightCorner(10, 3) = two.G.dense();
  both.G = G;
  both.f.resize(6);
  both.f << one.f, two.f;
  const Solution solution = solve(both);
  ASSERT_EQ(solution.status, Status::solved) << solution.reason;
  EXPECT_LT((solution.p.head(8) - solve(one).p).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((solution.p.tail(10) - solve(two).p).cwiseAbs().maxCoeff(), 1e-8);
}

// Columns of G in other units: the same forces, and motions in those units, to the bit.
TEST(UnitMotions, OfAnyUnitsGiveTheSameForces) {
  const Eigen::Vector3d load(3.0, -10.0, 1.0);
  const Problem plain = block(5, 0.5, load);
  const UnitMotions first = in_unit_motions(plain, {});
  const Solution expected = first.given(solve(first.problem, first.start));
  ASSERT_EQ(expected.status, Status::solved) << expected.reason;
  const Eigen::Vector3d units(std::ldexp(1.0, 40), std::ldexp(1.0, -40), std::ldexp(1.0, 13));
  Problem other = plain;
  other.G = RigidMap(Matrix(plain.G.dense() * units.asDiagonal()));
  other.f = units.cwiseProduct(plain.f);
  Start start;
  start.a = expected.a.cwiseQuotient(units);
  const UnitMotions scaled = in_unit_motions(other, start);
  EXPECT_EQ(scaled.problem.f, first.problem.f);
  EXPECT_EQ(scaled.start.a, Vector(expected.a.cwiseQuotient(first.unit)));
  const Solution found = scaled.given(solve(scaled.problem));
  ASSERT_EQ(found.status, Status::solved) << found.reason;
  EXPECT_EQ(found.p, expected.p);
  EXPECT_EQ(found.a, Vector(expected.a.cwiseQuotient(units)));
}

// A power of two that would be infinite is not taken.
TEST(UnitMotions, OfSmallestNumbersStayFinite) {
  const Problem plain = block(5, 0.5, Eigen::Vector3d(3.0, -10.0, 1.0));
  Problem problem = plain;
  for (const double unit : {std::ldexp(1.0, -1022), std::ldexp(1.0, -1060)}) {
    problem.G = RigidMap(Matrix(plain.G.dense() * unit));
    const UnitMotions scaled = in_unit_motions(problem, {});
    EXPECT_TRUE(scaled.unit.allFinite() && scaled.problem.G.dense().allFinite()) << unit;
  }
}

}  // namespace
}  // namespace scabo::contact
