// Problems without a solution, and the proof of it.
#include "scabo/contact/questions/infeasibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "compare/solvers.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/linalg/nonnegative_least_squares.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;
using namespace compare;

Problem coulomb(int d, const Matrix& W, const Vector& q, double mu) {
  Problem problem;
  problem.dimension = d;
  problem.W = Delassus(Eigen::SparseMatrix<double>(W.sparseView()));
  problem.q = q;
  problem.mu = Vector::Constant(q.size() / d, mu);
  problem.G.resize(q.size(), 0);
  problem.f.resize(0);
  return problem;
}

/// Blocks of unequal masses in `columns` columns between a floor and a ceiling, `patch` pairs on each face; what each
/// face closes by. Statics: a column can be solved exactly when the sum over its faces is not negative, a face counting
/// with a pair of its that closes most.
struct Stack {
  Problem problem;
  bool solvable = true;
};
Stack stack(std::mt19937& random, int d, int columns, int blocks, double squeezed) {
  const int faces = columns * (blocks + 1), patch = 2, pairs = faces * patch;
  Matrix H = Matrix::Zero(d * columns * blocks, d * pairs);
  Vector q = Vector::Zero(d * pairs), mass(columns * blocks);
  for (double& m : mass) m = uniform(random, 0.2, 5.0);
  Stack result;
  for (int column = 0; column < columns; ++column) {
    double sum = 0.0;
    for (int face = 0; face <= blocks; ++face) {
      const double gap = uniform(random, 0.0, 1.0) - (column == 0 ? squeezed : 0.0);
      sum += gap;
      for (int point = 0; point < patch; ++point) {
        const int pair = (column * (blocks + 1) + face) * patch + point;
        q[d * pair] = gap + (point == 0 ? 0.0 : uniform(random, 0.0, 0.5));
        for (int k = 0; k < d; ++k) {
          const double root_above = face < blocks ? 1.0 / std::sqrt(mass[column * blocks + face]) : 0.0;
          const double root_below = face > 0 ? 1.0 / std::sqrt(mass[column * blocks + face - 1]) : 0.0;
          if (face < blocks) H(d * (column * blocks + face) + k, d * pair + k) = root_above;
          if (face > 0) H(d * (column * blocks + face - 1) + k, d * pair + k) = -root_below;
        }
      }
    }
    if (sum < 0.0) result.solvable = false;
  }
  result.problem = coulomb(d, H.transpose() * H, q, 0.5);
  return result;
}

TEST(Infeasible, ColumnsSqueezedBetweenFloorAndCeiling) {
  std::mt19937 random(1201);
  int none = 0;
  for (int k = 0; k < 40; ++k) {
    const int d = 2 + k % 2;
    const Stack made = stack(random, d, whole(random, 1, 4), whole(random, 1, 6), uniform(random, 0.0, 1.0));
    const auto found = find_infeasibility(made.problem);
    EXPECT_EQ(found && found->proven, !made.solvable) << k;
    SolverOptions options;
    options.judge = Judge::natural_map;
    const Solution solution = solve(made.problem, {}, options);
    EXPECT_EQ(solution.status, made.solvable ? Status::solved : Status::infeasible) << k << ": " << solution.reason;
    if (made.solvable) continue;
    ++none;
    // The proof, from W, q and r alone.
    const Vector& r = solution.proof;
    ASSERT_EQ(r.size(), made.problem.q.size());
    EXPECT_GE(r.minCoeff(), 0.0);
    for (Eigen::Index i = 0; i < made.problem.pairs(); ++i)
      EXPECT_EQ(r.segment(d * i + 1, d - 1), Vector(Vector::Zero(d - 1)));
    EXPECT_LE((made.problem.W * r).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LT(made.problem.q.dot(r), 0.0);
    EXPECT_NE(solution.reason.find("the problem has no solution"), std::string::npos);
  }
  EXPECT_GT(none, 10);
  EXPECT_LT(none, 35);
}

/// Pair order[i] of `problem` becomes pair i, its tangents (in space) turned by angles[i].
Problem rearranged(const Problem& problem, const std::vector<int>& order, const Vector& angles) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < N; ++i) {
    const double c = d == 3 ? std::cos(angles[i]) : 1.0, s = d == 3 ? std::sin(angles[i]) : 0.0;
    const Eigen::Matrix3d turn{{1.0, 0.0, 0.0}, {0.0, c, s}, {0.0, -s, c}};
    for (int k = 0; k < d; ++k)
      for (int j = 0; j < d; ++j)
        entries.emplace_back(static_cast<int>(d * i + k), static_cast<int>(d * order[static_cast<std::size_t>(i)] + j),
                             turn(k, j));
  }
  Eigen::SparseMatrix<double> T(d * N, d * N);
  T.setFromTriplets(entries.begin(), entries.end());
  Problem result = problem;
  result.W = Delassus(Eigen::SparseMatrix<double>(T * problem.W.sparse() * T.transpose()));
  result.q = T * problem.q;
  for (Eigen::Index i = 0; i < N; ++i) result.mu[i] = problem.mu[order[static_cast<std::size_t>(i)]];
  return result;
}

