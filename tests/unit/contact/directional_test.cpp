// Coefficients of friction that differ by the direction of slip: closed forms of one pair, and the same problems in
// other words, which the code for one coefficient solves and judges.
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/files/fclib.hpp"
#include "scabo/contact/files/text_problem.hpp"
#include "scabo/contact/laws/cohesive.hpp"
#include "scabo/contact/laws/coulomb.hpp"
#include "scabo/contact/laws/evolution.hpp"
#include "scabo/contact/questions/infeasibility.hpp"
#include "scabo/contact/questions/lemke.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/contact/questions/uniqueness.hpp"
#include "scabo/contact/sweeps/pair_problem.hpp"
#include "unit/contact/problems.hpp"
#include "unit/contact/saved_problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

/// One pair with W = [1, c; c, 1].
Problem one_pair(double forward, double backward, const Vector& q, double coupling = 0.0) {
  Problem problem;
  Matrix W(2, 2);
  W << 1.0, coupling, coupling, 1.0;
  problem.W = W;
  problem.q = q;
  problem.mu = Vector::Constant(1, forward);
  problem.mu_backward = Vector::Constant(1, backward);
  problem.G.resize(2, 0);
  problem.f.resize(0);
  return problem;
}

/// Coefficients of all pairs, one in four of them 0.
void make_directional(std::mt19937& random, Problem& problem, double most) {
  const auto some = [&] { return whole(random, 0, 3) == 0 ? 0.0 : uniform(random, 0.0, most); };
  problem.mu = Vector::NullaryExpr(problem.pairs(), some);
  problem.mu_backward = Vector::NullaryExpr(problem.pairs(), some);
}

/// The same with one coefficient m = (mu_f + mu_b) / 2: p_t = p_t' + c p_n, c = (mu_b - mu_f) / 2, turns
/// -mu_f p_n <= p_t <= mu_b p_n into |p_t'| <= m p_n. W is then not symmetric, and motions are those of before.
struct Shifted {
  Problem problem;
  Matrix S;  // p = S p'
};
Shifted shifted(const Problem& given) {
  Shifted result{given, Matrix::Identity(given.q.size(), given.q.size())};
  for (Eigen::Index i = 0; i < given.pairs(); ++i)
    result.S(2 * i + 1, 2 * i) = 0.5 * (given.mu_backward[i] - given.mu[i]);
  result.problem.W = Matrix(given.W.dense() * result.S);
  result.problem.mu = 0.5 * (given.mu + given.mu_backward);
  result.problem.mu_backward.resize(0);
  return result;
}

// u_t = q_t + p_t, p_n = 2: stick between -2 mu_f and 2 mu_b, else slip at the bound of its direction.
TEST(FrictionByDirection, OfOnePairIsSolvedByHand) {
  for (const auto& [forward, backward] :
       {std::pair(0.3, 0.6), std::pair(0.6, 0.3), std::pair(0.0, 0.5), std::pair(0.5, 0.0)})
    for (const double q_t : {-3.0, -1.1, -0.9, -0.5, -0.1, 0.0, 0.1, 0.5, 0.9, 1.1, 3.0}) {
      const Problem problem = one_pair(forward, backward, Eigen::Vector2d(-2.0, q_t));
      const Solution solution = solve(problem);
      SCOPED_TRACE(testing::Message() << forward << ' ' << backward << ' ' << q_t);
      ASSERT_EQ(solution.status, Status::solved) << solution.reason;
      const double p_t = std::clamp(-q_t, -2.0 * forward, 2.0 * backward);
      EXPECT_NEAR(solution.p[0], 2.0, 1e-14);
      EXPECT_NEAR(solution.p[1], p_t, 1e-14);
      EXPECT_NEAR(solution.slip_increment[0], q_t + p_t, 1e-14);
      const bool slips = std::abs(q_t + p_t) > 1e-12;
      if (q_t != 0.0) EXPECT_EQ(solution.states[0], slips ? ContactState::slip : ContactState::stick);
      EXPECT_LT(solution.natural_map_residual, 1e-14);
    }
}

