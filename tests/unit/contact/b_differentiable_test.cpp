#include "scabo/contact/newton/b_differentiable.hpp"

#include <gtest/gtest.h>

#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/newton/newton.hpp"
#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

/// H case by case from eqs. (7) and (8), with one r for both tangents.
struct Plain {
  const Problem& problem;
  Vector r;
  Plain(const Problem& given, double factor) : problem(given), r(given.q.size()) {
    const Eigen::Index d = given.dimension;
    for (Eigen::Index i = 0; i < given.pairs(); ++i) {
      const Vector W = given.W.dense().diagonal().segment(d * i, d);
      r[d * i] = factor / W[0];
      r.segment(d * i + 1, d - 1).setConstant(factor / W.tail(d - 1).mean());
    }
  }
  Vector motion(const Vector& z) const {
    const Eigen::Index n = problem.q.size();
    return problem.q + problem.W.dense() * z.head(n) + problem.G * z.tail(z.size() - n);
  }
  Vector value(const Vector& z) const {
    const Eigen::Index n = problem.q.size(), m = z.size() - n, d = problem.dimension;
    const Vector u = motion(z);
    Vector H(n + m);
    for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
      const double p_n = z[d * i];
      H[d * i] = std::min(r[d * i] * u[d * i], p_n + problem.tension_of(i));
      const Vector p_t = z.segment(d * i + 1, d - 1);
      const Vector trial = p_t - r[d * i + 1] * u.segment(d * i + 1, d - 1);
      const bool backward = d == 2 && problem.mu_backward.size() > 0 && trial[0] > 0.0;
      const double mu = backward ? problem.mu_backward[i] : problem.mu[i];
      const double bound = problem.cohesion_of(i) + mu * std::max(p_n, 0.0), size = trial.norm();
      const double lambda = size > 0.0 ? std::min(bound / size, 1.0) : 1.0;
      H.segment(d * i + 1, d - 1) = p_t - lambda * trial;
    }
    H.tail(m) = problem.G.transpose() * z.head(n) + problem.f;
    return H;
  }
};

Vector random_vector(std::mt19937& random, Eigen::Index size) {
  return Vector::NullaryExpr(size, [&] { return uniform(random, -1, 1); });
}

/// Where one pair is put.
enum class Place { anywhere, normal_tie, no_force, edge, tip, cohesive_edge, pulled, frictionless, one_sided, count };

/// The plane, with one coefficient or one for each direction, and space.
struct Kind {
  int d = 2;
  bool by_direction = false;
};

/// A problem and a point z at which the pairs lie on kinks of every kind, alone and together.
struct Kinked {
  Problem problem;
  Vector z;
};

