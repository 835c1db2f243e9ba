// One method of interior points for every pair law, in the plane and in space. Problems are made from a known solution:
// forces, motions and rigid motions that satisfy the law are chosen first, and q and f follow from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/interior/held_slips.hpp"
#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/interior/saddle_system.hpp"
#include "scabo/contact/interior/tangential_cone.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/newton.hpp"
#include "support/decompositions.hpp"
#include "support/random.hpp"
#include "unit/contact/towers.hpp"

namespace scabo::contact::interior {
namespace {

using test::uniform;
using test::whole;

double normal(std::mt19937& random) { return std::normal_distribution<double>()(random); }

Vector normal_vector(std::mt19937& random, Eigen::Index size) {
  Vector values(size);
  for (double& value : values) value = normal(random);
  return values;
}

enum class Laws { coulomb, all };

/// Coefficients and strengths: with all laws also pairs without friction, with cohesion, with tensile strength, bonded,
/// unable to slip, and in the plane with coefficients that differ by direction, some of them 0.
void give_laws(std::mt19937& random, Laws laws, Problem& problem, int pairs) {
  problem.mu = Vector::NullaryExpr(pairs, [&] { return uniform(random, 0.05, 1.0); });
  if (laws == Laws::coulomb) return;
  problem.cohesion = problem.tension = Vector::Zero(pairs);
  if (problem.dimension == 2 && whole(random, 0, 1) == 0)
    problem.mu_backward =
        Vector::NullaryExpr(pairs, [&] { return whole(random, 0, 4) == 0 ? 0.0 : uniform(random, 0.0, 1.0); });
  for (int i = 0; i < pairs; ++i) {
    if (whole(random, 0, 6) == 0) {
      problem.mu[i] = 0.0;
      if (problem.mu_backward.size() > 0) problem.mu_backward[i] = 0.0;
    }
    if (whole(random, 0, 3) == 0) problem.cohesion[i] = uniform(random, 0.0, 1.0);
    if (whole(random, 0, 4) == 0) problem.tension[i] = uniform(random, 0.0, 0.5);
    if (whole(random, 0, 19) == 0) problem.cohesion[i] = HUGE_VAL;
    if (whole(random, 0, 19) == 0) problem.tension[i] = problem.cohesion[i] = HUGE_VAL;
  }
}

/// Force and motion of one pair that satisfy its law: open, stick or slip at random.
void choose_state(std::mt19937& random, const Problem& problem, Eigen::Index i, Eigen::Ref<Vector> p,
                  Eigen::Ref<Vector> u) {
  const Eigen::Index tangents = problem.dimension - 1;
  const double tension = problem.tension_of(i);
  if (std::isinf(tension)) {
    p[0] = normal(random);
  } else if (whole(random, 0, 2) == 0) {
    p[0] = -tension;
    u[0] = std::abs(normal(random));
  } else {
    p[0] = 0.1 + std::abs(normal(random)) - tension;
  }
  const Vector along = normal_vector(random, tangents).normalized();
  const double bound = problem.friction_bound(i, p[0], along[0]);
  if (std::isinf(bound)) {
    p.tail(tangents) = normal(random) * along;
  } else if (bound > 0.0 && whole(random, 0, 1) == 0) {
    p.tail(tangents) = uniform(random, 0.0, 0.95) * bound * along;
  } else {
    p.tail(tangents) = bound * along;
    u.tail(tangents) = -std::abs(normal(random)) * along;
  }
}

Problem with_known_solution(std::mt19937& random, int dimension, Laws laws) {
  const int pairs = 1 + static_cast<int>(40.0 * std::pow(uniform(random, 0.0, 1.0), 2)), n = dimension * pairs;
  const int m = whole(random, 0, 1) == 0 ? 0 : whole(random, 1, std::max(1, std::min(3 * (dimension - 1), n / 2)));
  Problem problem;
  problem.dimension = dimension;
  const Matrix Q = test::orthonormal_columns(normal_vector(random, n * n).reshaped(n, n));
  const double spread = uniform(random, 0.0, 4.0);
  const Vector eigenvalues =
      Vector::NullaryExpr(n, [&] { return std::pow(10.0, -uniform(random, 0.0, spread + 1e-9)); });
  const Matrix W = Q * eigenvalues.asDiagonal() * Q.transpose();
  problem.W = Delassus(Matrix(0.5 * (W + W.transpose()) / W.diagonal().mean()));
  give_laws(random, laws, problem, pairs);
  Matrix G = normal_vector(random, n * m).reshaped(n, m);
  Vector p = Vector::Zero(n), u = Vector::Zero(n);
  for (Eigen::Index i = 0; i < pairs; ++i) {
    choose_state(random, problem, i, p.segment(dimension * i, dimension), u.segment(dimension * i, dimension));
    if (problem.largest_mu(i) == 0.0 && problem.cohesion_of(i) == 0.0)  // forces there cannot balance anything
      G.middleRows(dimension * i + 1, dimension - 1).setZero();
  }
  problem.G = RigidMap(G);
  problem.f = -(G.transpose() * p);
  problem.q = u - problem.W * p - G * normal_vector(random, m);
  return problem;
}

/// A content judge as increments have it.
IsSolution certified(const Problem& problem, double tolerance = 1e-10) {
  return [&problem, tolerance, measure = Measure(problem)](const Vector& p, const Vector& a, const Vector& motion) {
    return measure.natural_map(problem, p, motion) <= 100.0 * tolerance &&
           judge(problem, p, a, motion, measure, Judge::certificate).solved(tolerance);
  };
}

struct Found {
  Vector p, a;
  bool solved = false;
};

/// Newton's method on the same problem from where interior points end.
Found followed_by_newton(const Problem& problem, const InteriorPointEnd& end) {
  const IsSolution content = certified(problem);
  if (end.p.size() == 0 || end.content) return {end.p, end.a, end.content};
  const BDifferentiableEquations equations(problem, 1.0);
  NewtonOptions options;
  options.relative = 1e-12;
  options.content = content;
  options.ask_when_stuck = true;
  const NewtonEnd newton_end = newton(equations, end.p, end.a, options);
  return {newton_end.p, newton_end.a,
          content(newton_end.p, newton_end.a, motion_of(problem, newton_end.p, newton_end.a))};
}

Found solved_inside(const Problem& problem) {
  Found found;
  for (const double start : {1.0, 0.1, 10.0}) {
    found = followed_by_newton(problem, interior_points(problem, certified(problem), {}, start));
    if (found.solved) break;
  }
  return found;
}

struct KnownCase {
  int dimension;
  Laws laws;
  int seed;
};

void PrintTo(const KnownCase& known, std::ostream* out) {
  *out << known.dimension << (known.laws == Laws::all ? " all laws " : " Coulomb ") << known.seed;
}

class KnownSolutions : public ::testing::TestWithParam<KnownCase> {};

TEST_P(KnownSolutions, AreFoundAndNewtonConfirmsThem) {
  const auto [dimension, laws, seed] = GetParam();
  std::mt19937 random(static_cast<unsigned>(seed));
  for (int k = 0; k < 125; ++k) {
    const Problem problem = with_known_solution(random, dimension, laws);
    ASSERT_TRUE(may_take_interior_points(problem));
    EXPECT_TRUE(solved_inside(problem).solved) << k << ": " << problem.pairs() << " pairs, " << problem.G.cols();
  }
}

INSTANTIATE_TEST_SUITE_P(Plane, KnownSolutions,
                         ::testing::Values(KnownCase{2, Laws::coulomb, 1}, KnownCase{2, Laws::coulomb, 2},
                                           KnownCase{2, Laws::all, 3}, KnownCase{2, Laws::all, 4}));
INSTANTIATE_TEST_SUITE_P(Space, KnownSolutions,
                         ::testing::Values(KnownCase{3, Laws::coulomb, 5}, KnownCase{3, Laws::coulomb, 6},
                                           KnownCase{3, Laws::all, 7}, KnownCase{3, Laws::all, 8}));

/// The plane problem with a second tangent that nothing moves.
Problem in_space(const Problem& plane) {
  const Eigen::Index N = plane.pairs(), m = plane.G.cols();
  Matrix W = Matrix::Zero(3 * N, 3 * N), G = Matrix::Zero(3 * N, m);
  Vector q = Vector::Zero(3 * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    for (Eigen::Index j = 0; j < N; ++j) {
      W.block(3 * i, 3 * j, 2, 2) = plane.W.dense().block(2 * i, 2 * j, 2, 2);
      W(3 * i + 2, 3 * j + 2) = plane.W.dense()(2 * i + 1, 2 * j + 1);
    }
    G.middleRows(3 * i, 2) = plane.G.dense().middleRows(2 * i, 2);
    q.segment(3 * i, 2) = plane.q.segment(2 * i, 2);
  }
  Problem space = plane;
  space.dimension = 3;
  space.W = Delassus(W);
  space.G = RigidMap(G);
  space.q = q;
  return space;
}

TEST(InteriorPointsOfThePlane, AreThoseOfSpaceWithASecondTangentThatNothingMoves) {
  std::mt19937 random(9);
  int compared = 0;
  for (int k = 0; k < 40; ++k) {
    Problem plane = with_known_solution(random, 2, k % 2 == 0 ? Laws::coulomb : Laws::all);
    plane.mu_backward.resize(0);
    plane.mu = 0.3 * plane.mu;  // little enough for one solution
    const Problem space = in_space(plane);
    const Found of_plane = solved_inside(plane), of_space = solved_inside(space);
    if (!of_plane.solved && !of_space.solved) continue;  // with other coefficients there may be no solution
    ASSERT_TRUE(of_plane.solved && of_space.solved) << k;
    const double force = of_plane.p.lpNorm<Eigen::Infinity>();
    ++compared;
    for (int i = 0; i < plane.pairs(); ++i) {
      EXPECT_LE((of_plane.p.segment(2 * i, 2) - of_space.p.segment(3 * i, 2)).norm(), 1e-6 * force) << k << " " << i;
      EXPECT_LE(std::abs(of_space.p[3 * i + 2]), 1e-6 * force) << k << " " << i;
    }
  }
  EXPECT_GE(compared, 30);
}

TEST(InteriorPointsOfAllLaws, InUnitsThatArePowersOfTwoDoNotChangeABit) {
  std::mt19937 random(10);
  for (const int dimension : {2, 3}) {
    const Problem problem = with_known_solution(random, dimension, Laws::all);
    const InteriorPointEnd end = interior_points(problem, {});
    const auto with = [&](double length, double force) {
      Problem other = problem;
      other.W = problem.W.scaled(length / force);
      other.q *= length;
      other.cohesion *= force, other.tension *= force, other.f *= force * length;
      other.G = RigidMap(Matrix(length * problem.G.dense()));  // rigid motions without unit
      return interior_points(other, {});
    };
    for (const auto& [length, force] : {std::pair(1024.0, 1.0), {1.0, 0x1p30}, {0x1p-20, 0x1p10}}) {
      const InteriorPointEnd other = with(length, force);
      EXPECT_EQ(other.p, Vector(force * end.p)) << length << " " << force;
      EXPECT_EQ(other.iterations, end.iterations);
    }
  }
}