// The pair by itself, as sweeps solve it.
TEST(FrictionByDirection, OfAPairInASweepIsItsSolution) {
  std::mt19937 random(66);
  for (int k = 0; k < 200; ++k) {
    Problem problem = held_problem(random, 1, 0.5);
    make_directional(random, problem, 0.5);
    const Matrix W = problem.W.dense();
    Vector p(2);
    PairProblem<2>(W.data(), {problem.mu[0], problem.mu_backward[0]}, 0.0, 0.0).solve(problem.q.data(), p.data());
    EXPECT_LT(violation(problem, p, Vector()), 1e-12);
  }
}

TEST(FrictionByDirection, EqualInBothGivesEqualBits) {
  std::mt19937 random(61);
  for (int k = 0; k < 60; ++k) {
    const Problem one = k % 2 == 0 ? held_problem(random, whole(random, 1, 30), 0.9) : floating_problem(random, 8, 0.9);
    Problem two = one;
    two.mu_backward = two.mu;
    const Solution a = solve(one), b = solve(two);
    EXPECT_EQ(a.status, b.status);
    if (a.status == Status::solved) EXPECT_EQ(a.p, b.p);
  }
}

// Every solution is judged case by case, and by the figures of the problem with one coefficient; and the converse.
TEST(FrictionByDirection, IsFrictionWithOneCoefficientInOtherWords) {
  std::mt19937 random(62);
  int solved = 0, others = 0;
  for (int k = 0; k < 200; ++k) {
    Problem problem = held_problem(random, whole(random, 1, k % 10 == 0 ? 60 : 15), 0.8);
    make_directional(random, problem, 0.8);
    const Shifted other = shifted(problem);
    const Solution solution = solve(problem);
    if (solution.status == Status::solved) {
      ++solved;
      EXPECT_LT(violation(problem, solution.p, solution.a), 1e-10);
      const Vector p = 2.0 * solution.p - other.S * solution.p;  // S^-1 = 2 - S
      EXPECT_LT(violation(other.problem, p, solution.a), 1e-10);
      EXPECT_LT(certify(other.problem, p, solution.a, {1.0, 1.0}).worst(), 1e-9);
    }
    const Solution plain = solve(other.problem);
    if (plain.status == Status::solved) {
      ++others;
      const Vector p = other.S * plain.p;
      EXPECT_LT(violation(problem, p, plain.a), 1e-10);
      EXPECT_LT(certify(problem, p, plain.a, {1.0, 1.0}).worst(), 1e-9);
      EXPECT_LT(natural_map_residual(problem, p, plain.a), 1e-8);
    }
  }
  EXPECT_GE(solved, 198);
  EXPECT_GE(solved, others);
}