Kinked kinked(std::mt19937& random, const Kind& kind, bool kinks) {
  const int d = kind.d;
  const int pairs = whole(random, 1, 5);
  Kinked result;
  Problem& problem = result.problem;
  if (d == 2 && whole(random, 0, 2) == 0) {
    problem = floating_problem(random, pairs, 1.0);
  } else {
    problem = held_problem(random, pairs, 1.0, d);
  }
  for (double& mu : problem.mu) mu = uniform(random, 0.05, 1.0);
  if (kind.by_direction) {
    problem.mu_backward = problem.mu;
    for (double& mu : problem.mu_backward) mu = uniform(random, 0.05, 1.0);
  }
  const auto mu_of = [&](int i, double p_t) {
    return kind.by_direction && p_t > 0.0 ? problem.mu_backward[i] : problem.mu[i];
  };
  problem.cohesion = Vector::Zero(pairs);
  problem.tension = Vector::Zero(pairs);
  Vector& z = result.z;
  z = random_vector(random, problem.q.size() + problem.G.cols());
  const Plain plain(problem, 1.0);
  Vector wanted = plain.r.cwiseProduct(plain.motion(z));  // r u
  for (int i = 0; kinks && i < pairs; ++i) {
    auto p_t = z.segment(d * i + 1, d - 1);
    const Vector e = random_vector(random, d - 1).normalized();
    double& p_n = z[d * i];
    const int places = static_cast<int>(kind.by_direction ? Place::count : Place::one_sided);
    switch (static_cast<Place>(whole(random, 0, places - 1))) {
      case Place::anywhere:
        break;
      case Place::normal_tie:
        wanted[d * i] = p_n;
        break;
      case Place::no_force:
        p_n = 0.0;
        if (whole(random, 0, 1) == 0) wanted[d * i] = 0.0;
        break;
      case Place::edge:
        p_n = std::abs(p_n);
        wanted.segment(d * i + 1, d - 1) = p_t - mu_of(i, e[0]) * p_n * e;
        break;
      case Place::tip:
        p_n = 0.0;
        p_t.setZero();
        wanted.segment(d * i + 1, d - 1).setZero();
        if (whole(random, 0, 1) == 0) wanted[d * i] = 0.0;
        break;
      case Place::cohesive_edge:  // at p_n = 0 or not
        problem.cohesion[i] = 0.3;
        if (whole(random, 0, 1) == 0) p_n = 0.0;
        wanted.segment(d * i + 1, d - 1) = p_t - (0.3 + mu_of(i, e[0]) * std::max(p_n, 0.0)) * e;
        break;
      case Place::pulled:
        p_n = -std::abs(p_n);
        problem.tension[i] = whole(random, 0, 1) == 0 ? -p_n + wanted[d * i] : 0.5;
        if (problem.tension[i] < 0.0) problem.tension[i] = 0.0;
        break;
      case Place::frictionless:
        problem.mu[i] = 0.0;
        if (kind.by_direction) problem.mu_backward[i] = 0.0;
        if (whole(random, 0, 1) == 0) p_t.setZero();
        break;
      case Place::one_sided:  // on the edge without friction, at the tip of the cone or not
        (whole(random, 0, 1) == 0 ? problem.mu : problem.mu_backward)[i] = 0.0;
        p_n = whole(random, 0, 2) == 0 ? 0.0 : std::abs(p_n);
        wanted.segment(d * i + 1, d - 1) = p_t;
        break;
      case Place::count:
        break;
    }
  }
  problem.q += wanted.cwiseQuotient(plain.r) - plain.motion(z);
  return result;
}

Vector H_of(const BDifferentiableEquations& equations, const Vector& z) {
  const Problem& problem = equations.problem();
  return equations.residual(z.head(problem.q.size()), z.tail(problem.G.cols())).H;
}

class BDifferentiable : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(PlaneAndSpace, BDifferentiable, testing::Values(Kind{2}, Kind{3}, Kind{2, true}));

TEST_P(BDifferentiable, EquationsAreThoseOfTheTheory) {
  std::mt19937 random(21);
  for (int k = 0; k < 300; ++k) {
    const Kinked at = kinked(random, GetParam(), k % 2 == 0);
    const double factor = std::pow(10.0, uniform(random, -2, 2));
    const BDifferentiableEquations equations(at.problem, factor);
    const Vector H = H_of(equations, at.z), plain = Plain(at.problem, factor).value(at.z);
    EXPECT_LT((H - plain).cwiseAbs().maxCoeff(), 1e-13 * (1.0 + plain.cwiseAbs().maxCoeff()));
  }
}

