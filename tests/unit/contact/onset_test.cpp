// The motion with which bodies begin to move where nothing balances the loads.
#include "scabo/contact/questions/onset.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <cmath>
#include <vector>

#include "scabo/contact/questions/rigid_motions.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

Eigen::SparseMatrix<double> diagonal(const Vector& entries) {
  Eigen::SparseMatrix<double> matrix(entries.size(), entries.size());
  for (Eigen::Index i = 0; i < entries.size(); ++i) matrix.insert(i, i) = entries[i];
  return matrix;
}

/// A block of half width 1 on a floor, its reference point `height` above it; loads [force_x, force_y, moment].
Problem loaded_block(int pairs, double friction, const Eigen::Vector3d& f, double height = 0.2) {
  Problem problem;
  problem.W = Matrix(Matrix::Identity(2 * pairs, 2 * pairs));
  problem.q = Vector::Zero(2 * pairs);
  problem.mu = Vector::Constant(pairs, friction);
  problem.G = block_motions(pairs, 2.0, height);
  problem.f = f;
  return problem;
}

TEST(Onset, OfASlidingBlockDoesNotDilate) {
  for (const double sense : {-1.0, 1.0})
    for (const double beyond : {1.0 + 1e-6, 1.1, 3.0}) {
      const double mu = 0.5;
      const Problem problem = loaded_block(5, mu, {sense * beyond * mu * 10.0, -10.0, 0.0});
      const auto v = onset_of_motion(problem, diagonal(Vector::Ones(3)));
      ASSERT_TRUE(v.has_value());
      EXPECT_LT((*v - Vector(Eigen::Vector3d(sense, 0.0, 0.0))).norm(), 1e-8) << sense << ", " << beyond;
    }
}

// m a = (P - mu N, N - W, moment) of a block that slides and turns about its front edge: N from the acceleration of
// that edge along y, a_y - alpha = 0 with a moment of inertia I, mu N at the height below the centroid.
TEST(Onset, OfATumblingBlockObeysNewtonsLaw) {
  const double mu = 0.4, height = 1.5, P = 12.0, W = 10.0, m = 2.0, I = 0.7, M = 6.0;
  const Problem problem = loaded_block(7, mu, {P, -W, -M}, height);
  const auto v = onset_of_motion(problem, diagonal(Eigen::Vector3d(1.0 / m, 1.0 / m, 1.0 / I)));
  ASSERT_TRUE(v.has_value());
  // Edge at (1, -height): its acceleration along y is a_y + alpha; alpha I = -M + N - mu N height.
  const double N = (W / m + M / I) / (1.0 / m + (1.0 - mu * height) / I);
  ASSERT_GT(N, 0.0);
  Vector expected = Eigen::Vector3d((P - mu * N) / m, (N - W) / m, (-M + N - mu * N * height) / I);
  ASSERT_LT(expected[2], 0.0);                         // it turns over its front edge,
  ASSERT_GT(expected[0] + height * expected[2], 0.0);  // which slides forward
  expected.normalize();
  EXPECT_LT((*v - expected).norm(), 1e-8) << v->transpose() << "; " << expected.transpose();
}

// Loads that nothing balances have one, and it is admissible: a proof finds it by another way.
TEST(Onset, IsThereWhereAMechanismIsProven) {
  std::mt19937 random(7);
  int mechanisms = 0;
  for (int round = 0; round < 300; ++round) {
    const Problem problem =
        loaded_block(3 + round % 6, uniform(random, 0.0, 1.5),
                     {uniform(random, -3.0, 3.0), uniform(random, -3.0, 1.0), uniform(random, -3.0, 3.0)},
                     uniform(random, 0.1, 2.0));
    if (!find_mechanism(problem)) continue;
    ++mechanisms;
    const auto v = onset_of_motion(problem, diagonal(Eigen::Vector3d(1.0, 1.0, 3.0)));
    ASSERT_TRUE(v.has_value()) << round;
    EXPECT_GT(problem.f.dot(*v), 0.0) << round;
    const Vector u = problem.G * *v;
    for (int i = 0; i < problem.pairs(); ++i) EXPECT_GT(u[2 * i], -1e-8) << round << ", " << i;
  }
  EXPECT_GT(mechanisms, 100);
}

/// Blocks as above side by side, each with its own three motions.
Problem separate_blocks(int blocks, int pairs, double friction, const Eigen::Vector3d& f) {
  const Problem one = loaded_block(pairs, friction, f);
  Problem problem;
  problem.q = Vector::Zero(2 * blocks * pairs);
  problem.mu = Vector::Constant(blocks * pairs, friction);
  problem.f = f.replicate(blocks, 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int block = 0; block < blocks; ++block)
    for (int row = 0; row < 2 * pairs; ++row)
      for (int k = 0; k < 3; ++k) entries.emplace_back(2 * block * pairs + row, 3 * block + k, one.G.dense()(row, k));
  RigidMap::Sparse G(problem.q.size(), 3 * blocks);
  G.setFromTriplets(entries.begin(), entries.end());
  problem.G = RigidMap(std::move(G));
  return problem;
}

