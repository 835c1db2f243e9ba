// Interior points and long sweeps on towers of rigid blocks: W = H' M^-1 H has far fewer independent rows than pairs.
// What they find is asked of the law itself, pair by pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include "scabo/contact/interior/held_slips.hpp"
#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/newton/newton.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"
#include "scabo/contact/sweeps/long_sweeps.hpp"
#include "unit/contact/problems.hpp"
#include "unit/contact/towers.hpp"

namespace scabo::contact {
namespace {

/// W and q times the stiffness of the problem: motions are forces.
Problem in_unit_stiffness(Problem problem) {
  const double stiffness = stiffness_of(problem);
  problem.W = problem.W.scaled(stiffness);
  problem.q *= stiffness;
  return problem;
}

class InteriorPointsOnTowers : public ::testing::TestWithParam<TowerCase> {};

TEST_P(InteriorPointsOnTowers, ThenNewtonToTheLastDigits) {
  const auto [d, blocks, points] = GetParam();
  const Problem problem = tower_of_blocks(d, blocks, points, 0.4);
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-9;
  const Solution solution = solve(problem, {}, options);
  ASSERT_EQ(solution.status, Status::solved) << solution.reason;
  expect_the_law(problem, solution.p, 1e-8);
}

TEST_P(InteriorPointsOnTowers, UnitsThatArePowersOfTwoChangeNoBit) {
  const auto [d, blocks, points] = GetParam();
  const Problem problem = tower_of_blocks(d, blocks, points, 0.4);
  const InteriorPointEnd end = interior_points(problem, {});
  Problem other = problem;  // forces as before
  other.W = problem.W.scaled(std::ldexp(1.0, 20));
  other.q *= std::ldexp(1.0, 20);
  EXPECT_EQ(interior_points(other, {}).p, end.p);
  other = problem;  // forces 2^20 times as large
  other.q *= std::ldexp(1.0, 20);
  EXPECT_EQ(interior_points(other, {}).p, Vector(std::ldexp(1.0, 20) * end.p));
}

constexpr std::pair<int, int> powers_of_two[] = {{100, 0}, {-100, 0}, {37, 0}, {100, 100}, {-100, -100}, {37, 37}};

TEST_P(InteriorPointsOnTowers, SolvedInUnitsThatArePowersOfTwoTheyChangeNoBit) {
  const auto [d, blocks, points] = GetParam();
  const Problem problem = tower_of_blocks(d, blocks, points, 0.8, 1000.0);
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-9;
  const Solution solution = solve(problem, {}, options);
  EXPECT_EQ(solution.status, Status::solved) << solution.reason;
  for (const auto& [of_W, of_q] : powers_of_two) {
    SCOPED_TRACE("W 2^" + std::to_string(of_W) + ", q 2^" + std::to_string(of_q));
    Problem other = problem;
    other.W = problem.W.scaled(std::ldexp(1.0, of_W));
    other.q *= std::ldexp(1.0, of_q);
    const Solution in_units = solve(other, {}, options);
    EXPECT_EQ(in_units.status, solution.status);
    EXPECT_EQ(in_units.iterations, solution.iterations);
    EXPECT_EQ(in_units.states, solution.states);
    EXPECT_EQ(in_units.p, Vector(std::ldexp(1.0, of_q - of_W) * solution.p));
    EXPECT_EQ(in_units.gap, Vector(std::ldexp(1.0, of_q) * solution.gap));
    EXPECT_EQ(in_units.natural_map_residual, solution.natural_map_residual);
  }
}

// Newton's directions where pairs are redundant, as they follow interior points: by GMRES, several of whose directions
// are needed. Those of forces 2^100 times as large were others.
TEST_P(InteriorPointsOnTowers, NewtonFollowsThemInUnitsThatArePowersOfTwoWithoutChangingABit) {
  const auto [d, blocks, points] = GetParam();
  const Problem problem = tower_of_blocks(d, blocks, points, 0.8, 1000.0);
  LongSweeps sweeps(problem, Vector::Zero(problem.q.size()));
  sweeps.run(100, {});
  const auto direction_of = [&](int of_W, int of_q) {
    Problem given = problem;
    given.W = problem.W.scaled(std::ldexp(1.0, of_W));
    given.q *= std::ldexp(1.0, of_q);
    const Problem other = in_unit_stiffness(given);
    const BDifferentiableEquations equations(other, 1.0);
    NewtonDirection direction(equations);
    const Vector p = std::ldexp(1.0, of_q - of_W) * sweeps.p();
    Residual at = equations.residual(p, Vector());
    Vector found;
    EXPECT_TRUE(direction.find(at, 1e-6, found));
    return found;
  };
  const Vector direction = direction_of(0, 0);
  for (const auto& units : powers_of_two)
    EXPECT_EQ(direction_of(units.first, units.second), Vector(std::ldexp(1.0, units.second - units.first) * direction))
        << units.first << " " << units.second;
}

INSTANTIATE_TEST_SUITE_P(Plane, InteriorPointsOnTowers, ::testing::Values(TowerCase{2, 20, 2}, TowerCase{2, 8, 4}));
INSTANTIATE_TEST_SUITE_P(Space, InteriorPointsOnTowers, ::testing::Values(TowerCase{3, 12, 3}));

/// Accepts a natural map of 1e-10.
IsSolution within_1e10(const Problem& problem) {
  return [&problem, measure = Measure(problem)](const Vector& p, const Vector&, const Vector& motion) {
    return measure.natural_map(problem, p, motion) <= 1e-10;
  };
}

TEST(LongSweeps, ReachTheLawWithAThirdOfThePlainOnes) {
  for (const TowerCase& tower : {TowerCase{2, 6, 2}, TowerCase{2, 4, 4}, TowerCase{3, 3, 3}}) {
    const Problem problem = tower_of_blocks(tower.dimension, tower.blocks, tower.points, 0.4);
    LongSweeps sweeps(problem, Vector::Zero(problem.q.size()));
    ASSERT_TRUE(sweeps.run(100000, within_1e10(problem)));
    EXPECT_LE(sweeps.natural_map(), 1e-10);
    expect_the_law(problem, sweeps.p(), 1e-8);
    const Vector plain = test::swept_forces(problem, 3 * sweeps.sweeps());
    EXPECT_GT(natural_map_residual(problem, plain, Vector()), 1e-10) << sweeps.sweeps();
  }
}

/// Three pairs in space with a W of rank 4, from a known solution: one open, sticking or sliding pair after the other.
Problem three_pairs(int seed) {
  constexpr Eigen::Index n = 9;
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part;
  const Matrix B = Matrix::NullaryExpr(n, 4, [&] { return normal(random); });
  Problem problem;
  problem.mu = Vector::Constant(3, 0.8);
  problem.W = Delassus(Matrix(B * B.transpose()));
  Vector p = Vector::Zero(n), u = Vector::Zero(n);
  for (Eigen::Index first = 0; first < n; first += 3) {
    const auto state = random() % 3;
    const double angle = 6.28 * part(random), force = 0.1 + part(random), share = part(random);
    const Vec2 along(std::cos(angle), std::sin(angle));
    if (state == 0) {
      u.segment<3>(first) = Eigen::Vector3d(share, along[0], along[1]);
      continue;
    }
    p[first] = force;
    p.segment<2>(first + 1) = (state == 1 ? 0.5 * share : 1.0) * 0.8 * force * along;
    if (state == 2) u.segment<2>(first + 1) = -share * along;
  }
  problem.q = u - problem.W * p;
  return problem;
}

// In one order three pairs may go around between their states for ever; in orders drawn anew they settle more often.
TEST(Sweeps, InOrdersDrawnAnewSettleWhereThoseInOneOrderGoAround) {
  std::minstd_rand random;
  int settled = 0;
  for (int seed = 0; seed < 2000; ++seed) {
    const Problem problem = three_pairs(seed);
    if (natural_map_residual(problem, test::swept_forces(problem, 2000), Vector()) <= 1e-3) continue;
    const auto sweeps = gauss_seidel(problem);
    Vector p = Vector::Zero(9);
    sweeps->start(p);
    for (int sweep = 0; sweep < 5000; ++sweep) {
      sweeps->reorder(random);
      sweeps->sweep(p);
    }
    settled += natural_map_residual(problem, p, Vector()) <= 1e-10 ? 1 : 0;
  }
  EXPECT_GE(settled, 3);
}

TEST(LongSweeps, EndWhereNothingIsGainedOrTheTimeIsOver) {
  // Both normals want the force up, and what one gives the other takes: forces run away for ever.
  Problem problem;
  problem.dimension = 2;
  Eigen::SparseMatrix<double> W(4, 4);
  for (const auto& [row, column, value] : {std::tuple(0, 0, 1.0), {0, 2, -1.0}, {2, 0, -1.0}, {2, 2, 1.0}})
    W.insert(row, column) = value;
  problem.W = Delassus(W);
  problem.q = (Vector(4) << -1.0, 0.0, -1.0, 0.0).finished();
  problem.mu = Vector::Constant(2, 0.5);
  LongSweeps sweeps(problem, Vector::Zero(4));
  EXPECT_FALSE(sweeps.run(1000, within_1e10(problem)));
  EXPECT_LE(sweeps.sweeps(), 8000);  // four times what was asked for of either kind, however much they seem to gain
  EXPECT_TRUE(sweeps.p().allFinite());
  EXPECT_FALSE(LongSweeps(problem, Vector::Zero(4)).run(1000, {}, Deadline::in(0.0)));
}

// Elastic bodies that contact alone holds: the balance of the rigid motions belongs to the system. Newton on the same
// problems, and a judge that shares nothing with either, are the oracle.
TEST(InteriorPoints, BalanceTheRigidMotionsOfElasticBodies) {
  std::mt19937 random(11);
  int asked = 0, reached = 0;
  for (int sample = 0; sample < 40; ++sample) {
    const Problem problem = test::floating_problem(random, 8 + sample, 1.0);
    if (problem.mu.minCoeff() <= 0.0 || !may_take_interior_points(problem)) continue;
    const Solution by_newton = solve(problem);
    if (by_newton.status != Status::solved) continue;
    ++asked;
    const Measure measure(problem);
    const auto accepts = [&](const Vector& p, const Vector& a, const Vector& motion) {
      // As in a run: the certificate takes complementarity as a product, of which either factor may be 1e-5.
      return measure.natural_map(problem, p, motion) <= 1e-9 &&
             judge(problem, p, a, motion, measure, Judge::certificate).solved(1e-10);
    };
    InteriorPointEnd end;
    for (const double start : {1.0, 10.0, 1000.0})
      if (!end.accepted) end = interior_points(problem, accepts, {}, start);
    if (!end.accepted) continue;  // the problem is not convex
    ++reached;
    EXPECT_LT(test::violation(problem, end.p, end.a), 1e-6) << sample;
    EXPECT_LT((problem.G.transpose() * end.p + problem.f).norm(), 1e-9 * problem.f.norm()) << sample;
  }
  EXPECT_GE(asked, 25);
  EXPECT_GE(10 * reached, 9 * asked) << reached << " of " << asked;
}

struct LawCase {
  const char* name;
  void (*give)(Problem& problem, double force);  ///< the law, with strengths in proportion to a mean force
};

void PrintTo(const LawCase& law, std::ostream* out) { *out << law.name; }

class InteriorPointsForLaws : public ::testing::TestWithParam<LawCase> {};

/// Floating blocks with pairs of other laws.
TEST_P(InteriorPointsForLaws, FindForcesOfFloatingBlocks) {
  std::mt19937 random(8);
  int solved = 0, solvable = 0;
  for (int k = 0; k < 40; ++k) {
    Problem problem = in_unit_stiffness(test::floating_problem(random, 10 + k, 0.8));
    const double force = problem.f.lpNorm<Eigen::Infinity>() / problem.pairs();
    GetParam().give(problem, force);
    if (solve(problem).status != Status::solved) continue;
    ++solvable;
    const InteriorPointEnd end = interior_points(problem, {}, {}, 1.0, 1e-6);
    if (end.residual > 1e-6) continue;  // a path that turned back
    ++solved;
    const BDifferentiableEquations equations(problem, 1.0);
    const NewtonEnd exact = newton(equations, end.p, end.a, {.relative = 1e-13});
    EXPECT_TRUE(exact.converged) << k;
    EXPECT_LT(test::violation(problem, exact.p, exact.a), 1e-9) << k;
  }
  EXPECT_GT(solvable, 15);
  EXPECT_GE(solved, solvable - 2);
}

INSTANTIATE_TEST_SUITE_P(All, InteriorPointsForLaws,
                         ::testing::Values(LawCase{"WithoutFriction",
                                                   [](Problem& problem, double) {
                                                     for (int i = 0; i < problem.pairs(); i += 3) problem.mu[i] = 0.0;
                                                   }},
                                           LawCase{"FrictionByDirection",
                                                   [](Problem& problem, double) {
                                                     problem.mu_backward = 0.5 * problem.mu;
                                                   }},
                                           LawCase{"Cohesion",
                                                   [](Problem& problem, double force) {
                                                     problem.cohesion = Vector::Constant(problem.pairs(), 0.3 * force);
                                                   }},
                                           LawCase{"CohesionAndTension",
                                                   [](Problem& problem, double force) {
                                                     problem.cohesion = Vector::Constant(problem.pairs(), 0.5 * force);
                                                     problem.tension = Vector::Constant(problem.pairs(), 0.2 * force);
                                                   }},
                                           LawCase{"ShearStrength",
                                                   [](Problem& problem, double force) {
                                                     problem.mu.setZero();
                                                     problem.cohesion = Vector::Constant(problem.pairs(), 0.3 * force);
                                                   }},
                                           LawCase{"BondedAtTheEnds",
                                                   [](Problem& problem, double) {
                                                     problem.cohesion = problem.tension = Vector::Zero(problem.pairs());
                                                     for (const int i : {0, problem.pairs() - 1})
                                                       problem.cohesion[i] = problem.tension[i] = HUGE_VAL;
                                                   }}),
                         [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace scabo::contact