// One-sided: (H(z + t d) - H(z)) / t -> H'(z; d) for t -> 0+, on kinks too, at a rate of t.
TEST_P(BDifferentiable, HaveOneSidedDerivativesInEveryDirection) {
  std::mt19937 random(22);
  for (int k = 0; k < 600; ++k) {
    const Kinked at = kinked(random, GetParam(), true);
    const BDifferentiableEquations equations(at.problem, 1.0);
    const Plain plain(at.problem, 1.0);
    const Residual here = equations.residual(at.z.head(at.problem.q.size()), at.z.tail(at.problem.G.cols()));
    const Vector H = plain.value(at.z);
    for (int direction = 0; direction < 4; ++direction) {
      Vector d = random_vector(random, at.z.size());
      if (direction == 1) d = -d.cwiseAbs();
      if (direction == 2) d = d.cwiseProduct(random_vector(random, d.size()).cwiseSign().cwiseMax(0.0));
      const Vector slope = equations.derivative(here, d);
      const auto error = [&](double t) { return ((plain.value(at.z + t * d) - H) / t - slope).cwiseAbs().maxCoeff(); };
      const double size = 1.0 + slope.cwiseAbs().maxCoeff();
      EXPECT_LT(error(1e-8), 3e-5 * size) << "problem " << k;
    }
  }
}

