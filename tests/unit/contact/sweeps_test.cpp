// Accelerated sweeps: when they alone suffice, and that they end. Their pairs: pair_problem_test.cpp.
#include "scabo/contact/sweeps/sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/certificate.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"
#include "scabo/contact/solve.hpp"
#include "support/decompositions.hpp"

namespace scabo::contact {
namespace {

Problem coulomb(int d, Matrix W, Vector q, double mu) {
  Problem problem;
  problem.dimension = d;
  problem.mu = Vector::Constant(q.size() / d, mu);
  problem.W = Delassus(std::move(W));
  problem.G = Matrix::Zero(q.size(), 0);
  problem.f = Vector::Zero(0);
  problem.q = std::move(q);
  return problem;
}

/// A row of pairs on bodies joined by springs: what one pair presses spreads slowly.
Problem chain(int d, int pairs, double ground, double mu) {
  Matrix K = Matrix::Zero(d * pairs, d * pairs);
  for (int i = 0; i < pairs; ++i)
    for (int k = 0; k < d; ++k) {
      K(d * i + k, d * i + k) += ground;
      if (i + 1 == pairs) continue;
      const int here = d * i + k, there = here + d;
      K(here, here) += 1.0, K(there, there) += 1.0;
      K(here, there) -= 1.0, K(there, here) -= 1.0;
    }
  const Vector load = Vector::NullaryExpr(d * pairs, [&](Eigen::Index k) {
    return k % d == 0 ? -1.0 - 2.0 * std::sin(0.7 * double(k / d)) : 0.6 * std::cos(0.9 * double(k));
  });
  const Matrix W = test::inverse(K);
  return coulomb(d, W, W * load, mu);
}

TEST(AcceleratedSweeps, PairsThatNothingMovesAndPairsWithoutTangentialMotion) {
  Matrix W = Matrix::Zero(9, 9);
  W(3, 3) = 2.0;                             // moves along its normal only
  W.block(6, 6, 3, 3) = Matrix::Ones(3, 3);  // rank 1
  Vector q(9);
  q << 1.0, 0.5, 0.0, -1.0, 0.3, 0.1, -1.0, 0.2, 0.1;
  const SweepsEnd end = accelerated_sweeps(coulomb(3, W, q, 0.4), Vector::Zero(9), 1e-10);
  EXPECT_TRUE(end.p.allFinite());
  EXPECT_EQ(end.p[0], 0.0);
  EXPECT_EQ(end.p[3], 0.5);
  EXPECT_LE(end.sweeps, 2000);
}

TEST(AcceleratedSweeps, NeedFewerThanPlainOnes) {
  for (int d : {2, 3}) {
    const Problem problem = chain(d, 30, 0.02, 0.4);
    GaussSeidel plain(problem);
    Vector p = Vector::Zero(d * 30);
    plain.start(p);
    int sweeps = 0;
    while (sweeps < 5000 && Measure(problem).natural_map(problem, p, plain.motion()) > 1e-9) plain.sweep(p), ++sweeps;
    const SweepsEnd end = accelerated_sweeps(problem, Vector::Zero(d * 30), 1e-9);
    EXPECT_TRUE(end.content);
    EXPECT_LE(natural_map_residual(problem, end.p, Vector(0)), 1e-9);
    EXPECT_LT(2 * end.sweeps, sweeps) << "plain: " << sweeps;
  }
}

TEST(AcceleratedSweeps, SparseAndDenseAreTheSame) {
  const Problem dense = chain(3, 12, 0.5, 0.3);
  Problem sparse = dense;
  sparse.W = Delassus(Eigen::SparseMatrix<double>(dense.W.dense().sparseView()));
  const SweepsEnd first = accelerated_sweeps(dense, Vector::Zero(36), 1e-11),
                  second = accelerated_sweeps(sparse, Vector::Zero(36), 1e-11);
  EXPECT_EQ(first.sweeps, second.sweeps);
  EXPECT_LE((first.p - second.p).norm(), 1e-9 * first.p.norm());
  EXPECT_LE((first.motion - (dense.q + dense.W * first.p)).norm(), 1e-13 * dense.q.norm());
}

TEST(Chains, AreSolvedToTheirNaturalMap) {
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-9;
  for (int d : {2, 3}) {
    const Solution solution = solve(chain(d, 40, 0.3, 0.5), {}, options);
    EXPECT_EQ(solution.status, Status::solved);
    EXPECT_LE(solution.natural_map_residual, 1e-9);
    EXPECT_LE(solution.residual, 1e-7);
    EXPECT_LE(solution.certificate.worst(), 1e-6);
  }
}

TEST(AcceleratedSweeps, EndWhereTheyNoLongerGain) {
  const Problem stiff = chain(3, 60, 1e-7, 0.4);
  const SweepsEnd end = accelerated_sweeps(stiff, Vector::Zero(180), 1e-30);  // below rounding
  EXPECT_FALSE(end.content);
  EXPECT_LT(end.sweeps, 1500);
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-10;
  EXPECT_EQ(solve(stiff, {}, options).status, Status::solved);
}

TEST(AcceleratedSweeps, OnlyCoulombsLawWithoutRigidMotions) {
  Problem problem = chain(2, 3, 1.0, 0.3);
  EXPECT_TRUE(may_accelerate(problem));
  Problem bonded = problem;
  bonded.cohesion = Vector::Constant(3, 0.1);
  EXPECT_FALSE(may_accelerate(bonded));
  problem.G = Matrix::Ones(6, 1);
  problem.f = Vector::Zero(1);
  EXPECT_FALSE(may_accelerate(problem));
}

}  // namespace
}  // namespace scabo::contact
