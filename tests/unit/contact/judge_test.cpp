// The judge: units, rounding, time limits, problems without pairs.
#include "scabo/contact/judge.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "compare/solvers.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;
using namespace compare;

/// Motions times `s t`, flexibilities times `s`, so forces times `t`.
Problem in_other_units(const Problem& problem, double s, double t) {
  Problem other = problem;
  other.W = problem.W.scaled(s);
  other.q = s * t * problem.q;
  other.cohesion = t * problem.cohesion;
  other.tension = t * problem.tension;
  other.f = t * problem.f;
  return other;
}

/// W of rigid blocks in a row that touch their neighbours and the floor: rank deficient, one block for each two pairs.
Problem rigid_row(std::mt19937& random, int d, int blocks, double mu) {
  const int pairs = 3 * blocks - 1;
  Matrix H = Matrix::Zero(d * blocks, d * pairs);
  int pair = 0;
  const auto touch = [&](int block, int other) {
    for (int k = 0; k < d; ++k) {
      H(d * block + k, d * pair + k) += 1.0;
      if (other >= 0) H(d * other + k, d * pair + k) -= 1.0;
    }
    ++pair;
  };
  for (int block = 0; block < blocks; ++block) {
    touch(block, -1), touch(block, -1);
    if (block > 0) touch(block, block - 1);
  }
  const Vector load = Vector::NullaryExpr(d * blocks, [&](Eigen::Index k) {
    return k % d == 0 ? uniform(random, -2.0, -0.5) : uniform(random, -0.3, 0.3);
  });
  Problem problem;
  problem.dimension = d;
  problem.W = Delassus(Eigen::SparseMatrix<double>(Matrix(H.transpose() * H).sparseView()));
  problem.q = H.transpose() * load;
  problem.mu = Vector::Constant(pairs, mu);
  problem.G.resize(d * pairs, 0);
  problem.f.resize(0);
  return problem;
}

std::vector<Problem> problems_of_all_kinds() {
  std::mt19937 random(1101);
  std::vector<Problem> problems;
  for (int d : {2, 3}) {
    problems.push_back(held_problem(random, 9, 0.9, d));
    problems.push_back(held_problem(random, 60, 0.6, d));  // starts on fewer pairs (plane)
    problems.push_back(rigid_row(random, d, 7, 0.4));
    Problem strong = held_problem(random, 6, 0.4, d);
    strong.cohesion = Vector::Constant(6, 0.2);
    strong.tension = Vector::Constant(6, 0.1);
    problems.push_back(strong);
    Problem still = held_problem(random, 3, 0.4, d);
    still.q.setZero();
    problems.push_back(still);
    Problem wedged;  // no solution
    wedged.dimension = d;
    Matrix W = Matrix::Zero(d, d);
    W.topLeftCorner(2, 2) << 1.0, 2.0, 2.0, 4.0;
    wedged.W = W;
    wedged.q = Vector::Zero(d);
    wedged.q.head(2).setConstant(-1.0);
    wedged.mu = Vector::Ones(1);
    wedged.G.resize(d, 0);
    wedged.f.resize(0);
    problems.push_back(wedged);
  }
  for (int k = 0; k < 4; ++k) problems.push_back(floating_problem(random, 5, 0.6));
  return problems;
}

// Every quantity of the answer to the last bit: nothing in the solver or the judge knows a unit.
TEST(Units, PowersOfTwoChangeNoBit) {
  const double large = std::ldexp(1.0, 100);
  int number = 0;
  for (const Problem& problem : problems_of_all_kinds()) {
    ++number;
    const bool wedged = problem.pairs() == 1;
    for (const Judge by : {Judge::certificate, Judge::natural_map})
      for (const double r_factor : {1.0, 0.3}) {
        // Without the proof its forces run away until a double holds no more: that limit knows units.
        if (wedged && by == Judge::certificate) continue;
        SolverOptions options;
        options.judge = by;
        options.r_factor = r_factor;
        const Solution reference = solve(problem, {}, options);
        for (const auto& [s, t] : {std::array{large, 1.0}, std::array{1.0 / large, 1.0}, std::array{1.0, large},
                                   std::array{1.0, 1.0 / large}, std::array{large, large},
                                   std::array{1.0 / large, large}, std::array{1.0 / large, 1.0 / large}}) {
          const Solution solution = solve(in_other_units(problem, s, t), {}, options);
          const auto where = testing::Message() << "problem " << number << ", W times 2^" << std::log2(s)
                                                << ", forces times 2^" << std::log2(t) << ", r times " << r_factor;
          EXPECT_EQ(solution.status, reference.status) << where;
          EXPECT_EQ(solution.iterations, reference.iterations) << where;
          EXPECT_EQ(solution.p, Vector(t * reference.p)) << where;
          EXPECT_EQ(solution.a, Vector(s * t * reference.a)) << where;
          EXPECT_EQ(solution.natural_map_residual, reference.natural_map_residual) << where;
          EXPECT_EQ(solution.rounding, reference.rounding) << where;
          EXPECT_EQ(solution.certificate.worst(), reference.certificate.worst()) << where;
          EXPECT_EQ(solution.states, reference.states) << where;
        }
      }
  }
}

