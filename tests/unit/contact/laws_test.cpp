// Laws with memory on small problems: a joint breaks where it should, pair by pair, and stays broken;
// friction falls with slip.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scabo/contact/laws/bonded.hpp"
#include "scabo/contact/laws/cohesive.hpp"
#include "scabo/contact/laws/coulomb.hpp"
#include "scabo/contact/laws/evolution.hpp"
#include "scabo/contact/laws/frictionless.hpp"
#include "scabo/contact/laws/lasting.hpp"
#include "scabo/contact/laws/slip_weakening.hpp"
#include "scabo/contact/laws/tresca.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using LawPointer = std::shared_ptr<const Law>;

LawPointer coulomb(double mu) { return std::make_shared<Coulomb>(mu); }
LawPointer cohesive(double mu, double c, double t) { return std::make_shared<Cohesive>(coulomb(mu), c, t); }

JointLaws all(const LawPointer& law, int pairs, double area = 1.0) {
  return {std::vector<LawPointer>(static_cast<std::size_t>(pairs), law), Vector::Constant(pairs, area)};
}

/// One pair on springs of flexibility w, moved by (u_n, u_t) if nothing held it.
Problem pair_on_springs(double w, double u_n, double u_t) {
  Problem problem;
  problem.W = Matrix(w * Matrix::Identity(2, 2));
  problem.q = Eigen::Vector2d(u_n, u_t);
  problem.G.resize(2, 0);
  return problem;
}

Evolution one(const LawPointer& law, const Problem& problem, const PairHistory& history = {}, double area = 1.0) {
  return evolve(problem, all(law, 1, area), {history}, {}, {});
}

// Pulled with F = u_n / w < tension A it holds with p_n = -F; beyond it opens for good.
TEST(CohesiveJoint, HoldsPullUpToItsTensileStrengthAndNothingAfterwards) {
  const double w = 0.01, area = 0.5, strength = 40.0;
  const LawPointer law = cohesive(0.3, 100.0, strength);
  const double limit = w * strength * area;
  const Evolution holds = one(law, pair_on_springs(w, limit * (1 - 1e-6), 0.0), {}, area);
  ASSERT_EQ(holds.solution.status, Status::solved);
  EXPECT_NEAR(holds.solution.p[0], -strength * area * (1 - 1e-6), 1e-9);
  EXPECT_EQ(holds.solution.states[0], ContactState::stick);
  EXPECT_FALSE(holds.history[0].broken);
  const Evolution breaks = one(law, pair_on_springs(w, limit * (1 + 1e-6), 0.0), {}, area);
  ASSERT_EQ(breaks.solution.status, Status::solved);
  EXPECT_EQ(breaks.solution.p.norm(), 0.0);
  EXPECT_NEAR(breaks.solution.gap[0], limit * (1 + 1e-6), 1e-15);
  EXPECT_TRUE(breaks.history[0].broken);
  EXPECT_EQ(breaks.rounds, 2);
  // Pulled again, less: a broken joint holds nothing.
  const Evolution again = one(law, pair_on_springs(w, 0.1 * limit, 0.0), breaks.history[0], area);
  EXPECT_EQ(again.solution.p.norm(), 0.0);
}

// Sheared under pressure p_n: c A + mu p_n at first, mu p_n after it broke.
TEST(CohesiveJoint, ShearedUnderPressureFallsToFrictionAlone) {
  const double w = 0.01, mu = 0.3, c = 60.0, area = 0.5, p_n = 50.0, limit = c * area + mu * p_n;
  const LawPointer law = cohesive(mu, c, 0.0);
  const Evolution holds = one(law, pair_on_springs(w, -w * p_n, w * limit * (1 - 1e-6)), {}, area);
  ASSERT_EQ(holds.solution.status, Status::solved);
  EXPECT_NEAR(holds.solution.p[1], -limit * (1 - 1e-6), 1e-9);
  EXPECT_FALSE(holds.history[0].broken);
  const Evolution breaks = one(law, pair_on_springs(w, -w * p_n, w * limit * (1 + 1e-6)), {}, area);
  ASSERT_EQ(breaks.solution.status, Status::solved);
  EXPECT_NEAR(breaks.solution.p[1], -mu * p_n, 1e-9);
  EXPECT_TRUE(breaks.history[0].broken);
  EXPECT_NEAR(breaks.history[0].slip, w * (limit * (1 + 1e-6) - mu * p_n), 1e-12);
}

