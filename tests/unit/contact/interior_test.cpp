// One method of interior points for every pair law, in the plane and in space. Problems are made from a known solution:
// forces, motions and rigid motions that satisfy the law are chosen first, and q and f follow from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "scabo/contact/interior/held_slips.hpp"
#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/interior/tangential_cone.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/kkt/saddle_system.hpp"
#include "scabo/contact/newton/b_differentiable.hpp"
#include "scabo/contact/newton/newton.hpp"
#include "scabo/contact/solve.hpp"
#include "support/decompositions.hpp"
#include "support/random.hpp"
#include "unit/contact/towers.hpp"

namespace scabo::contact {
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

/// A judge as increments have it.
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
  const IsSolution accepts = certified(problem);
  if (end.p.size() == 0 || end.accepted) return {end.p, end.a, end.accepted};
  const BDifferentiableEquations equations(problem, 1.0);
  NewtonOptions options;
  options.relative = 1e-12;
  options.accepts = accepts;
  options.ask_when_stuck = true;
  const NewtonEnd newton_end = newton(equations, end.p, end.a, options);
  return {newton_end.p, newton_end.a,
          accepts(newton_end.p, newton_end.a, motion_of(problem, newton_end.p, newton_end.a))};
}

Found solved_inside(const Problem& problem) {
  Found found;
  for (const double start : {1.0, 0.1, 10.0}) {
    found = followed_by_newton(problem, interior_points(problem, certified(problem), {}, start));
    if (found.solved) break;
  }
  return found;
}

