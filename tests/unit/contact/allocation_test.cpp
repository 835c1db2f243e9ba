// The inner loop of Newton's method takes no memory: direction, line search and evaluation of H reuse what the first
// iteration took. Every call of malloc is counted: operator new and Eigen's aligned
// memory end there.
#include <gtest/gtest.h>

#include <atomic>

#include "scabo/contact/newton/newton.hpp"
#include "unit/contact/problems.hpp"

namespace {
std::atomic<long> calls{0};
}

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  calls.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

namespace scabo::contact {
namespace {

using namespace test;

/// A problem of many slipping, sticking and open pairs; with rigid motions where `floating`.
Problem problem_of(int d, bool floating) {
  std::mt19937 random(7);
  Problem problem = held_problem(random, 60, 0.0, d);
  problem.mu.setConstant(0.6);
  if (!floating) return problem;
  Matrix G = Matrix::Zero(60 * d, 1);
  for (int i = 0; i < 60; ++i) G(d * i, 0) = 1.0;
  problem.G = G;
  problem.f = Vector::Constant(1, -30.0);
  return problem;
}

TEST(Allocation, TheCounterCounts) {
  const long before = calls;
  const Vector some = Vector::Ones(100);
  EXPECT_GT(calls, before);
  EXPECT_EQ(some.sum(), 100.0);
}

TEST(Allocation, NewtonTakesNoMemoryAfterItsFirstIteration) {
  for (int d : {2, 3})
    for (bool floating : {false, true}) {
      const Problem problem = problem_of(d, floating);
      const BDifferentiableEquations equations(problem, 1.0);
      long at_point[64] = {};
      int points = 0;
      NewtonOptions options;
      options.small = 1e-12;
      options.accepts = [&](const Vector&, const Vector&, const Vector&) {  // asked once at every point
        if (points < 64) at_point[points++] = calls;
        return false;
      };
      const NewtonEnd end = newton(equations, Vector::Zero(60 * d), Vector::Zero(problem.G.cols()), options);
      EXPECT_TRUE(end.converged) << "d = " << d << ", floating " << floating;
      ASSERT_GE(points, 4) << "too few iterations to say anything";
      // Point 0 is the start, point 1 the end of the first iteration.
      for (int k = 2; k < points; ++k)
        EXPECT_EQ(at_point[k] - at_point[k - 1], 0) << "d = " << d << ", floating " << floating << ", iteration " << k;
    }
}

TEST(Allocation, EvaluationTakesNoMemory) {
  for (int d : {2, 3})
    for (bool sparse : {false, true}) {
      Problem problem = problem_of(d, !sparse);
      if (sparse) problem.W = Delassus(Eigen::SparseMatrix<double>(problem.W.dense().sparseView()));
      const BDifferentiableEquations equations(problem, 1.0);
      const Eigen::Index m = problem.G.cols();
      const Vector p = Vector::Ones(60 * d), a = Vector::Ones(m), direction = Vector::Ones(60 * d + m);
      Residual at;
      Vector change;
      equations.evaluate(p, a, at);
      equations.motion_along(direction, change);
      const long before = calls;
      equations.evaluate(p, a, at);
      equations.motion_along(direction, change);
      equations.evaluate_at_motion(p, at);
      EXPECT_EQ(calls - before, 0) << "d = " << d << ", sparse " << sparse;
    }
}

}  // namespace
}  // namespace scabo::contact