// Sheared without any pressure, p_n = 0: such a pair counts as open, but carries |p_t| <= c A as long as it is whole.
TEST(CohesiveJoint, ShearedWithoutPressureCarriesItsCohesionAndNothingAfterwards) {
  const double w = 0.01, c = 60.0, area = 0.5, limit = c * area;
  const LawPointer law = cohesive(0.3, c, 0.0);
  for (double side : {1.0, -1.0}) {
    const Evolution holds = one(law, pair_on_springs(w, 0.0, side * w * limit * (1 - 1e-6)), {}, area);
    ASSERT_EQ(holds.solution.status, Status::solved);
    EXPECT_NEAR(holds.solution.p[1], -side * limit * (1 - 1e-6), 1e-9);
    EXPECT_FALSE(holds.history[0].broken);
    const Evolution breaks = one(law, pair_on_springs(w, 0.0, side * w * limit * (1 + 1e-6)), {}, area);
    ASSERT_EQ(breaks.solution.status, Status::solved);
    EXPECT_EQ(breaks.solution.states[0], ContactState::open);
    EXPECT_TRUE(breaks.history[0].broken);
    EXPECT_EQ(breaks.solution.p.norm(), 0.0);
    EXPECT_EQ(breaks.history[0].slip, 0.0);  // it did not slip in contact
    EXPECT_EQ(breaks.rounds, 2);
  }
}

// A row of pairs that share a pull: the overloaded end breaks, its load goes to the next. With W = w (1 + k
// [i = j]) the remaining n pairs carry u / (w (n + k)) each, so that a joint that breaks at all breaks wholly
// when k is small.
TEST(CohesiveJoint, FailsPairByPairFromTheMostOverloaded) {
  const int N = 4;
  const double w = 1.0, k = 0.5;
  Problem problem;
  Matrix W = Matrix::Zero(2 * N, 2 * N);
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j)
      for (int c = 0; c < 2; ++c) W(2 * i + c, 2 * j + c) = w * (1.0 + (i == j ? k : 0.0));
  problem.W = W;
  problem.G.resize(2 * N, 0);
  problem.q = Vector::Zero(2 * N);
  const Vector pull = (Vector(N) << 4.0, 4.1, 4.2, 4.3).finished();
  for (int i = 0; i < N; ++i) problem.q[2 * i] = pull[i];
  const auto run = [&](double strength) {
    return evolve(problem, all(cohesive(0.0, 100.0, strength), N), History(N), {}, {});
  };
  // Whole: p_i = -(u_i - s) / (w k), s = w sum p; the last pair carries most.
  const double sum = pull.sum() / (N + k), most = (pull[3] - sum) / k;
  const Evolution whole = run(most * (1 + 1e-6));
  ASSERT_EQ(whole.solution.status, Status::solved);
  EXPECT_NEAR(whole.solution.p[6], -most, 1e-9);
  for (const PairHistory& pair : whole.history) EXPECT_FALSE(pair.broken);
  const Evolution gone = run(most * (1 - 1e-6));
  ASSERT_EQ(gone.solution.status, Status::solved);
  for (const PairHistory& pair : gone.history) EXPECT_TRUE(pair.broken);
  EXPECT_EQ(gone.rounds, N + 1);  // one after the other
}