// H'(z; s d) = s H'(z; d) for s > 0, and on no kink H'(z; -d) = -H'(z; d).
TEST_P(BDifferentiable, DerivativeIsPositivelyHomogeneous) {
  std::mt19937 random(25);
  for (int k = 0; k < 200; ++k) {
    const Kinked at = kinked(random, GetParam(), k % 2 == 0);
    const BDifferentiableEquations equations(at.problem, 1.0);
    const Residual here = equations.residual(at.z.head(at.problem.q.size()), at.z.tail(at.problem.G.cols()));
    const Vector d = random_vector(random, at.z.size());
    const Vector slope = equations.derivative(here, d);
    EXPECT_LT((equations.derivative(here, 2.0 * d) - 2.0 * slope).cwiseAbs().maxCoeff(), 1e-12);
    if (k % 2 == 1) EXPECT_LT((equations.derivative(here, -d) + slope).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// The direction solves H(z) + H'(z; d) = 0, the true derivative at ties included.
TEST_P(BDifferentiable, DirectionSolvesTheLinearisedEquations) {
  std::mt19937 random(23);
  int directions = 0, exact = 0, tied = 0, exact_on_ties = 0;
  for (int k = 0; k < 600; ++k) {
    const Kinked at = kinked(random, GetParam(), k % 2 == 0);
    const double factor = std::pow(10.0, uniform(random, -1, 1));
    const BDifferentiableEquations equations(at.problem, factor);
    const Vector p = at.z.head(at.problem.q.size());
    const Residual here = equations.residual(p, at.z.tail(at.problem.G.cols()));
    const bool ties = std::any_of(here.branches.begin(), here.branches.end(), [](const Branch& b) { return b.tied(); });
    Residual followed = here;
    Vector d;
    if (!NewtonDirection(equations).find(followed, 0.0, d)) {
      EXPECT_GT(at.problem.G.cols(), 0) << "only rigid motions can leave a branch without a direction";
      continue;
    }
    ++directions;
    tied += ties;
    const double size = 1.0 + here.H.cwiseAbs().maxCoeff() + d.cwiseAbs().maxCoeff();
    const bool solves = (equations.derivative(here, d) + here.H).cwiseAbs().maxCoeff() < 1e-9 * size;
    exact += solves;
    exact_on_ties += ties && solves;
    if (!ties) EXPECT_TRUE(solves) << "problem " << k;
  }
  EXPECT_GT(directions, 400);
  EXPECT_GT(tied, 100);
  // At ties the direction is that of one branch, which need not be the one that it leads to; it mostly is.
  EXPECT_GT(exact_on_ties, tied * 4 / 5);
  RecordProperty("on_ties", tied);
  RecordProperty("exact_on_ties", exact_on_ties);
}

TEST_P(BDifferentiable, NewtonStaysAtASolution) {
  std::mt19937 random(24);
  int converged = 0;
  for (int k = 0; k < 200; ++k) {
    Problem problem = held_problem(random, whole(random, 1, 12), 0.8, GetParam().d);
    if (GetParam().by_direction) problem.mu_backward = 0.3 * problem.mu;
    const BDifferentiableEquations equations(problem, 1.0);
    NewtonOptions options;
    options.small = 1e-12;
    const NewtonEnd end = newton(equations, Vector::Zero(problem.q.size()), Vector(), options);
    EXPECT_EQ(end.trace.size(), static_cast<std::size_t>(end.iterations + 1));
    EXPECT_LE(end.iterations, 50);
    if (!end.converged) continue;
    ++converged;
    EXPECT_LT(violation(problem, end.p, end.a), 1e-10);
    const NewtonEnd again = newton(equations, end.p, end.a, options);
    EXPECT_EQ(again.iterations, 0);
  }
  EXPECT_GT(converged, 190);
}

// Two pairs know their branches, one by its force and one by its motion; the third knows neither.
TEST(BDifferentiableInThePlane, PairsBelowALevelStick) {
  Problem problem;
  problem.W = Matrix(2.0 * Matrix::Identity(6, 6));
  problem.q = Vector::Zero(6);
  problem.mu = Vector::Constant(3, 0.5);
  problem.q << -2.0, 0.0, 0.2, 0.0, 1e-3, -4e-3;
  Vector p = Vector::Zero(6);
  p << 1.0, 0.1, 0.0, 0.0, 0.0, 1e-4;
  const BDifferentiableEquations equations(problem, 1.0);
  const Residual before = equations.residual(p, Vector());
  Residual at = before;
  EXPECT_EQ(equations.stick_below(1e-5, p, at), 0);
  EXPECT_EQ(equations.stick_below(1e-2, p, at), 1);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(at.branches[i].same_branch(before.branches[i])) << i;
  EXPECT_EQ(at.H.head(4), before.H.head(4));
  EXPECT_TRUE(at.branches[2].contact);
  EXPECT_EQ(at.branches[2].tangent, Branch::Tangent::stick);
  EXPECT_DOUBLE_EQ(at.H[4], 0.5e-3);  // motions over W_ii
  EXPECT_DOUBLE_EQ(at.H[5], 0.5 * (-4e-3 + 2e-4));

  problem.mu[2] = 0.0;  // no friction: the force along the joint is 0
  at = before;
  EXPECT_EQ(equations.stick_below(1e-2, p, at), 1);
  EXPECT_EQ(at.branches[2].tangent, Branch::Tangent::free);
  EXPECT_DOUBLE_EQ(at.H[5], 1e-4);
}

// One pair alone: slip across the force, the cone's tip and its edge, solved by hand.
TEST(BDifferentiableInSpace, OnePairIsSolvedByHand) {
  Problem problem;
  problem.dimension = 3;
  problem.W = Matrix(Matrix::Identity(3, 3));
  problem.mu = Vector::Constant(1, 0.5);
  problem.G.resize(3, 0);
  const auto forces = [&](const Eigen::Vector3d& q) {
    problem.q = q;
    NewtonOptions options;
    options.small = 1e-13;
    const NewtonEnd end = newton(BDifferentiableEquations(problem, 1.0), Vector::Zero(3), Vector(), options);
    EXPECT_TRUE(end.converged);
    return Eigen::Vector3d(end.p);
  };
  EXPECT_LT((forces({1.0, 2.0, -1.0}) - Eigen::Vector3d::Zero()).norm(), 1e-12);           // open
  EXPECT_LT((forces({-2.0, 0.3, -0.4}) - Eigen::Vector3d(2.0, -0.3, 0.4)).norm(), 1e-12);  // sticks
  EXPECT_LT((forces({-2.0, 0.6, -0.8}) - Eigen::Vector3d(2.0, -0.6, 0.8)).norm(), 1e-12);  // on the edge
  EXPECT_LT((forces({-2.0, 3.0, -4.0}) - Eigen::Vector3d(2.0, -0.6, 0.8)).norm(), 1e-12);  // slips
  EXPECT_LT((forces({0.0, 3.0, -4.0}) - Eigen::Vector3d::Zero()).norm(), 1e-12);           // at the tip
}

}  // namespace
}  // namespace scabo::contact