TEST(FrictionByDirection, MirroredExchangesTheCoefficients) {
  std::mt19937 random(63);
  for (int k = 0; k < 40; ++k) {
    Problem problem = held_problem(random, 8, 0.6);
    make_directional(random, problem, 0.4);
    Vector signs = Vector::Ones(problem.q.size());
    for (Eigen::Index i = 1; i < signs.size(); i += 2) signs[i] = -1.0;
    Problem mirrored = problem;
    mirrored.W = Matrix(signs.asDiagonal() * problem.W.dense() * signs.asDiagonal());
    mirrored.q = signs.cwiseProduct(problem.q);
    mirrored.mu.swap(mirrored.mu_backward);
    const Solution a = solve(problem), b = solve(mirrored);
    ASSERT_EQ(a.status, Status::solved);
    ASSERT_EQ(b.status, Status::solved);
    EXPECT_LT((signs.cwiseProduct(a.p) - b.p).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// Forces that are right for the other direction, or for none, are refused.
TEST(FrictionByDirection, WrongOnesAreNotCertified) {
  const auto worst = [](const Problem& problem, double p_n, double p_t) {
    const Vector p = Eigen::Vector2d(p_n, p_t);
    return std::pair(certify(problem, p, Vector(), {1.0, 1.0}).worst(), natural_map_residual(problem, p, Vector()));
  };
  const auto refused = [&](const Problem& problem, double p_n, double p_t) {
    const auto [certificate, map] = worst(problem, p_n, p_t);
    return certificate > 0.05 && map > 0.01;
  };
  const Problem forward = one_pair(0.3, 0.6, Eigen::Vector2d(-2.0, 3.0));  // it slips by 3 - 0.6
  EXPECT_FALSE(refused(forward, 2.0, -0.6));
  EXPECT_TRUE(refused(forward, 2.0, -1.2));
  EXPECT_TRUE(refused(forward, 2.0, 1.2));
  EXPECT_TRUE(refused(forward, 2.0, 0.0));
  const Problem backward = one_pair(0.3, 0.6, Eigen::Vector2d(-2.0, -3.0));
  EXPECT_FALSE(refused(backward, 2.0, 1.2));
  EXPECT_TRUE(refused(backward, 2.0, 0.6));
  // No friction forward, none taken backward either: the second must not pass.
  EXPECT_FALSE(refused(one_pair(0.0, 0.6, Eigen::Vector2d(-2.0, 3.0)), 2.0, 0.0));
  EXPECT_TRUE(refused(one_pair(0.0, 0.6, Eigen::Vector2d(-2.0, -3.0)), 2.0, 0.0));
  EXPECT_FALSE(refused(one_pair(0.6, 0.0, Eigen::Vector2d(-2.0, -3.0)), 2.0, 0.0));
  EXPECT_TRUE(refused(one_pair(0.6, 0.0, Eigen::Vector2d(-2.0, 3.0)), 2.0, 0.0));
}

TEST(FrictionByDirection, LemkeAndEnumerationKnowIt) {
  std::mt19937 random(64);
  int pivoted = 0;
  for (int k = 0; k < 40; ++k) {
    Problem problem = held_problem(random, whole(random, 1, 4), 0.5);
    make_directional(random, problem, 0.5);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved);
    if (const auto p = lemke(problem)) {
      ++pivoted;
      EXPECT_LT(violation(problem, *p, Vector()), 1e-9);
    }
    const auto all = all_solutions(problem, 1e-10);
    if (!all) continue;
    double least = HUGE_VAL;
    for (const Vector& p : *all) least = std::min(least, (p - solution.p).norm());
    EXPECT_LT(least, 1e-8);
  }
  EXPECT_GE(pivoted, 38);
}

// W = K^-1, K = [2 -1; -1 1]: with q = [0.1, 1] there are three solutions where friction against forward slip is 1.5,
// p_t < 0 in all of them, and one where it is 0.5 and that against backward slip 1.5.
TEST(FrictionByDirection, DecidesOnUniquenessByTheDirectionThatCounts) {
  Matrix W(2, 2);  // K^-1
  W << 1.0, 1.0, 1.0, 2.0;
  Problem problem = one_pair(1.5, 0.5, Eigen::Vector2d(0.1, 1.0));
  problem.W = W;
  EXPECT_EQ(all_solutions(problem, 1e-10)->size(), 3u);
  Problem larger = problem;
  larger.mu_backward.resize(0);
  EXPECT_EQ(uniqueness_bound(problem), uniqueness_bound(larger));
  std::swap(problem.mu, problem.mu_backward);
  EXPECT_EQ(all_solutions(problem, 1e-10)->size(), 1u);
  EXPECT_EQ(uniqueness_bound(problem), uniqueness_bound(larger));  // that of the larger one: nothing is proven
}

// W = w w', w = [-1, 2], q.r < 0 for r = [2, 1]: r lies in the cone from mu_b = 1/2 on, whatever mu_f.
TEST(FrictionByDirection, ProofsUseTheConeOfBothCoefficients) {
  Problem problem = one_pair(0.1, 0.5, Eigen::Vector2d(-2.0, 1.0));
  problem.W = Matrix(Eigen::Vector2d(-1.0, 2.0) * Eigen::RowVector2d(-1.0, 2.0));
  const Vector r = Eigen::Vector2d(1.0, 0.5);
  EXPECT_TRUE(proves_no_motion(problem, r));
  problem.mu_backward[0] = 0.49;
  EXPECT_FALSE(proves_no_motion(problem, r));
  problem.mu[0] = 5.0;
  EXPECT_FALSE(proves_no_motion(problem, r));
}

/// A block on a floor that is pushed by `push` times its weight.
Problem pushed(double forward, double backward, double push) {
  std::mt19937 random(65);
  Problem problem;
  problem.W = Matrix(1e-3 * elastic_flexibility(random, 5));
  problem.q = Vector::Zero(10);
  problem.mu = Vector::Constant(5, forward);
  problem.mu_backward = Vector::Constant(5, backward);
  problem.G = block_motions(5, 2.0, 0.1);
  problem.f = Eigen::Vector3d(30.0 * push, -30.0, 0.0);
  return problem;
}

TEST(FrictionByDirection, HoldsABlockUpToTheCoefficientOfItsDirection) {
  for (const double part : {0.5, 1.0 - 1e-6, 1.0 + 1e-6, 2.0})
    for (const double sense : {1.0, -1.0}) {
      const double limit = sense > 0.0 ? 0.2 : 0.7;
      const Problem problem = pushed(0.2, 0.7, sense * part * limit);
      const Solution solution = solve(problem);
      EXPECT_EQ(solution.status, part < 1.0 ? Status::solved : Status::mechanism) << solution.reason;
      if (part > 1.0) EXPECT_GT(sense * solution.motion[0], 0.99);
      if (part < 1.0) EXPECT_LT(violation(problem, solution.p, solution.a), 1e-9);
    }
  EXPECT_FALSE(find_mechanism(pushed(0.0, 0.7, -0.6)));
  EXPECT_TRUE(find_mechanism(pushed(0.0, 0.7, 1e-3)));
}

TEST(FrictionByDirection, KeepsCohesionOnBothSidesUntilItBreaks) {
  JointLaws laws;
  const auto coulomb = std::make_shared<Coulomb>(0.3, 0.6);
  laws.of_pair = {std::make_shared<Cohesive>(coulomb, 1.0, 0.0)};
  laws.area = Vector::Ones(1);
  const auto p_t = [&](double q_t) {
    Problem problem = one_pair(0.0, 0.0, Eigen::Vector2d(-2.0, q_t));
    const Evolution end = evolve(problem, laws, History(1), {}, {});
    EXPECT_EQ(end.solution.status, Status::solved);
    return std::pair(end.solution.p[1], end.history[0].broken);
  };
  const auto expect = [](const std::pair<double, bool>& found, double force, bool broken) {
    EXPECT_NEAR(found.first, force, 1e-13);
    EXPECT_EQ(found.second, broken);
  };
  expect(p_t(1.59), -1.59, false);  // 1 + 0.3 * 2
  expect(p_t(1.61), -0.6, true);
  expect(p_t(-2.19), 2.19, false);  // 1 + 0.6 * 2
  expect(p_t(-2.21), 1.2, true);
}

TEST(FrictionByDirection, IsNotTakenForOneCoefficientWhereItCannotBeKept) {
  const Problem problem = one_pair(0.3, 0.6, Eigen::Vector2d(-2.0, 1.0));
  EXPECT_THROW(text_of(problem), std::invalid_argument);
  SavedProblem saved;
  saved.problem = problem;
  const Scratch scratch;
  write_fclib(scratch.file("problem.hdf5"), saved);
  const Problem read = read_problem_file(scratch.file("problem.hdf5")).problem;
  EXPECT_EQ(read.mu, problem.mu);
  EXPECT_EQ(read.mu_backward, problem.mu_backward);
}

}  // namespace
}  // namespace scabo::contact