/// Slips held until the natural map is at most `aim`.
InteriorPointEnd with_slips_held(const Problem& problem, double aim) {
  InteriorPointEnd found;
  hold_slips(problem, {}, {}, [&](InteriorPointEnd end) {
    found = std::move(end);
    return found.residual <= aim;
  });
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

// By interior points and Newton's method after them; hardly ever by the other stages alone.
TEST_P(KnownSolutions, AreFoundAndNewtonConfirmsThem) {
  const auto [dimension, laws, seed] = GetParam();
  std::mt19937 random(static_cast<unsigned>(seed));
  int inside = 0;
  for (int k = 0; k < 125; ++k) {
    const Problem problem = with_known_solution(random, dimension, laws);
    ASSERT_TRUE(may_take_interior_points(problem));
    inside += static_cast<int>(solved_inside(problem).solved);
    EXPECT_EQ(solve(problem).status, Status::solved) << k << ": " << problem.pairs() << " pairs, " << problem.G.cols();
  }
  EXPECT_GE(inside, 124);
}

INSTANTIATE_TEST_SUITE_P(Plane, KnownSolutions,
                         ::testing::Values(KnownCase{2, Laws::coulomb, 1}, KnownCase{2, Laws::coulomb, 2},
                                           KnownCase{2, Laws::all, 3}, KnownCase{2, Laws::all, 4}));
INSTANTIATE_TEST_SUITE_P(Space, KnownSolutions,
                         ::testing::Values(KnownCase{3, Laws::coulomb, 5}, KnownCase{3, Laws::coulomb, 6},
                                           KnownCase{3, Laws::all, 7}, KnownCase{3, Laws::all, 8},
                                           KnownCase{3, Laws::all, 9}, KnownCase{3, Laws::all, 10},
                                           KnownCase{3, Laws::all, 11}, KnownCase{3, Laws::all, 12},
                                           KnownCase{3, Laws::all, 13}, KnownCase{3, Laws::all, 14}));

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

TEST(AllStages, SolveThePlaneAsSpaceWithASecondTangentThatNothingMoves) {
  std::mt19937 random(13);
  int compared = 0;
  for (int k = 0; k < 60; ++k) {
    Problem plane = with_known_solution(random, 2, k % 2 == 0 ? Laws::coulomb : Laws::all);
    plane.mu_backward.resize(0);
    plane.mu = 0.3 * plane.mu;  // little enough for one solution
    const Solution of_plane = solve(plane), of_space = solve(in_space(plane));
    ASSERT_EQ(of_plane.status, of_space.status) << k;
    if (of_plane.status != Status::solved) continue;  // with other coefficients there may be no solution
    ++compared;
    for (int i = 0; i < plane.pairs(); ++i) {
      const Vector difference =
          of_space.p.segment(3 * i, 3) - (Vector(3) << of_plane.p.segment(2 * i, 2), 0.0).finished();
      EXPECT_LE(difference.norm(), 1e-8 * of_plane.p.lpNorm<Eigen::Infinity>()) << k << " " << i;
    }
  }
  EXPECT_GE(compared, 45);
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

/// Two elastic blocks pressed together by `load` and pushed along the interface: A may move along the normal alone, B
/// along it and along the interface, and a common translation along the normal is felt by no pair.
Problem squeezed_blocks(int pairs, double load, double push, double mu) {
  Problem problem;
  problem.dimension = 2;
  std::mt19937 random(3);
  const Matrix S = Matrix::Identity(2 * pairs, 2 * pairs) +
                   0.1 * normal_vector(random, 4 * pairs * pairs).reshaped(2 * pairs, 2 * pairs);
  problem.W = Delassus(Matrix(S * S.transpose()));
  problem.q = Vector::Zero(2 * pairs);
  problem.mu = Vector::Constant(pairs, mu);
  Matrix G = Matrix::Zero(2 * pairs, 3);
  for (int i = 0; i < pairs; ++i) {
    G(2 * i, 0) = -1.0, G(2 * i, 1) = 1.0;  // along the normal: A, B
    G(2 * i + 1, 2) = 1.0;                  // along the interface: B
  }
  problem.G = RigidMap(G);
  problem.f = Eigen::Vector3d(load, -load, push);
  return problem;
}

TEST(InteriorPointsOfSqueezedBlocks, BalanceTheLoadWithAndWithoutTheCommonTranslation) {
  constexpr double load = 200e3, push = 30e3;
  const Problem whole = squeezed_blocks(20, load, push, 0.5);
  Problem relative = whole;  // without the common translation
  Matrix G(40, 2);
  G << whole.G.dense().col(1), whole.G.dense().col(2);
  relative.G = RigidMap(G);
  relative.f = Vec2(-load, push);
  const Found reference = solved_inside(relative);
  ASSERT_TRUE(reference.solved);
  for (const Problem& problem : {relative, whole}) {
    const Found found = solved_inside(problem);
    ASSERT_TRUE(found.solved);
    double N = 0.0, T = 0.0;
    for (int i = 0; i < problem.pairs(); ++i) N += found.p[2 * i], T += found.p[2 * i + 1];
    EXPECT_NEAR(N, load, 1e-8 * load);
    EXPECT_NEAR(T, -push, 1e-8 * load);
    EXPECT_LE((found.p - reference.p).norm(), 1e-7 * load);
  }
}

class InteriorPointsOfTowers : public ::testing::TestWithParam<TowerCase> {};

TEST_P(InteriorPointsOfTowers, ReachTheLaw) {
  const auto [d, blocks, points] = GetParam();
  for (const bool differs : {false, true}) {
    Problem problem = tower_of_blocks(d, blocks, points, 0.4);
    if (differs)
      for (Eigen::Index i = 0; i < problem.mu.size(); ++i) problem.mu[i] = i % 3 == 0 ? 0.2 : 0.7;
    const InteriorPointEnd end = interior_points(problem, {});
    ASSERT_EQ(end.p.size(), problem.q.size());
    EXPECT_FALSE(end.accepted);  // nobody was asked
    expect_the_law(problem, end.p, 1e-6);
  }
}

TEST_P(InteriorPointsOfTowers, WithSlipsHeldReachTheLaw) {
  const auto [d, blocks, points] = GetParam();
  const Problem problem = tower_of_blocks(d, blocks, points, 0.4);
  const InteriorPointEnd end = with_slips_held(problem, 1e-8);
  ASSERT_EQ(end.p.size(), problem.q.size());
  EXPECT_LE(end.residual, 1e-8);
  expect_the_law(problem, end.p, 1e-6);
}

// What the judge accepts is handed over with its states: pairs that slip are at the bound to the last digit, open ones
// without any force. Inside the cones, where the points are, there are none of either.
TEST_P(InteriorPointsOfTowers, EndAtTheBoundaryOfTheCones) {
  const auto [d, blocks, points] = GetParam();
  const Problem problem = tower_of_blocks(d, blocks, points, 0.4);
  const InteriorPointEnd end = interior_points(problem, [&](const Vector& p, const Vector&, const Vector& motion) {
    return Measure(problem).natural_map(problem, p, motion) <= 1e-5;
  });
  ASSERT_TRUE(end.accepted);
  int at_the_boundary = 0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double bound = problem.mu[i] * end.p[d * i], friction = end.p.segment(d * i + 1, d - 1).norm();
    at_the_boundary += std::abs(friction - bound) <= 1e-13 * end.p.lpNorm<Eigen::Infinity>();
  }
  EXPECT_GT(at_the_boundary, 0);
}

INSTANTIATE_TEST_SUITE_P(Plane, InteriorPointsOfTowers, ::testing::Values(TowerCase{2, 20, 2}, TowerCase{2, 8, 4}));
INSTANTIATE_TEST_SUITE_P(Space, InteriorPointsOfTowers, ::testing::Values(TowerCase{3, 12, 3}));

TEST(InteriorPointsOfAllLaws, TheJudgeEndsThem) {
  const Problem problem = tower_of_blocks(3, 4, 2, 0.4);
  int asked = 0;
  const InteriorPointEnd end =
      interior_points(problem, [&](const Vector&, const Vector&, const Vector&) { return ++asked == 3; });
  EXPECT_TRUE(end.accepted);
  EXPECT_EQ(end.iterations, 2);
  EXPECT_LE(interior_points(problem, {}, Deadline::in(0.0)).iterations, 0);
}

TEST(InteriorPointsOfAllLaws, OneCubePushedSidewaysSlides) {
  // One pair, W = 1: the fall q_n = -1 is held by p_n = 1, friction takes 0.4 of the push along (3, 4) / 5 * 2.
  Problem problem;
  problem.dimension = 3;
  problem.W = Delassus(Matrix(Matrix::Identity(3, 3)));
  problem.q = Eigen::Vector3d(-1.0, 1.2, 1.6);
  problem.mu = Vector::Constant(1, 0.4);
  EXPECT_LE((interior_points(problem, {}).p - Eigen::Vector3d(1.0, -0.24, -0.32)).norm(), 1e-8);
  // Slips held: the first round has none of them, so that the pair is lifted by mu |u_t| less than it must be.
  EXPECT_LE((with_slips_held(problem, 1e-9).p - Eigen::Vector3d(1.0, -0.24, -0.32)).norm(), 1e-7);
  // Cohesion of 0.1 takes so much more; tensile strength of 0.5 does not matter under pressure.
  problem.cohesion = Vector::Constant(1, 0.1);
  problem.tension = Vector::Constant(1, 0.5);
  EXPECT_LE((interior_points(problem, {}).p - Eigen::Vector3d(1.0, -0.3, -0.4)).norm(), 1e-8);
  // Lifted by less than its strength it holds, with friction that cohesion alone bounds; by more, it opens.
  problem.q = Eigen::Vector3d(0.3, 1.2, 1.6);
  EXPECT_LE((interior_points(problem, {}).p - Eigen::Vector3d(-0.3, -0.06, -0.08)).norm(), 1e-8);
  problem.q = Eigen::Vector3d(0.7, 1.2, 1.6);
  EXPECT_LE((interior_points(problem, {}).p - Eigen::Vector3d(-0.5, -0.06, -0.08)).norm(), 1e-8);
  // Without friction and cohesion there is no tangential force; bonded, none of the motions.
  problem.q = Eigen::Vector3d(-1.0, 1.2, 1.6);
  problem.mu[0] = problem.cohesion[0] = 0.0;
  EXPECT_LE((interior_points(problem, {}).p - Eigen::Vector3d(1.0, 0.0, 0.0)).norm(), 1e-8);
  problem.cohesion[0] = problem.tension[0] = HUGE_VAL;
  EXPECT_LE((interior_points(problem, {}).p - Eigen::Vector3d(1.0, -1.2, -1.6)).norm(), 1e-8);
}

template <int d>
void expect_scaling_and_products(std::mt19937& random) {
  using Cone = TangentialCone<d>;
  using V = typename Cone::V;
  for (int k = 0; k < 50; ++k) {
    const auto inside = [&] {
      typename Cone::T t;
      for (double& component : t) component = normal(random);
      const double bound = t.norm() * (1.0 + std::pow(10.0, -uniform(random, 0.0, 6.0)));
      return V(Cone::of_force(bound, bound, t));
    };
    const V X = inside(), Y = inside();
    ASSERT_TRUE(Cone::inside(X) && Cone::inside(Y));
    typename Cone::M Q;
    typename Cone::TT directions;
    V phi;
    Cone::scaling(X, Y, Q, directions, phi);
    const V HX = Q * phi.cwiseAbs2().cwiseProduct(Q.transpose() * X);
    EXPECT_LE((HX - Y).norm(), 1e-8 * Y.norm());  // F X = F^-1 Y
    EXPECT_LE((Cone::quotient(Cone::product(X, Y), X) - Y).norm(), 1e-7 * Y.norm());
    const V dX = -inside() - 0.1 * X;
    const double reach = Cone::reach(X, dX);
    EXPECT_TRUE(Cone::inside(X + (1.0 - 1e-9) * reach * dX));
    EXPECT_FALSE(Cone::inside(X + (1.0 + 1e-9) * reach * dX));
  }
}

TEST(TangentialCones, AreScaledToOnePointAndLeftWhereStepsEnd) {
  std::mt19937 random(13);
  expect_scaling_and_products<2>(random);
  expect_scaling_and_products<3>(random);
}

TEST(SaddleSystems, OfSparseAndDenseMatricesSolveWhatTheyStandFor) {
  std::mt19937 random(14);
  for (const int d : {2, 3}) {
    constexpr int N = 12, m = 3;
    const Matrix S = normal_vector(random, d * N * d * N).reshaped(d * N, d * N);
    Matrix W = S * S.transpose();
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j)
        if (std::abs(i - j) > 2) W.block(d * i, d * j, d, d).setZero();
    Problem problem;
    problem.dimension = d;
    problem.mu = Vector::Constant(N, 0.3);
    problem.G = RigidMap(Matrix(normal_vector(random, d * N * m).reshaped(d * N, m)));
    problem.f = Vector::Zero(m);
    problem.q = Vector::Zero(d * N);
    SaddleRows rows;  // one unknown of even pairs, all of odd ones
    std::vector<int> pair;
    for (int i = 0; i < N; ++i) pair.insert(pair.end(), i % 2 == 0 ? 1u : static_cast<unsigned>(d), i);
    rows.resize(pair.size());
    rows.pair = pair;
    const Eigen::Index n = rows.size();
    Matrix L = Matrix::Zero(d * N, n), C = L;
    for (Eigen::Index j = 0; j < n; ++j) {
      const int from = d * pair[static_cast<std::size_t>(j)];
      L.col(j).segment(from, d) = rows.L.col(j).head(d) = normal_vector(random, d);
      C.col(j).segment(from, d) = rows.C.col(j).head(d) = normal_vector(random, d);
      rows.D[j] = std::pow(10.0, uniform(random, -3.0, 6.0));
    }
    rows.E = 1e-3;
    const Matrix G = problem.G.dense();
    Matrix A(n + m, n + m);
    A << L.transpose() * W * C + Matrix(rows.D.asDiagonal()), L.transpose() * G, G.transpose() * C,
        -rows.E * Matrix::Identity(m, m);
    const Vector right = normal_vector(random, n + m);
    for (const bool sparse : {false, true}) {
      problem.W = sparse ? Delassus(Eigen::SparseMatrix<double>(W.sparseView())) : Delassus(W);
      SaddleSystem system(problem);
      ASSERT_TRUE(system.factorise(rows));
      const Vector x = system.solve(right);
      EXPECT_LE((A * x - right).norm(), 1e-9 * right.norm()) << d << sparse;
      Vector forces = Vector::Zero(d * N);
      rows.add_forces(x.head(n), d, forces);
      EXPECT_LE((forces - C * x.head(n)).norm(), 1e-12 * (C * x.head(n)).norm());
    }
  }
}

}  // namespace
}  // namespace scabo::contact
