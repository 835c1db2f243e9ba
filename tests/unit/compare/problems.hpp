// Discrete contact problems in the plane and in space for all solvers.
#pragma once

#include <cmath>

#include "compare/solvers.hpp"
#include "support/random.hpp"

namespace scabo::test {

using compare::Method;
using contact::Problem;
using contact::Solution;
using contact::Status;

/// Positive definite, decaying along the interface, normal and tangents coupled: little friction gives one
/// solution.
inline Problem elastic_problem(std::mt19937& random, int dimension, int pairs, double mu) {
  const int d = dimension;
  Matrix S(d * pairs, d * pairs);
  for (int i = 0; i < pairs; ++i)
    for (int j = 0; j < pairs; ++j) {
      Matrix block = Matrix::Identity(d, d);
      for (int k = 0; k < d * d; ++k) block(k / d, k % d) += 0.3 * uniform(random, -1.0, 1.0);
      S.block(d * i, d * j, d, d) = std::exp(-std::abs(i - j) / 1.5) * block;
    }
  Problem problem;
  problem.dimension = d;
  Matrix W = S * S.transpose();
  W.diagonal().array() += 0.1 * W.diagonal().mean();
  problem.W = W;
  problem.q = Vector::NullaryExpr(d * pairs, [&] { return uniform(random, -1.0, 1.0); });
  problem.mu = Vector::Constant(pairs, mu);
  problem.G.resize(d * pairs, 0);
  problem.f.resize(0);
  return problem;
}

/// One pair; q as given.
inline Problem one_pair(const Matrix& W, const Vector& q, double mu) {
  Problem problem;
  problem.dimension = static_cast<int>(q.size());
  problem.W = W;
  problem.q = q;
  problem.mu = Vector::Constant(1, mu);
  problem.G.resize(q.size(), 0);
  problem.f.resize(0);
  return problem;
}

/// Methods of this build that take frictional problems of this dimension.
inline std::vector<Method> frictional_methods(int dimension) {
  std::vector<Method> methods;
  for (const std::string& name : compare::method_names()) {
    const Method method = *compare::method_named(name);
    if (method == Method::quadratic_programme) continue;
    if (dimension == 3 && (method == Method::lemke || method == Method::siconos_lemke)) continue;
    if (dimension == 2 && (method == Method::siconos_nsn_ac || method == Method::siconos_nsn_fb)) continue;
    methods.push_back(method);
  }
  return methods;
}

}  // namespace scabo::test