// Units that are no power of two: rounding differs, what is solved does not.
TEST(Units, AnElasticProblemInPascalsIsSolvedAsInGigapascals) {
  std::mt19937 random(1102);
  for (int d : {2, 3})
    for (int k = 0; k < 5; ++k) {
      const Problem problem = held_problem(random, 20, 1.5, d);
      SolverOptions options;
      options.judge = Judge::natural_map;
      const Solution reference = solve(problem, {}, options);
      for (const double s : {1e-12, 1e-9, 1e8, 1e12}) {
        const Solution solution = solve(in_other_units(problem, s, 1.0 / s), {}, options);
        ASSERT_EQ(solution.status, reference.status) << s;
        if (solution.status != Status::solved) continue;
        EXPECT_LT((s * solution.p - reference.p).norm(), 1e-8 * reference.p.norm()) << s;
        EXPECT_LT(violation(problem, s * solution.p, Vector()), 1e-8) << s;
      }
    }
}

TEST(Units, TheNaturalMapIsTheOneOfFclibOnAScaledProblem) {
  std::mt19937 random(1103);
  const Problem problem = held_problem(random, 8, 0.5, 3);  // mean W_ii = 1
  const Vector p = Vector::NullaryExpr(24, [&] { return uniform(random, -1.0, 1.0); });
  const Vector u = problem.q + problem.W * p;
  double sum = 0.0;  // Acary, Bremond, Huber 2018, written out
  for (int i = 0; i < 8; ++i) {
    Eigen::Vector3d x = p.segment<3>(3 * i) - u.segment<3>(3 * i);
    x[0] -= problem.mu[i] * u.segment<2>(3 * i + 1).norm();
    const double size = x.tail<2>().norm(), mu = problem.mu[i];
    Eigen::Vector3d nearest = x;
    if (size > mu * x[0]) {
      const double normal = std::max(0.0, (x[0] + mu * size) / (1.0 + mu * mu));
      nearest << normal, mu * normal / size * x.tail<2>();
    }
    sum += (p.segment<3>(3 * i) - nearest).squaredNorm();
  }
  const double expected = std::sqrt(sum) / problem.q.norm();
  EXPECT_NEAR(natural_map_residual(problem, p, Vector()), expected, 1e-13 * expected);
  for (const double s : {1e-9, 3.0, 1e12})
    EXPECT_NEAR(natural_map_residual(in_other_units(problem, s, 7.0), 7.0 * p, Vector()), expected, 1e-12 * expected);
}

/// W r = 0 for r = [2, -1, 0] inside the cone, q.r < 0.
Problem jam() {
  Problem problem;
  problem.dimension = 3;
  Matrix W = Matrix::Zero(3, 3);
  W.topLeftCorner(2, 2) << 1.0, 2.0, 2.0, 4.0;
  problem.W = W;
  problem.q = Eigen::Vector3d(-1.0, -1.0, 0.0);
  problem.mu = Vector::Ones(1);
  problem.G.resize(3, 0);
  problem.f.resize(0);
  return problem;
}

// Forces so large that p - u is p again, to the last bit: every condition holds on paper, and the gap is -1.
TEST(Rounding, NoCertificateOfZerosOnAnAnswerThatIsLostInIt) {
  const Problem problem = jam();
  const Measure measure(problem);
  for (const double size : {1e12, 1e20, 3.5e41, 1e200}) {
    const Vector p = size * Eigen::Vector3d(2.0, -1.0, 0.0), u = motion_of(problem, p, Vector());
    ASSERT_LT(u[0], -0.5);
    for (const Judge by : {Judge::certificate, Judge::natural_map})
      EXPECT_FALSE(judge(problem, p, Vector(), u, measure, by).solved(1e-10)) << size;
    EXPECT_GE(judge(problem, p, Vector(), u, measure, Judge::certificate).certificate.penetration, 0.5) << size;
  }
  // The natural map itself does not see it: rounding has to be asked.
  const Vector p = 1e20 * Eigen::Vector3d(2.0, -1.0, 0.0), u = motion_of(problem, p, Vector());
  EXPECT_EQ(measure.natural_map(problem, p, u), 0.0);
  EXPECT_GT(measure.rounding(problem, p, u), 1.0);
  // A start that large is no load: it does not make small what it is compared with.
  for (const Judge by : {Judge::certificate, Judge::natural_map}) {
    SolverOptions options;
    options.judge = by;
    EXPECT_NE(solve(problem, {p, Vector()}, options).status, Status::solved);
    EXPECT_NE(solve(problem, {}, options).status, Status::solved);
  }
}

