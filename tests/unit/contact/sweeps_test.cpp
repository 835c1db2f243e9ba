// Accelerated sweeps: the pair's own problem against the slow bracketing of gauss_seidel.hpp, and when sweeps
// alone suffice.
#include "scabo/contact/sweeps.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "scabo/contact/certificate.hpp"
#include "scabo/contact/gauss_seidel.hpp"
#include "scabo/contact/solve.hpp"

namespace scabo::contact {
namespace {

using Random = std::mt19937;

Vector random_motion(Random& random, Eigen::Index size) {
  std::normal_distribution<double> normal;
  return Vector::NullaryExpr(size, [&] { return normal(random); });
}

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

/// Positive definite, normal and tangents coupled; `rank` below its size: singular.
Matrix random_operator(Random& random, Eigen::Index size, Eigen::Index rank) {
  Matrix B(size, rank);
  for (Eigen::Index k = 0; k < rank; ++k) B.col(k) = random_motion(random, size);
  return B * B.transpose();
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
  const Matrix W = K.inverse();
  return coulomb(d, W, W * load, mu);
}

TEST(AcceleratedSweeps, OnePairIsSolvedExactlyByTheFirst) {
  Random random(3);
  int open = 0, stick = 0, slip = 0;
  for (int k = 0; k < 3000; ++k) {
    const int d = 2 + k % 2;
    const double mu = std::array{0.0, 0.1, 0.3, 0.6}[static_cast<std::size_t>(k) / 2 % 4],
                 unit = std::pow(10.0, k % 13 - 6);
    const Matrix W = unit * random_operator(random, d, d + 1);
    const Vector q = random_motion(random, d) / unit;
    const Problem problem = coulomb(d, W, q, mu);
    const SweepsEnd end = accelerated_sweeps(problem, Vector::Zero(d), 1e-10);
    const Vector oracle = local_force(W, q, mu);
    const double size = std::max(oracle.norm(), end.p.norm());
    if (size == 0.0)
      ++open;
    else
      ++(end.p.tail(d - 1).norm() < (1.0 - 1e-9) * mu * end.p[0] ? stick : slip);
    const Vector u = q + W * end.p;
    // The law itself, free of units.
    EXPECT_GE(u[0], -1e-12 * q.norm()) << k;
    EXPECT_LE(std::abs(u[0] * end.p[0]), 1e-12 * q.norm() * size) << k;
    EXPECT_LE(end.p.tail(d - 1).norm(), mu * end.p[0] * (1.0 + 1e-11)) << k;
    EXPECT_LE(u.tail(d - 1).norm() * mu * end.p[0] + u.tail(d - 1).dot(end.p.tail(d - 1)),
              1e-11 * q.norm() * size)
        << k;
    // Where the pair has one solution only, it is the oracle's.
    if (mu <= 0.1 && W(0, 0) > 0.3 * W.trace()) EXPECT_LE((end.p - oracle).norm(), 1e-9 * size) << k;
  }
  EXPECT_GT(open, 300);
  EXPECT_GT(stick, 100);
  EXPECT_GT(slip, 300);
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
    while (sweeps < 5000 && natural_map_residual_at(problem, p, plain.motion()) > 1e-9)
      plain.sweep(p), ++sweeps;
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

TEST(AcceleratedSweeps, WhereTheySufficeNothingIsFactorised) {
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-9;
  for (int d : {2, 3}) {
    const Solution solution = solve(chain(d, 40, 0.3, 0.5), {}, options);
    EXPECT_EQ(solution.status, Status::solved);
    EXPECT_EQ(solution.iterations, 0);
    ASSERT_EQ(solution.trace.size(), 1u);
    EXPECT_NE(solution.trace[0].stage.find(" sweeps"), std::string::npos);
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