// The pair that the first failure relieves stays whole: pulled sideways off its neighbour.
TEST(CohesiveJoint, APairThatAFailureRelievesStaysWhole) {
  Problem problem;
  Matrix W = Matrix::Identity(4, 4);
  W(0, 2) = W(2, 0) = 0.5;  // a pull on one opens the other: p_0 < 0 relieves nothing, its loss does
  problem.W = W;
  problem.q = (Vector(4) << 2.0, 0.0, -0.2, 0.0).finished();
  problem.G.resize(4, 0);
  const Evolution evolution = evolve(problem, all(cohesive(0.0, 10.0, 1.0), 2), History(2), {}, {});
  ASSERT_EQ(evolution.solution.status, Status::solved);
  EXPECT_TRUE(evolution.history[0].broken);
  EXPECT_FALSE(evolution.history[1].broken);
  EXPECT_NEAR(evolution.solution.p[2], 0.2, 1e-12);
}

// Strengths that nothing reaches, however large: the joint is as if bonded, to rounding.
TEST(CohesiveJoint, HugeStrengthsDoNotDrownTheForces) {
  const double w = 0.01;
  for (double strength : {1e6, 1e12, 1e30, 1e99}) {
    const Evolution pulled = one(cohesive(0.3, strength, strength), pair_on_springs(w, 0.2, 0.5));
    ASSERT_EQ(pulled.solution.status, Status::solved) << strength << ": " << pulled.solution.reason;
    EXPECT_NEAR(pulled.solution.p[0], -20.0, 1e-9);
    EXPECT_NEAR(pulled.solution.p[1], -50.0, 1e-9);
    EXPECT_FALSE(pulled.history[0].broken);
    // Beside a cohesion that nothing reaches the tensile strength fails where it should.
    for (double factor : {1.0 - 1e-6, 1.0 + 1e-6}) {
      const Evolution torn = one(cohesive(0.3, strength, 20.0), pair_on_springs(w, 0.2 * factor, 0.0));
      ASSERT_EQ(torn.solution.status, Status::solved) << strength << ": " << torn.solution.reason;
      EXPECT_EQ(torn.history[0].broken, factor > 1.0) << strength;
    }
  }
}

// A strength is cut for the solve only as long as nothing comes near: here forces are 1e6 times what the start tells.
TEST(CohesiveJoint, AStrengthThatIsReachedIsNotCut) {
  Problem problem;
  Matrix W(4, 4);  // the mean of the diagonal hides a pair 1e8 times as stiff
  W << 1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1e-8, 0, 0, 0, 0, 1e-8;
  problem.W = W;
  problem.q = (Vector(4) << 0.0, 0.0, 1.0, 0.0).finished();
  problem.G.resize(4, 0);
  for (double factor : {1.0 - 1e-6, 1.0 + 1e-6}) {
    const Evolution evolution = evolve(problem, all(cohesive(0.0, 1e12, 1e8 * factor), 2), History(2), {}, {});
    ASSERT_EQ(evolution.solution.status, Status::solved) << evolution.solution.reason;
    EXPECT_EQ(evolution.history[1].broken, factor < 1.0);
    if (factor > 1.0) EXPECT_NEAR(evolution.solution.p[2], -1e8, 1e-1);
  }
}

/// A block of weight W_b on an incline, on `pairs` pairs: moves along [t, n] only (pressed evenly).
Problem block_on_incline(int pairs, double weight, double angle) {
  Problem problem;
  problem.W = Matrix(1e-4 * Matrix::Identity(2 * pairs, 2 * pairs));
  problem.q = Vector::Zero(2 * pairs);
  Matrix G = Matrix::Zero(2 * pairs, 2);
  for (int i = 0; i < pairs; ++i) G(2 * i, 1) = G(2 * i + 1, 0) = 1.0;
  problem.G = G;
  problem.f = Eigen::Vector2d(weight * std::sin(angle), -weight * std::cos(angle));
  return problem;
}