// Ten times as many pairs as the other tests have, in other units, in another order and with other tangents.
TEST(Infeasible, OfManyPairsInAnyUnitsOrderAndAxes) {
  std::mt19937 random(1207);
  for (const int d : {2, 3}) {
    const Stack made = stack(random, d, 5, 49, 30.0);
    ASSERT_FALSE(made.solvable);
    ASSERT_EQ(made.problem.pairs(), 500);
    SolverOptions options;
    options.judge = Judge::natural_map;
    const auto proof_of = [&](const Problem& problem) {
      const Solution solution = solve(problem, {}, options);
      EXPECT_EQ(solution.status, Status::infeasible) << solution.reason;
      EXPECT_LE((problem.W * solution.proof).lpNorm<Eigen::Infinity>(), 1e-11 / stiffness_of(problem));
      EXPECT_LT(problem.q.dot(solution.proof), 0.0);
      return solution.proof;
    };
    const Vector proof = proof_of(made.problem);
    for (const int power : {-100, 100}) {
      Problem other = made.problem;
      other.W = made.problem.W.scaled(std::ldexp(1.0, power));
      other.q *= std::ldexp(1.0, -power);
      EXPECT_EQ(proof_of(other), proof) << power;
    }
    std::vector<int> order(500);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    Vector angles(500);
    for (double& angle : angles) angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
    proof_of(rearranged(made.problem, order, angles));
  }
}

TEST(Infeasible, EveryMethodSaysSo) {
  std::mt19937 random(1202);
  const Problem problem = stack(random, 2, 2, 3, 1.5).problem;
  for (const std::string& name : method_names()) {
    if (name == "quadratic_programme" || name.starts_with("siconos")) continue;
    SolverOptions options;
    options.judge = Judge::natural_map;
    EXPECT_EQ(solve_with(*method_named(name), problem, {}, options).status, Status::infeasible) << name;
  }
}

TEST(Infeasible, TheProofIsTakenAtNobodysWord) {
  std::mt19937 random(1203);
  const Problem problem = stack(random, 3, 1, 4, 1.5).problem;
  const auto found = find_infeasibility(problem);
  ASSERT_TRUE(found && found->proven);
  EXPECT_TRUE(proves_no_motion(problem, found->r));
  EXPECT_TRUE(proves_no_motion(problem, 1e-30 * found->r));
  EXPECT_FALSE(proves_no_motion(problem, -found->r));  // pulls
  EXPECT_FALSE(proves_no_motion(problem, Vector(Vector::Zero(problem.q.size()))));
  Vector moves = found->r;
  moves[0] += 1e-3;
  EXPECT_FALSE(proves_no_motion(problem, moves));  // W r is not 0
  Problem apart = problem;
  apart.q = -problem.q;
  EXPECT_FALSE(proves_no_motion(apart, found->r));  // q.r > 0
  Vector outside = found->r;
  outside[1] = found->r[0];
  EXPECT_FALSE(proves_no_motion(problem, outside));  // |r_t| > mu r_n
}

/// u = q + W p of one pair.
Problem wedge(const Eigen::Vector3d& w, const Eigen::Vector3d& q, double mu) {
  Problem problem = coulomb(3, w * w.transpose(), q, mu);
  problem.W = Matrix(w * w.transpose());
  return problem;
}