// 5,000 pairs of 500 bodies. What limits the search is work, which no machine does faster than another.
TEST(Onset, OfManyPairsIsFoundWhereTheyBelongToManyBodies) {
  constexpr int blocks = 500;
  const Problem problem = separate_blocks(blocks, 10, 0.5, {8.0, -10.0, 0.0});
  const auto v = onset_of_motion(problem, diagonal(Vector::Ones(3 * blocks)));
  ASSERT_TRUE(v.has_value());
  const Vector expected = Vector(Eigen::Vector3d(1.0, 0.0, 0.0).replicate(blocks, 1)).normalized();
  EXPECT_LT((*v - expected).norm(), 1e-8);
}

TEST(Onset, IsNotThereForLessWorkThanItNeeds) {
  const Problem problem = loaded_block(5, 0.5, {8.0, -10.0, 0.0});
  const auto with = [&](double operations) {
    return onset_of_motion(problem, diagonal(Vector::Ones(3)), operations).has_value();
  };
  EXPECT_FALSE(with(1.0));
  double enough = 1.0;
  while (!with(enough) && enough < 1e9) enough *= 2.0;
  EXPECT_GT(enough, 100.0);  // a sweep over its ten rows
  EXPECT_LT(enough, 1e6);
  for (int round = 0; round < 20; ++round) EXPECT_FALSE(with(0.5 * enough)) << round;
}

/// A block in space on four corners at z = 0, its reference point `height` above their centre.
Problem loaded_block_in_space(double friction, double height, const Vector& f) {
  Problem problem;
  problem.dimension = 3;
  problem.W = Matrix(Matrix::Identity(12, 12));
  problem.q = Vector::Zero(12);
  problem.mu = Vector::Constant(4, friction);
  problem.f = f;
  Matrix G(12, 6);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d arm(i % 2 == 0 ? 1.0 : -1.0, i < 2 ? 0.8 : -0.8, -height);
    for (int row = 0; row < 3; ++row) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit((row + 2) % 3);  // z, x, y
      G.row(3 * i + row) << axis.transpose(), arm.cross(axis).transpose();
    }
  }
  problem.G = RigidMap(RigidMap::Sparse(G.sparseView()));
  return problem;
}

TEST(Onset, OfABlockInSpaceIsAlongWhatPushesIt) {
  for (const double azimuth : {0.0, 0.6, 2.5, 4.0}) {
    Vector f = Vector::Zero(6);
    f << 6.0 * std::cos(azimuth), 6.0 * std::sin(azimuth), -10.0, 0.0, 0.0, 0.0;
    const auto v = onset_of_motion(loaded_block_in_space(0.5, 0.1, f), diagonal(Vector::Ones(6)));
    ASSERT_TRUE(v.has_value());
    Vector expected = Vector::Zero(6);
    expected.head<2>() = f.head<2>().normalized();
    EXPECT_LT((*v - expected).norm(), 1e-7) << v->transpose();
    f.head<2>() *= 0.8;
    EXPECT_FALSE(onset_of_motion(loaded_block_in_space(0.5, 0.1, f), diagonal(Vector::Ones(6))).has_value());
  }
}

// The pyramid that the proof begins with is 2 % wider than the cone along some directions.
TEST(Onset, InSpaceIsThatOfAMechanismThatIsProvenUpToTheBoundOfFriction) {
  for (const double azimuth : {0.0, 0.1, 0.19634954, 2.5})
    for (const double beyond : {0.9999, 1.0002, 1.01, 1.5}) {
      Vector f = Vector::Zero(6);
      f << 5.0 * beyond * std::cos(azimuth), 5.0 * beyond * std::sin(azimuth), -10.0, 0.0, 0.0, 0.0;
      const Problem problem = loaded_block_in_space(0.5, 0.1, f);
      const auto proof = find_mechanism(problem);
      EXPECT_EQ(proof.has_value(), beyond > 1.0) << azimuth << ", " << beyond;
      if (!proof) continue;
      EXPECT_GT(f.dot(*proof), 0.0);
      constexpr double half_side = 0.19634954;  // of the first pyramid: the proof slides across one of its sides
      EXPECT_LT((proof->head<2>().normalized() - f.head<2>().normalized()).norm(), half_side);
    }
}

// About the edge x = 1, without slip: M is the identity, and the edge stays.
TEST(Onset, OfATallBlockInSpaceTurnsAboutItsEdge) {
  Vector f = Vector::Zero(6);
  f << 6.0, 0.0, -10.0, 0.0, 0.0, 0.0;
  const auto v = onset_of_motion(loaded_block_in_space(5.0, 3.0, f), diagonal(Vector::Ones(6)));
  ASSERT_TRUE(v.has_value());
  Vector expected = Vector::Zero(6);
  expected << 3.0, 0.0, 1.0, 0.0, 1.0, 0.0;  // rotation about y lifts the back; the centroid moves by it x [-1, 0, 3]
  EXPECT_LT((*v - expected.normalized()).norm(), 1e-7) << v->transpose();
}

TEST(Onset, IsNotThereWithoutLoads) {
  EXPECT_FALSE(onset_of_motion(loaded_block(3, 0.5, {0.0, 0.0, 0.0}), diagonal(Vector::Ones(3))).has_value());
  EXPECT_FALSE(onset_of_motion(loaded_block(3, 0.5, {1.0, -10.0, 0.0}), diagonal(Vector::Ones(3))).has_value());
}

}  // namespace
}  // namespace scabo::contact
