// Chains of bodies, and pairs that hardly move, by sweeps and by all stages. Sweeps of single pairs:
// pair_problem_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/solve.hpp"
#include "scabo/contact/sweeps/long_sweeps.hpp"
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

TEST(LongSweeps, LeavePairsThatNothingMovesAndHoldThoseWithoutTangentialMotion) {
  Matrix W = Matrix::Zero(9, 9);
  W(3, 3) = 2.0;                             // moves along its normal only
  W.block(6, 6, 3, 3) = Matrix::Ones(3, 3);  // rank 1
  Vector q(9);
  q << 1.0, 0.5, 0.0, -1.0, 0.3, 0.1, -1.0, 0.2, 0.1;
  const Problem problem = coulomb(3, W, q, 0.4);
  LongSweeps sweeps(problem, Vector::Zero(9));
  sweeps.run(2000, {});
  EXPECT_TRUE(sweeps.p().allFinite());
  EXPECT_EQ(sweeps.p()[0], 0.0);
  EXPECT_EQ(sweeps.p()[3], 0.5);
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

TEST(Chains, OnSoftGroundAreSolvedToTheirNaturalMap) {
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-10;
  EXPECT_EQ(solve(chain(3, 60, 1e-7, 0.4), {}, options).status, Status::solved);
}

}  // namespace
}  // namespace scabo::contact