// It slips when tan(angle) > mu + c A / (W cos(angle)); on steep planes tension is not needed.
TEST(Incline, WithCohesionSlipsAtItsClosedFormAngle) {
  const double weight = 30.0, mu = 0.4, area = 2.0;
  const int N = 5;
  for (double degrees : {30.0, 45.0, 70.0, 89.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double c = (std::tan(angle) - mu) * weight * std::cos(angle) / area;  // just held
    for (double factor : {1 - 1e-6, 1 + 1e-6}) {
      const JointLaws laws = all(cohesive(mu, c * factor, 0.0), N, area / N);
      const Evolution evolution = evolve(block_on_incline(N, weight, angle), laws, History(N), {}, {});
      if (factor > 1.0) {
        ASSERT_EQ(evolution.solution.status, Status::solved) << degrees << ": " << evolution.solution.reason;
        EXPECT_NEAR(evolution.solution.p[1], -weight * std::sin(angle) / N, 1e-8);
      } else {
        ASSERT_EQ(evolution.solution.status, Status::mechanism) << degrees << ": " << evolution.solution.reason;
        EXPECT_GT(evolution.solution.motion[0], 0.9);
        EXPECT_EQ(evolution.history, History(N));  // what did not converge leaves no history
      }
    }
  }
}

// On an overhang (beyond 90 degrees) tensile strength must carry: -W cos(angle) <= tau_t A, |p_t| <= c A.
TEST(Incline, OverhangHoldsByTensileStrength) {
  const double weight = 30.0, angle = 120.0 * std::numbers::pi / 180.0, area = 2.0;
  const double tension = -weight * std::cos(angle) / area;
  for (double factor : {1 - 1e-6, 1 + 1e-6}) {
    const JointLaws laws = all(cohesive(0.4, 100.0, tension * factor), 4, area / 4);
    const Solution solution = evolve(block_on_incline(4, weight, angle), laws, History(4), {}, {}).solution;
    EXPECT_EQ(solution.status, factor > 1.0 ? Status::solved : Status::mechanism) << solution.reason;
  }
}

// Driven by u_t through a spring: mu_s N until slip begins, then mu_d N at once; the way back starts from
// there.
TEST(SlipWeakening, FallsAtOnceWithoutASlipDistance) {
  const double w = 0.01, p_n = 100.0;
  const LawPointer law = std::make_shared<SlipWeakening>(0.5, 0.3, 0.0);
  const auto at = [&](double force, const PairHistory& history) {
    return one(law, pair_on_springs(w, -w * p_n, w * force), history);
  };
  const Evolution sticks = at(50.0 * (1 - 1e-6), {});
  EXPECT_NEAR(sticks.solution.p[1], -50.0 * (1 - 1e-6), 1e-9);
  EXPECT_EQ(sticks.history[0], PairHistory{});
  const Evolution slips = at(50.0 * (1 + 1e-6), {});
  ASSERT_EQ(slips.solution.status, Status::solved);
  EXPECT_NEAR(slips.solution.p[1], -30.0, 1e-9);
  EXPECT_TRUE(slips.history[0].slipped);
  const Evolution after = at(40.0, slips.history[0]);  // would have held before
  EXPECT_NEAR(after.solution.p[1], -30.0, 1e-9);
}

// mu p_n = (mu_s - k s) p_n and p_t = (u - s w^-1 ...): s = (u / w - mu_s p_n) / (1 / w - k p_n) while s < L.
TEST(SlipWeakening, FollowsItsLineOverTheSlipDistance) {
  const double w = 0.01, p_n = 100.0, L = 1.0, k = 0.2 / L;  // softening 20 against a spring of 100
  const LawPointer law = std::make_shared<SlipWeakening>(0.5, 0.3, L);
  PairHistory history;
  double gone = 0.0;
  for (double force : {40.0, 51.0, 60.0, 90.0, 110.0, 129.0}) {
    const Evolution evolution = one(law, pair_on_springs(w, -w * p_n, w * force - gone), history);
    ASSERT_EQ(evolution.solution.status, Status::solved) << evolution.solution.reason;
    history = evolution.history[0];
    gone += evolution.solution.slip_increment[0];
    const double s = std::max(0.0, (force - 0.5 * p_n) / (1.0 / w - k * p_n));
    EXPECT_NEAR(history.slip, s, 1e-9) << force;
    EXPECT_NEAR(evolution.solution.p[1], -(force - s / w), 1e-7) << force;
  }
  const Evolution beyond = one(law, pair_on_springs(w, -w * p_n, w * 200.0 - gone), history);
  EXPECT_NEAR(beyond.solution.p[1], -30.0, 1e-9);
}

// Where only the coefficient of backward slip falls: p_t = (0.6 - 0.8 s) p_n and s = w (force - p_t).
TEST(SlipWeakening, OfBackwardSlipAloneFollowsItsLine) {
  const double w = 0.01, p_n = 50.0, force = 40.0, fall = 0.4 / 0.5 * p_n;  // per slip, against a spring of 100
  const LawPointer law =
      std::make_shared<SlipWeakening>(SlipWeakening::Fall{0.5, 0.5}, SlipWeakening::Fall{0.6, 0.2}, 0.5);
  const Evolution evolution = one(law, pair_on_springs(w, -w * p_n, -w * force));
  ASSERT_EQ(evolution.solution.status, Status::solved) << evolution.solution.reason;
  const double p_t = (0.6 * p_n - fall * w * force) / (1.0 - fall * w);
  EXPECT_NEAR(evolution.solution.p[1], p_t, 1e-8);
  EXPECT_NEAR(evolution.history[0].slip, w * (force - p_t), 1e-10);
}

TEST(SlipWeakening, SteeperThanItsSpringItFallsToTheDynamicCoefficient) {
  const double w = 0.01, p_n = 100.0;
  const LawPointer law = std::make_shared<SlipWeakening>(0.5, 0.3, 0.1);  // 200 against 100
  const Evolution evolution = one(law, pair_on_springs(w, -w * p_n, w * 51.0));
  ASSERT_EQ(evolution.solution.status, Status::solved) << evolution.solution.reason;
  EXPECT_NEAR(evolution.solution.p[1], -30.0, 1e-9);
}

TEST(Tresca, BoundDoesNotDependOnPressure) {
  const double w = 0.01, strength = 40.0, area = 0.5;
  const LawPointer law = std::make_shared<Tresca>(strength);
  for (double p_n : {1.0, 1000.0}) {
    EXPECT_NEAR(one(law, pair_on_springs(w, -w * p_n, w * 19.0), {}, area).solution.p[1], -19.0, 1e-9);
    for (int repeat = 0; repeat < 2; ++repeat)  // slip does not use it up
      EXPECT_NEAR(one(law, pair_on_springs(w, -w * p_n, w * 500.0), {3.0, false, false}, area).solution.p[1], -20.0,
                  1e-9);
  }
}

TEST(Bonded, CarriesAnyForceWithoutMotion) {
  std::mt19937 random(7);
  for (int d : {2, 3}) {
    Problem problem;
    problem.dimension = d;
    problem.W = test::elastic_flexibility(random, 6, 1.0, d);
    problem.q = test::mixed_motion(random, 6, 1.0, d);
    problem.G.resize(6 * d, 0);
    const Evolution evolution = evolve(problem, all(std::make_shared<Bonded>(), 6), History(6), {}, {});
    ASSERT_EQ(evolution.solution.status, Status::solved) << evolution.solution.reason;
    EXPECT_LT((problem.W * evolution.solution.p + problem.q).norm(), 1e-10);
    EXPECT_LE(evolution.solution.certificate.worst(), 1e-10);
    EXPECT_EQ(evolution.rounds, 1);
  }
}

TEST(Frictionless, IsCoulombWithoutFriction) {
  std::mt19937 random(8);
  const Problem problem = test::held_problem(random, 8, 1.0);
  const Evolution without = evolve(problem, all(std::make_shared<Frictionless>(), 8), History(8), {}, {});
  const Evolution zero = evolve(problem, all(coulomb(0.0), 8), History(8), {}, {});
  EXPECT_EQ(without.solution.p, zero.solution.p);
}

// Random joints with strengths: every solution is certified, nothing is broken that did not have to be given
// what broke before it, and the history of an increment is the same whether it is solved once or again.
TEST(RandomJoints, EndCertifiedWithoutOverload) {
  std::mt19937 random(9);
  int broken = 0, whole = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int N = test::whole(random, 1, 12);
    const Problem problem = test::held_problem(random, N, 0.8);
    const JointLaws laws = all(
        cohesive(test::uniform(random, 0.0, 0.8), test::uniform(random, 0.05, 1.0), test::uniform(random, 0.0, 0.5)),
        N);
    const Evolution evolution = evolve(problem, laws, History(static_cast<std::size_t>(N)), {}, {});
    ASSERT_EQ(evolution.solution.status, Status::solved) << trial << ": " << evolution.solution.reason;
    EXPECT_LE(evolution.solution.certificate.worst(), 1e-10);
    for (int i = 0; i < N; ++i) {
      const bool gone = evolution.history[static_cast<std::size_t>(i)].broken;
      (gone ? broken : whole) += 1;
      if (gone)
        EXPECT_GE(evolution.solution.p[2 * i], -1e-10);
      else
        EXPECT_LT(std::abs(evolution.solution.gap[i]) + std::abs(evolution.solution.slip_increment[i]), 1e-8);
    }
  }
  EXPECT_GT(broken, 100);
  EXPECT_GT(whole, 100);
}

