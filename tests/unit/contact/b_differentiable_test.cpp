#include "scabo/contact/b_differentiable.hpp"

#include <gtest/gtest.h>

#include "unit/contact/problems.hpp"

namespace scabo::contact {
namespace {

using namespace test;

/// H and its directional derivative, case by case from eqs. (7) and (8): min and lambda are piecewise linear
/// in the plane, so H(z + t d) = H(z) + t H'(z; d) exactly for t small enough, kinks included.
struct Plain {
  const Problem& problem;
  Vector r;
  explicit Plain(const Problem& given, double factor)
      : problem(given), r(factor * given.W.diagonal().cwiseInverse()) {}

  Vector motion(const Vector& z) const {
    const Eigen::Index n = problem.q.size();
    return problem.q + problem.W.dense() * z.head(n) + problem.G * z.tail(z.size() - n);
  }
  Vector value(const Vector& z) const {
    const Eigen::Index n = problem.q.size(), m = z.size() - n;
    const Vector motion_z = motion(z);
    Vector H(n + m);
    for (Eigen::Index i = 0; i < n; i += 2) {
      H[i] = std::min(r[i] * motion_z[i], z[i]);
      const double trial = z[i + 1] - r[i + 1] * motion_z[i + 1],
                   bound = problem.mu[i / 2] * std::max(z[i], 0.0);
      H[i + 1] = z[i + 1] - std::clamp(trial, -bound, bound);  // lambda p_t(r)
    }
    H.tail(m) = problem.G.transpose() * z.head(n) + problem.f;
    return H;
  }
  Vector derivative(const Vector& z, const Vector& d) const {
    const Eigen::Index n = problem.q.size(), m = d.size() - n;
    const Vector motion_z = motion(z), motion_d = motion(d) - problem.q;
    Vector slope(n + m);
    for (Eigen::Index i = 0; i < n; i += 2) {
      const double gap = r[i] * motion_z[i], gap_d = r[i] * motion_d[i];
      slope[i] = gap < z[i] ? gap_d : gap > z[i] ? d[i] : std::min(gap_d, d[i]);
      const double mu = problem.mu[i / 2];
      const double trial = z[i + 1] - r[i + 1] * motion_z[i + 1],
                   trial_d = d[i + 1] - r[i + 1] * motion_d[i + 1];
      const double bound = mu * std::max(z[i], 0.0);
      const double bound_d = mu * (z[i] > 0.0 ? d[i] : z[i] < 0.0 ? 0.0 : std::max(d[i], 0.0));
      double projected = 0.0;  // derivative of the projection of trial on [-bound, bound]
      if (std::abs(trial) < bound)
        projected = trial_d;
      else if (bound == 0.0 && trial == 0.0)
        projected = std::clamp(trial_d, -bound_d, bound_d);
      else if (trial > bound)
        projected = bound_d;
      else if (trial < -bound)
        projected = -bound_d;
      else
        projected = trial > 0.0 ? std::min(trial_d, bound_d) : std::max(trial_d, -bound_d);
      slope[i + 1] = d[i + 1] - projected;
    }
    slope.tail(m) = problem.G.transpose() * d.head(n);
    return slope;
  }
};

Vector random_vector(std::mt19937& random, Eigen::Index size) {
  return Vector::NullaryExpr(size, [&] { return uniform(random, -1, 1); });
}

/// A point of mixed states; `kinks`: with ties of every kind that z alone can have.
Vector random_point(std::mt19937& random, const Problem& problem, bool kinks) {
  const Eigen::Index n = problem.q.size();
  Vector z = random_vector(random, n + problem.G.cols());
  if (kinks)
    for (Eigen::Index i = 0; i < n; i += 2) switch (whole(random, 0, 3)) {
        case 0:
          z[i] = 0.0;
          break;
        case 1:
          z[i] = z[i + 1] = 0.0;
          break;
        case 2:
          z[i] = std::abs(z[i]);
          break;
        default:
          break;
      }
  return z;
}

Problem random_problem(std::mt19937& random) {
  const int pairs = whole(random, 1, 6);
  return whole(random, 0, 1) == 0 ? held_problem(random, pairs, 1.0) : floating_problem(random, pairs, 1.0);
}

Vector H_of(const BDifferentiableEquations& equations, const Problem& problem, const Vector& z) {
  return equations.residual(z.head(problem.q.size()), z.tail(problem.G.cols())).H;
}

TEST(BDifferentiableEquations, AreThoseOfTheTheory) {
  std::mt19937 random(21);
  for (int k = 0; k < 300; ++k) {
    const Problem problem = random_problem(random);
    const double factor = std::pow(10.0, uniform(random, -2, 2));
    const BDifferentiableEquations equations(problem, factor);
    const Vector z = random_point(random, problem, k % 2 == 0);
    const Vector H = H_of(equations, problem, z), plain = Plain(problem, factor).value(z);
    EXPECT_LT((H - plain).cwiseAbs().maxCoeff(), 1e-13 * (1.0 + plain.cwiseAbs().maxCoeff()));
  }
}

// One-sided: H(z + t d) - H(z) - t H'(z; d) = o(t), for z on kinks too. Here even zero below some t.
TEST(BDifferentiableEquations, HaveOneSidedDerivativesInEveryDirection) {
  std::mt19937 random(22);
  for (int k = 0; k < 500; ++k) {
    Problem problem = random_problem(random);
    Vector z = random_point(random, problem, true);
    const Eigen::Index n = problem.q.size();
    const Plain plain(problem, 1.0);
    if (k % 3 == 0) {  // q such that r g = p_n, or |p_t(r)| = mu p_n, at some pairs
      const Vector motion = plain.motion(z);
      for (Eigen::Index i = 0; i < n; i += 2) {
        if (whole(random, 0, 1) == 0) problem.q[i] += z[i] / plain.r[i] - motion[i];
        if (whole(random, 0, 1) == 0)
          problem.q[i + 1] +=
              (z[i + 1] - problem.mu[i / 2] * std::max(z[i], 0.0)) / plain.r[i + 1] - motion[i + 1];
      }
    }
    const BDifferentiableEquations equations(problem, 1.0);
    const Vector H = H_of(equations, problem, z);
    for (int direction = 0; direction < 3; ++direction) {
      const Vector d = random_vector(random, z.size());
      // A tie hit only to rounding is decided by rounding: the quotient is right from t far above it.
      const double t = 1e-7;
      const Vector quotient = (H_of(equations, problem, z + t * d) - H) / t;
      const Vector slope = Plain(problem, 1.0).derivative(z, d),
                   back = Plain(problem, 1.0).derivative(z + 1e-12 * d, d);
      const double error =
          std::min((quotient - slope).cwiseAbs().maxCoeff(), (quotient - back).cwiseAbs().maxCoeff());
      EXPECT_LT(error, 1e-5) << "problem " << k;
    }
  }
}

// The direction solves H(z) + H'(z; d) = 0: away from ties H(z + t d) = (1 - t) H(z) for small t.
TEST(BDifferentiableEquations, DirectionSolvesTheLinearisedEquations) {
  std::mt19937 random(23);
  int directions = 0;
  for (int k = 0; k < 500; ++k) {
    const Problem problem = random_problem(random);
    const double factor = std::pow(10.0, uniform(random, -1, 1));
    const BDifferentiableEquations equations(problem, factor);
    const Vector z = random_point(random, problem, false);
    const Residual at = equations.residual(z.head(problem.q.size()), z.tail(problem.G.cols()));
    const auto d = equations.direction(at);
    if (!d) {
      EXPECT_GT(problem.G.cols(), 0) << "only rigid motions can leave a branch without a direction";
      continue;
    }
    ++directions;
    const double size = 1.0 + at.H.cwiseAbs().maxCoeff() + d->cwiseAbs().maxCoeff();
    EXPECT_LT((Plain(problem, factor).derivative(z, *d) + at.H).cwiseAbs().maxCoeff(), 1e-9 * size)
        << "problem " << k;
    const double t = 1e-6 / size;
    const Vector moved = H_of(equations, problem, z + t * *d);
    EXPECT_LT((moved - (1.0 - t) * at.H).cwiseAbs().maxCoeff(), 1e-6 * t * size + 1e-13 * size)
        << "problem " << k;
  }
  EXPECT_GT(directions, 250);
}

TEST(BDifferentiableEquations, NewtonEndsInOneStepOnTheRightBranchAndItsMeritNeverGrows) {
  std::mt19937 random(24);
  for (int k = 0; k < 200; ++k) {
    const Problem problem = held_problem(random, whole(random, 1, 12), 0.8);
    const BDifferentiableEquations equations(problem, 1.0);
    const Vector none;
    const NewtonEnd end = equations.newton(Vector::Zero(problem.q.size()), none, 1e-12, 50);
    EXPECT_EQ(end.trace.size(), static_cast<std::size_t>(end.iterations + 1));
    EXPECT_LE(end.iterations, 50);
    if (!end.converged) continue;
    EXPECT_LT(violation(problem, end.p, end.a), 1e-11);
    const NewtonEnd again = equations.newton(end.p, end.a, 1e-12, 50);  // a solution stays
    EXPECT_EQ(again.iterations, 0);
  }
}

}  // namespace
}  // namespace scabo::contact
