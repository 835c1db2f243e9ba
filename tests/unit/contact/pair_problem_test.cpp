// The pair's own problem: the law itself is the oracle, free of units, for every state, with cohesion and tensile
// strength.
#include "scabo/contact/sweeps/pair_problem.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "scabo/base/types.hpp"

namespace scabo::contact {
namespace {

using Random = std::mt19937;

struct PairLaw {
  double mu, cohesion, tension;
};

Vector normal_vector(Random& random, Eigen::Index size) {
  std::normal_distribution<double> normal;
  return Vector::NullaryExpr(size, [&] { return normal(random); });
}

/// Positive definite, normal and tangents coupled.
Matrix random_block(Random& random, int d) {
  const Matrix B = Matrix::NullaryExpr(d, d + 1, [&] { return std::normal_distribution<double>()(random); });
  return B * B.transpose();
}

Vector solved(const Matrix& W, const Vector& free, const PairLaw& law) {
  Vector p(free.size());
  if (free.size() == 2)
    PairProblem<2>(W.data(), {law.mu, law.mu}, law.cohesion, law.tension).solve(free.data(), p.data());
  else
    PairProblem<3>(W.data(), {law.mu, law.mu}, law.cohesion, law.tension).solve(free.data(), p.data());
  return p;
}

/// How far p is from obeying the law, of 1.
double broken(const Matrix& W, const Vector& free, const PairLaw& law, const Vector& p) {
  const Vector u = free + W * p;
  const Eigen::Index t = free.size() - 1;
  const double length = free.norm() + W.norm() * p.norm(), force = length / W.norm();
  const double bound = law.cohesion + law.mu * std::max(p[0], 0.0);
  double worst = std::max({0.0, -u[0] / length, (p.tail(t).norm() - bound) / force});
  if (!std::isinf(law.tension))
    worst = std::max({worst, -(p[0] + law.tension) / force, std::abs(u[0] * (p[0] + law.tension)) / (length * force)});
  else
    worst = std::max(worst, std::abs(u[0]) / length);
  return std::max(worst, (u.tail(t).norm() * bound + u.tail(t).dot(p.tail(t))) / (length * force));
}

int state(const PairLaw& law, const Vector& p) {
  if (p[0] <= -law.tension) return 0;
  const double bound = law.cohesion + law.mu * std::max(p[0], 0.0);
  return p.tail(p.size() - 1).norm() < (1.0 - 1e-9) * bound ? 1 : 2;
}

TEST(PairProblem, ObeysCoulombsLaw) {
  Random random(3);
  std::array<int, 3> states{};
  for (int k = 0; k < 4000; ++k) {
    const int d = 2 + k % 2;
    const double unit = std::pow(10.0, k % 13 - 6);
    const PairLaw law{std::array{0.0, 0.1, 0.3, 0.6}[static_cast<std::size_t>(k) / 2 % 4], 0.0, 0.0};
    const Matrix W = unit * random_block(random, d);
    const Vector free = normal_vector(random, d) / unit, p = solved(W, free, law);
    EXPECT_LE(broken(W, free, law, p), 1e-12) << k;
    ++states[static_cast<std::size_t>(state(law, p))];
  }
  for (const int count : states) EXPECT_GT(count, 100);
}

TEST(PairProblem, ObeysItWithCohesionAndTensileStrength) {
  Random random(7);
  std::uniform_real_distribution<double> strength(0.0, 1.0);
  std::array<int, 3> states{};
  int pulled = 0;
  for (int k = 0; k < 8000; ++k) {
    const int d = 2 + k % 2;
    const PairLaw law{k / 2 % 3 == 0 ? 0.0 : 0.4, strength(random),
                      k / 6 % 3 == 0   ? 0.0
                      : k / 6 % 3 == 1 ? strength(random)
                                       : std::numeric_limits<double>::infinity()};
    const Matrix W = random_block(random, d);
    const Vector free = normal_vector(random, d), p = solved(W, free, law);
    EXPECT_LE(broken(W, free, law, p), 1e-12) << k << ": " << p.transpose();
    ++states[static_cast<std::size_t>(state(law, p))];
    pulled += p[0] < 0.0 && p[0] > -law.tension ? 1 : 0;
  }
  for (const int count : states) EXPECT_GT(count, 500);
  EXPECT_GT(pulled, 500);
}

TEST(PairProblem, TheForceOfTheTimeBeforeIsNoConditionOfTheNext) {
  Random random(11);
  const Matrix W = random_block(random, 3);
  const PairLaw law{0.5, 0.2, 0.1};
  PairProblem<3> pair(W.data(), {law.mu, law.mu}, law.cohesion, law.tension);
  for (int k = 0; k < 500; ++k) {
    const Vector free = std::pow(10.0, k % 9 - 4) * normal_vector(random, 3);
    Vector p(3);
    pair.solve(free.data(), p.data());
    EXPECT_LE(broken(W, free, law, p), 1e-12) << k;
    EXPECT_LE((p - solved(W, free, law)).norm(), 1e-9 * p.norm()) << k;
  }
}

TEST(PairProblem, StaysFiniteWhereNothingMovesIt) {
  const Vector free = Vector::Constant(3, -1.0);
  for (const PairLaw& law : {PairLaw{0.4, 0.0, 0.0}, PairLaw{0.4, 0.3, 0.2}}) {
    EXPECT_TRUE(solved(Matrix::Zero(3, 3), free, law).allFinite());
    EXPECT_TRUE(solved(Matrix::Ones(3, 3), free, law).allFinite());  // rank 1
    Matrix along_normal = Matrix::Zero(3, 3);
    along_normal(0, 0) = 2.0;
    EXPECT_EQ(solved(along_normal, free, law), Vector(Eigen::Vector3d(0.5, 0.0, 0.0)));
    EXPECT_TRUE(solved(along_normal, -free, law).allFinite());
  }
}

}  // namespace
}  // namespace scabo::contact