// Four increments with random motions: open pairs carry nothing, closed ones their cohesion, whatever they did before.
// A pair that opens with its cohesion and closes without it has none; there are few.
TEST(RandomJoints, WithLastingCohesionHaveItWhileTheyAreClosed) {
  std::mt19937 random(10);
  int open = 0, slipping = 0, closed_again = 0, without = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int N = test::whole(random, 1, 12);
    Problem problem = test::held_problem(random, N, 0.8);
    const double mu = test::uniform(random, 0.0, 0.8), c = test::uniform(random, 0.05, 1.0);
    const JointLaws laws = all(std::make_shared<LastingCohesion>(coulomb(mu), c), N);
    History history(static_cast<std::size_t>(N));
    for (int increment = 0; increment < 4; ++increment) {
      problem.q = test::held_problem(random, N, 0.8).q;
      const Evolution evolution = evolve(problem, laws, history, {}, {});
      ASSERT_EQ(evolution.solution.status, Status::solved) << trial << ": " << evolution.solution.reason;
      EXPECT_LE(evolution.solution.certificate.worst(), 1e-10);
      for (int i = 0; i < N; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec2 p = evolution.solution.p.segment<2>(2 * i);
        const bool is_open = evolution.solution.gap[i] > 1e-8;
        const bool has_cohesion = !evolution.history[k].broken;
        if (is_open)
          EXPECT_LT(p.norm(), 1e-9);
        else if (!has_cohesion)
          EXPECT_LE(std::abs(p[1]), mu * p[0] + 1e-8) << trial << " " << increment << " " << i;
        else if (std::abs(evolution.solution.slip_increment[i]) > 1e-8)
          EXPECT_NEAR(std::abs(p[1]), c + mu * p[0], 1e-8) << trial << " " << increment << " " << i;
        EXPECT_FALSE(is_open && has_cohesion);
        open += is_open;
        without += !is_open && !has_cohesion;
        slipping += evolution.solution.states[k] == ContactState::slip;
        closed_again += history[k].broken && !is_open;
      }
      history = evolution.history;
    }
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(slipping, 100);
  EXPECT_GT(closed_again, 100);
  EXPECT_LT(without, 40);
}

}  // namespace
}  // namespace scabo::contact
