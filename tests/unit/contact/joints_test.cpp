// Joints of rigid bodies: W = A K A', sweeps and linear systems in their components, against W itself.
#include "scabo/contact/kkt/joints.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "scabo/contact/judge.hpp"
#include "scabo/contact/kkt/joint_system.hpp"
#include "scabo/contact/kkt/motion_system.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"
#include "unit/contact/towers.hpp"

namespace scabo::contact {
namespace {

Vector random_numbers(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  Vector v(size);
  for (double& component : v) component = static_cast<double>(random()) / 4294967296.0 - 0.5;
  return v;
}

/// The same problem with its pairs in another order, joints interleaved.
Problem shuffled(const Problem& problem) {
  const int d = problem.dimension, N = problem.pairs();
  std::vector<int> order(static_cast<std::size_t>(N));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  Eigen::SparseMatrix<double> P(d * N, d * N);
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < d; ++k) P.insert(d * i + k, d * order[static_cast<std::size_t>(i)] + k) = 1.0;
  Problem other = problem;
  other.W = Delassus(Eigen::SparseMatrix<double>(P * problem.W.sparse() * P.transpose()));
  other.q = P * problem.q;
  return other;
}

/// Every component of every pair as an unknown of its own, D = 1.
SaddleRows all_components(const Problem& problem) {
  const int d = problem.dimension;
  SaddleRows rows;
  rows.resize(static_cast<std::size_t>(problem.q.size()));
  rows.pair.clear();
  for (int i = 0; i < problem.pairs(); ++i)
    for (int k = 0; k < d; ++k) {
      rows.L.col(d * i + k) = rows.C.col(d * i + k) = Eigen::Vector3d::Unit(k);
      rows.pair.push_back(i);
    }
  rows.D.setOnes(problem.q.size());
  return rows;
}

template <int d>
void expect_products_of_W(const Problem& problem, int joints_wanted) {
  auto joints = find_joints<d>(problem);
  ASSERT_TRUE(joints);
  EXPECT_EQ(joints->count(), joints_wanted);
  JointSystem<d> system(std::move(*joints));
  const SaddleRows rows = all_components(problem);
  ASSERT_TRUE(system.factorise(rows, rows.D));
  const Vector p = random_numbers(problem.q.size(), 1);
  Vector found;
  system.solve(p + problem.W * p, found);
  EXPECT_LE((found - p).cwiseAbs().maxCoeff(), 1e-11 * p.cwiseAbs().maxCoeff());
}

TEST(Joints, OfTowersHaveTheProductsOfW) {
  expect_products_of_W<3>(tower_of_blocks(3, 7, 3, 0.4), 7);
  expect_products_of_W<2>(tower_of_blocks(2, 9, 5, 0.4), 9);
  expect_products_of_W<3>(tower_of_blocks(3, 7, 3, 0.4, 1000.0), 7);
  expect_products_of_W<3>(shuffled(tower_of_blocks(3, 7, 3, 0.4)), 7);
  // The pairs of both joints have the same neighbours: all pairs.
  expect_products_of_W<3>(tower_of_blocks(3, 2, 4, 0.4), 2);
}

TEST(Joints, AreFoundOnlyWherePairsMoveAsRigidBodies) {
  const Problem tower = tower_of_blocks(3, 5, 3, 0.4);
  Problem bent = tower;
  Eigen::SparseMatrix<double> W = tower.W.sparse();
  W.coeffRef(30, 30) *= 1.0 + 1e-6;  // one pair is softer: it is a joint of its own
  bent.W = Delassus(W);
  expect_products_of_W<3>(bent, 6);
  W = tower.W.sparse();
  W.coeffRef(30, 51) += 1e-9;  // two pairs act on each other as those of rigid bodies do not
  W.coeffRef(51, 30) += 1e-9;
  bent.W = Delassus(W);
  EXPECT_FALSE(find_joints<3>(bent));
  Problem single = tower;  // every pair by itself
  Eigen::SparseMatrix<double> one(W.rows(), W.cols());
  one.setIdentity();
  single.W = Delassus(one);
  EXPECT_FALSE(find_joints<3>(single));
  EXPECT_FALSE(find_joints<2>(tower));
  Problem dense = tower;
  dense.W = Delassus(Matrix(tower.W.sparse()));
  EXPECT_FALSE(find_joints<3>(dense));
}

template <int d>
void expect_sweeps_of_pairs(const Problem& problem) {
  ASSERT_TRUE(find_joints<d>(problem));
  const auto pairs = gauss_seidel(problem, false), joints = gauss_seidel(problem);
  Vector p = Vector::Zero(problem.q.size()), q = p;
  pairs->start(p);
  joints->start(q);
  for (int sweep = 0; sweep < 8; ++sweep) {
    pairs->sweep(p);
    joints->sweep(q);
  }
  const double force = p.lpNorm<Eigen::Infinity>();
  EXPECT_GT(force, 0.0);
  EXPECT_LE((p - q).lpNorm<Eigen::Infinity>(), 1e-10 * force);
}

TEST(Joints, SweepsAreThoseOfThePairs) {
  expect_sweeps_of_pairs<3>(tower_of_blocks(3, 6, 3, 0.4, 100.0));
  expect_sweeps_of_pairs<3>(shuffled(tower_of_blocks(3, 6, 3, 0.4)));
  expect_sweeps_of_pairs<2>(tower_of_blocks(2, 9, 5, 0.3));
}

// Rows that slip and rows that stick, by the motions of the bodies and by the matrix itself; with the bodies' motions
// in W, and in G.
TEST(Bodies, SystemsAreThoseOfThePairs) {
  for (const int d : {2, 3})
    for (const bool at_rest : {false, true}) {
      Problem problem = tower_of_blocks(d, 6, 4, 0.4, 10.0, true);
      const Eigen::Index n = problem.q.size();
      if (at_rest) {
        const Eigen::SparseMatrix<double> Y = *problem.W.bodies();
        problem.G = RigidMap(Eigen::SparseMatrix<double>(Y.transpose()));
        problem.f = random_numbers(Y.rows(), 2);
        problem.W = Delassus(Eigen::SparseMatrix<double>(n, n)).with_bodies(Eigen::SparseMatrix<double>(0, n));
      }
      ASSERT_TRUE(MotionSystem::is_of(problem));
      SaddleRows rows;
      rows.resize(static_cast<std::size_t>(n));
      rows.E = at_rest ? 1e-3 : 0.0;
      for (Eigen::Index j = 0; j < n; ++j) {
        rows.pair[static_cast<std::size_t>(j)] = static_cast<int>(j / d);
        rows.L(j % d, j) = rows.C(j % d, j) = 1.0;
        if (j % d == 0) rows.C(1, j) = 0.4;
        rows.D[j] = j % 3 == 0 ? 1e-2 : 10.0;
      }
      Vector moved;
      Matrix A(n + problem.G.cols(), n + problem.G.cols());
      assemble_dense(problem, rows, moved, A);
      const Vector x = random_numbers(A.rows(), 4), b = A * x;
      EXPECT_LE((rows.times(problem, x) - b).norm(), 1e-13 * b.norm());
      MotionSystem bodies(problem);
      ASSERT_TRUE(bodies.factorise(rows, rows.D));
      Vector found;
      bodies.solve(b, found);
      EXPECT_LE((found - x).norm(), 1e-10 * x.norm());
    }
}

// Forces are not unique, the motions that they cause are.
TEST(Bodies, MotionsAreThoseWithoutThem) {
  for (const int d : {2, 3})
    for (const double ratio : {1.0, 1000.0}) {
      const Problem plain = tower_of_blocks(d, d == 2 ? 40 : 12, 4, 0.4, ratio),
                    known = tower_of_blocks(d, d == 2 ? 40 : 12, 4, 0.4, ratio, true);
      SolverOptions options;
      options.judge = Judge::natural_map;
      const Solution without = solve(plain, {}, options), with = solve(known, {}, options);
      ASSERT_EQ(without.status, Status::solved) << without.reason;
      ASSERT_EQ(with.status, Status::solved) << with.reason;
      const Vector u = motion_of(plain, without.p, {}), v = motion_of(plain, with.p, {});
      EXPECT_LE((u - v).lpNorm<Eigen::Infinity>(), 1e-7 * plain.q.lpNorm<Eigen::Infinity>()) << d << ' ' << ratio;
    }
}

/// D from 1e-9 (stick) to 1e9 (open), both in every joint, and a T on one side, as interior points have them.
TEST(Joints, SystemsAreSolvedWithTinyAndHugeDiagonals) {
  const Problem problem = tower_of_blocks(3, 6, 3, 0.4, 1000.0);
  const Eigen::Index n = problem.q.size();
  auto joints = find_joints<3>(problem);
  ASSERT_TRUE(joints);
  JointSystem<3> system(std::move(*joints));
  std::mt19937 random(11);
  SaddleRows rows = all_components(problem);
  Matrix T = Matrix::Identity(n, n);
  for (Eigen::Index i = 0; i < n / 3; ++i) {
    Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
    slope(0, 1) = 0.6;
    slope(0, 2) = 0.8;
    T.block<3, 3>(3 * i, 3 * i) = slope;
    rows.L.middleCols<3>(3 * i) = slope.transpose();
    for (int k = 0; k < 3; ++k)
      rows.D[3 * i + k] = std::pow(10.0, random() % 3 == 0 ? 9.0 : random() % 2 == 0 ? -9.0 : 0.0);
  }
  ASSERT_TRUE(system.factorise(rows, rows.D));
  const Matrix full = Matrix(rows.D.asDiagonal()) + T * Matrix(problem.W.sparse());
  const Vector z = random_numbers(n, 5), b = full * z;
  Vector found;
  system.solve(b, found);
  for (int round = 0; round < 2; ++round) {
    Vector correction;
    system.solve(b - full * found, correction);
    found += correction;
  }
  // Forces of redundant pairs that stick are determined by their D alone: what counts is the equation, row by row.
  const Vector left = (full * found - b).cwiseQuotient(rows.D.cwiseMax(1.0));
  EXPECT_LE(left.lpNorm<Eigen::Infinity>(), 1e-11 * std::max(1.0, found.lpNorm<Eigen::Infinity>()));
  // The same of the motions that matter, T W z.
  const Vector motion = T * (problem.W * found), wanted = T * (problem.W * z);
  EXPECT_LE((motion - wanted).lpNorm<Eigen::Infinity>(), 1e-6 * wanted.lpNorm<Eigen::Infinity>());
}

/// Scaled natural map of the forces, formed here from nothing but W, q and mu: W and q times 1 / mean W_ii.
double scaled_residual(const Problem& problem, const Vector& p) {
  const int d = problem.dimension;
  const double k = 1.0 / problem.W.diagonal().mean();
  const Vector u = k * (problem.W * p + problem.q);
  double sum = 0.0;
  for (int i = 0; i < problem.pairs(); ++i) {
    const double mu = problem.mu[i];
    const Vector p_t = p.segment(d * i + 1, d - 1), u_t = u.segment(d * i + 1, d - 1);
    const double x_n = p[d * i] - u[d * i] - mu * u_t.norm();
    const Vector x_t = p_t - u_t;
    double n = x_n, t = 1.0;  // nearest point of the cone: n, t x_t
    if (mu * x_t.norm() <= -x_n) {
      n = t = 0.0;
    } else if (x_t.norm() > mu * x_n) {
      n = (x_n + mu * x_t.norm()) / (1.0 + mu * mu);
      t = mu * n / x_t.norm();
    }
    sum += (p[d * i] - n) * (p[d * i] - n) + (p_t - t * x_t).squaredNorm();
  }
  return std::sqrt(sum) / (k * problem.q.norm());
}

TEST(Joints, TowersOfUnequalMassesAreSolved) {
  for (const double ratio : {1.0, 1000.0})
    for (const double mu : {0.1, 0.8}) {
      const Problem problem = tower_of_blocks(3, 20, 3, mu, ratio);
      SolverOptions options;
      options.judge = Judge::natural_map;
      options.tolerance = 5e-9;
      const Solution solution = solve(problem, {}, options);
      ASSERT_EQ(solution.status, Status::solved) << ratio << ' ' << mu << ' ' << solution.reason;
      EXPECT_LE(scaled_residual(problem, solution.p), 5e-9) << ratio << ' ' << mu;
    }
}

}  // namespace
}  // namespace scabo::contact