TEST(Infeasible, APairThatIsWedged) {
  const Problem problem = wedge({1.0, 2.0, 0.0}, {-1.0, -1.0, 0.0}, 1.0);
  for (const Judge by : {Judge::natural_map, Judge::certificate}) {
    SolverOptions options;
    options.judge = by;
    const Solution solution = solve(problem, {}, options);
    EXPECT_NE(solution.status, Status::solved);
    if (by == Judge::certificate) continue;
    EXPECT_EQ(solution.status, Status::infeasible);
    const Vector& r = solution.proof;
    EXPECT_LE((problem.W * r).norm(), 1e-12 * r.norm());
    EXPECT_LT(problem.q.dot(r), 0.0);
    EXPECT_LE(r.tail(2).norm(), r[0]);
  }
}

// W r = 0, q.r < 0 with r in the cone is no proof by itself: forces of zero solve this one.
TEST(Infeasible, IsNotSaidWhereOnlyTheExistenceTheoremFails) {
  Matrix W(2, 2);
  W << 1.0, -2.0, -2.0, 4.0;
  const Problem problem = coulomb(2, W, Vec2(1.0, -5.0), 0.5);
  const Vector r = Vec2(2.0, 1.0);
  ASSERT_LT(problem.q.dot(r), 0.0);
  ASSERT_TRUE(proves_no_motion(problem, r));
  const auto found = find_infeasibility(problem);
  EXPECT_FALSE(found && found->proven);
  SolverOptions options;
  options.judge = Judge::natural_map;
  const Solution solution = solve(problem, {}, options);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(solution.p, Vector(Vector::Zero(2)));
}

/// Least distance of slip along any of many directions from the law of one pair, by brute force.
double distance_of_slip(const Problem& problem) {
  const Matrix W = problem.W.dense();
  double least = HUGE_VAL;
  constexpr int directions = 4000;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / directions, mu = problem.mu[0];
    Matrix columns(3, 2);
    columns << W * Eigen::Vector3d(1.0, -mu * std::cos(angle), -mu * std::sin(angle)),
        Eigen::Vector3d(0.0, -std::cos(angle), -std::sin(angle));
    least = std::min(least, (problem.q + columns * linalg::nonnegative_least_squares(columns, -problem.q)).norm());
  }
  return least;
}

TEST(Infeasible, OnePairAgainstAllDirectionsOfSlip) {
  std::mt19937 random(1204);
  int proven = 0;
  for (int k = 0; k < 150; ++k) {
    const auto any = [&] {
      return Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    };
    Problem problem = wedge(any(), any(), uniform(random, 0.2, 2.0));
    if (k % 2 == 0) {  // rank 2
      const Eigen::Vector3d w = any();
      problem.W = Matrix(problem.W.dense() + w * w.transpose());
    }
    const auto found = find_infeasibility(problem);
    if (!found || !found->proven) continue;
    ++proven;
    EXPECT_LT(problem.q[0], 0.0);
    EXPECT_GT(distance_of_slip(problem), 1e-7) << k;
    SolverOptions options;
    options.judge = Judge::natural_map;
    EXPECT_EQ(solve(problem, {}, options).status, Status::infeasible) << k;
  }
  EXPECT_GT(proven, 5);
}

TEST(NonnegativeLeastSquares, TheSameFromNormalEquations) {
  std::mt19937 random(1205);
  for (int k = 0; k < 30; ++k) {
    const int rows = whole(random, 5, 40), columns = whole(random, 1, 30);
    const Matrix A = Matrix::NullaryExpr(rows, columns, [&] { return uniform(random, -1, 1); });
    const Vector b = Vector::NullaryExpr(rows, [&] { return uniform(random, -1, 1); });
    const auto residual = [&](const Vector& x) { return Vector(A.transpose() * (b - A * x)); };
    const Vector x = linalg::nonnegative_least_squares_of_normal(A.transpose() * A, A.transpose() * b, residual);
    EXPECT_GE(x.minCoeff(), 0.0);
    EXPECT_NEAR((b - A * x).norm(), (b - A * linalg::nonnegative_least_squares(A, b)).norm(), 1e-10) << k;
  }
}

}  // namespace
}  // namespace scabo::contact
