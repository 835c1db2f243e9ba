// Friction in space: random problems, redundant pairs, and what must not depend on the frame.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

TEST(Space, RandomProblemsAreSolvedAndCertified) {
  std::mt19937 random(61);
  for (int k = 0; k < 300; ++k) {
    const Problem problem = held_problem(random, whole(random, 1, 15), 0.8, 3);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved) << "problem " << k << ": " << solution.reason;
    EXPECT_LE(solution.certificate.worst(), 1e-10);
    EXPECT_LT(violation(problem, solution.p, Vector()), 1e-8) << "problem " << k;
    EXPECT_LT(solution.natural_map_residual, 1e-9);
  }
}

TEST(Space, AgreesWithGaussSeidel) {
  std::mt19937 random(62);
  int compared = 0;
  for (int k = 0; k < 60; ++k) {
    const Problem problem = held_problem(random, whole(random, 1, 6), 0.3, 3);
    const Vector p = swept_forces(problem, 20000);
    if (violation(problem, p, Vector()) > 1e-9) continue;
    ++compared;
    EXPECT_LT((solve(problem).p - p).cwiseAbs().maxCoeff(), 1e-7) << "problem " << k;
  }
  EXPECT_GT(compared, 50);
}

// Tangents turned in every pair's own plane: the same forces, turned.
TEST(Space, ForcesTurnWithTheTangents) {
  std::mt19937 random(63);
  for (int k = 0; k < 40; ++k) {
    const int pairs = whole(random, 1, 8);
    const Problem problem = held_problem(random, pairs, 0.5, 3);
    Matrix R = Matrix::Identity(3 * pairs, 3 * pairs);
    for (int i = 0; i < pairs; ++i)
      R.block<2, 2>(3 * i + 1, 3 * i + 1) = Eigen::Rotation2Dd(uniform(random, 0, 6.3)).toRotationMatrix();
    Problem turned = problem;
    turned.W = Matrix(R * problem.W.dense() * R.transpose());
    turned.q = R * problem.q;
    const Solution first = solve(problem), second = solve(turned);
    ASSERT_EQ(first.status, Status::solved);
    ASSERT_EQ(second.status, Status::solved);
    EXPECT_LT((R * first.p - second.p).cwiseAbs().maxCoeff(), 1e-8 * (1.0 + first.p.cwiseAbs().maxCoeff()));
  }
}

// The plane is space in which nothing happens across.
TEST(Space, ThePlaneIsItsSpecialCase) {
  std::mt19937 random(64);
  for (int k = 0; k < 60; ++k) {
    const int pairs = whole(random, 1, 10);
    const Problem plane = held_problem(random, pairs, 0.7);
    Problem space;
    space.dimension = 3;
    Matrix W = Matrix::Zero(3 * pairs, 3 * pairs);
    space.q = Vector::Zero(3 * pairs);
    space.mu = plane.mu;
    space.G.resize(3 * pairs, 0);
    for (int i = 0; i < pairs; ++i) {
      space.q.segment<2>(3 * i) = plane.q.segment<2>(2 * i);
      for (int j = 0; j < pairs; ++j) W.block<2, 2>(3 * i, 3 * j) = plane.W.dense().block<2, 2>(2 * i, 2 * j);
      W(3 * i + 2, 3 * i + 2) = plane.W.dense()(2 * i + 1, 2 * i + 1);
    }
    space.W = W;
    const Solution flat = solve(plane), full = solve(space);
    ASSERT_EQ(flat.status, Status::solved);
    ASSERT_EQ(full.status, Status::solved);
    double difference = 0.0;
    for (int i = 0; i < pairs; ++i) {
      difference = std::max(difference, (flat.p.segment<2>(2 * i) - full.p.segment<2>(3 * i)).cwiseAbs().maxCoeff());
      difference = std::max(difference, std::abs(full.p[3 * i + 2]));
    }
    EXPECT_LT(difference, 1e-8 * (1.0 + flat.p.cwiseAbs().maxCoeff())) << "problem " << k;
  }
}

/// Blocks that many more pairs touch than they have motions: W = B B' of low rank, and q such that it can be solved.
Problem redundant(std::mt19937& random, int pairs, int d, int rank) {
  Problem problem;
  problem.dimension = d;
  Matrix B = Matrix::NullaryExpr(d * pairs, rank, [&] { return uniform(random, -1, 1); });
  for (int i = 0; i < pairs; ++i) B.row(d * i).array() += 1.0;  // pressed together along a common motion
  problem.q = B * Vector::NullaryExpr(rank, [&] { return uniform(random, -1, 1); });
  problem.q -= B * Vector::Constant(rank, uniform(random, 0.0, 1.0));
  problem.W = Matrix(B * B.transpose());
  problem.mu = Vector::Constant(pairs, uniform(random, 0.1, 0.9));
  problem.G.resize(d * pairs, 0);
  return problem;
}

TEST(RankDeficient, RedundantPairsAreSolvedInTheNaturalMap) {
  std::mt19937 random(65);
  int solved = 0;
  for (int k = 0; k < 200; ++k) {
    const int d = 2 + k % 2, pairs = whole(random, 3, 20);
    const Problem problem = redundant(random, pairs, d, whole(random, 3, 6));
    SolverOptions options;
    options.judge = Judge::natural_map;
    options.tolerance = 1e-8;
    const Solution solution = solve(problem, {}, options);
    if (solution.status == Status::solved) {
      ++solved;
      EXPECT_LE(solution.natural_map_residual, 1e-8) << "problem " << k;
      EXPECT_LE(natural_map_residual(problem, solution.p, Vector()), 1e-8) << "problem " << k;
    } else {
      EXPECT_GT(solution.natural_map_residual, 1e-8) << "problem " << k;
      EXPECT_FALSE(solution.reason.empty());
    }
  }
  RecordProperty("solved", solved);
  EXPECT_GE(solved, 195);
}

// Bonded pairs of bodies that meet in points: some of their forces balance each other and move nothing. A small change
// of the loads must not bring such forces, whose rounding would hide the motions.
TEST(RankDeficient, ForcesThatMoveNothingStaySmall) {
  std::mt19937 random(66);
  for (const int pairs : {20, 80, 200}) {
    const Eigen::Index n = 2 * pairs;
    const Matrix Z =
        Matrix(Matrix::NullaryExpr(n, 4, [&] { return uniform(random, -1, 1); }).householderQr().householderQ())
            .leftCols(4);
    const Matrix others = Matrix::Identity(n, n) - Z * Z.transpose();
    Problem problem;
    problem.dimension = 2;
    problem.W = Matrix(others * elastic_flexibility(random, pairs) * others);
    problem.q = others * Vector::NullaryExpr(n, [&] { return uniform(random, -1, 1); });
    problem.mu = Vector::Zero(pairs);
    problem.cohesion = problem.tension = Vector::Constant(pairs, HUGE_VAL);
    problem.G.resize(n, 0);
    const Solution before = solve(problem);
    ASSERT_EQ(before.status, Status::solved) << pairs;
    problem.q += 1e-5 * others * Vector::NullaryExpr(n, [&] { return uniform(random, -1, 1); });
    Start start;
    start.p = before.p;
    const Solution after = solve(problem, start);
    ASSERT_EQ(after.status, Status::solved) << pairs;
    EXPECT_LT((after.p - before.p).norm(), 1e-3 * before.p.norm()) << pairs;
  }
}

}  // namespace
}  // namespace scabo::contact