// Two pairs that press against each other, p = [lambda, lambda] + exact answer, W (1, 1) = 0.
TEST(Rounding, IsToldWhereItHidesTheAnswer) {
  Problem problem;
  Matrix W = Matrix::Zero(4, 4);
  W(0, 0) = W(2, 2) = 1.0, W(0, 2) = W(2, 0) = -1.0, W(1, 1) = W(3, 3) = 1.0;
  problem.W = W;
  problem.q = Eigen::Vector4d(-1.0, 0.0, 1.0, 0.0);
  problem.mu = Vector::Zero(2);
  problem.G.resize(4, 0);
  problem.f.resize(0);
  const Measure measure(problem);
  for (const double lambda : {0.0, 1.0, 1e3, 1e8, 1e12}) {
    const Vector p = Eigen::Vector4d(1.0 + lambda, 0.0, lambda, 0.0), u = motion_of(problem, p, Vector());
    ASSERT_EQ(u, Vector(Vector::Zero(4)));
    const Judgement judgement = judge(problem, p, Vector(), u, measure, Judge::natural_map);
    EXPECT_EQ(judgement.figure, 0.0);
    // eps sum |W| |p| / |q|, with mean W_ii = 1.
    EXPECT_NEAR(judgement.rounding, 2.220446049250313e-16 * (1.0 + 2.0 * lambda), 1e-15 * (1e-3 + lambda));
    EXPECT_EQ(judgement.solved(1e-10), lambda <= 1e3);
    const std::string reason = reason_of(judgement, Judge::natural_map, 1e-10, "it ended");
    if (lambda > 1e3) EXPECT_NE(reason.find("uncertain"), std::string::npos) << reason;
  }
}

TEST(TimeLimit, TheBestPointIsHandedBack) {
  std::mt19937 random(1104);
  for (int d : {2, 3}) {
    const Problem problem = held_problem(random, 60, 0.9, d);
    for (const std::string& name : method_names()) {
      // Lemke's pivots and Siconos end by themselves.
      if (name == "quadratic_programme" || name == "lemke" || name.starts_with("siconos")) continue;
      SolverOptions options;
      options.judge = Judge::natural_map;
      options.tolerance = 1e-15;
      options.deadline = Deadline::in(0.0);
      const Solution solution = solve_with(*method_named(name), problem, {}, options);
      EXPECT_EQ(solution.status, Status::not_converged) << name;
      EXPECT_NE(solution.reason.find("the time limit of 0 s"), std::string::npos) << solution.reason;
      EXPECT_TRUE(solution.p.allFinite());
      EXPECT_LE(solution.natural_map_residual, 1.5 * natural_map_residual(problem, Vector::Zero(problem.q.size()), {}))
          << name;
    }
    SolverOptions options;  // enough time changes nothing
    options.judge = Judge::natural_map;
    const Solution without = solve(problem, {}, options);
    options.deadline = Deadline::in(1e4);
    EXPECT_EQ(solve(problem, {}, options).p, without.p);
  }
}

TEST(NoPairs, AreSolvedByEveryMethod) {
  for (int d : {2, 3}) {
    Problem none;
    none.dimension = d;
    none.W = Matrix(Matrix::Zero(0, 0));
    none.q.resize(0), none.mu.resize(0), none.G.resize(0, 0), none.f.resize(0);
    for (const Judge by : {Judge::certificate, Judge::natural_map})
      for (const std::string& name : method_names()) {
        SolverOptions options;
        options.judge = by;
        const Solution solution = solve_with(*method_named(name), none, {}, options);
        EXPECT_EQ(solution.status, Status::solved) << name;
        EXPECT_EQ(solution.p.size(), 0);
        EXPECT_TRUE(solution.states.empty());
      }
  }
}

}  // namespace
}  // namespace scabo::contact
