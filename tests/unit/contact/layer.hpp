// An elastic layer as a truss, held at its base, whose free surface lies under a rigid plane: a contact problem of any
// size with W = B' K^-1 B known by its products alone.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "scabo/contact/files/global_problem.hpp"

namespace scabo::test {

/// `pairs` nodes along the surface, `depth` rows of nodes above the base; unit spacing, bars of unit stiffness along
/// the lines of the grid, of a half across its cells. [normal, tangent] = [vertical, along].
inline contact::Delassus layer_flexibility(int pairs, int depth) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto node = [&](int i, int j) { return i * depth + j; };  // j = depth: the base
  const auto bar = [&](int i, int j, int k, int l, double stiffness) {
    if (k < 0 || k >= pairs) return;
    const Vec2 e = Vec2(j - l, k - i).normalized();  // [up, along]
    const Mat2 block = stiffness * e * e.transpose();
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const int from = 2 * node(i, j), to = 2 * node(k, l);
        entries.emplace_back(from + a, from + b, block(a, b));
        if (l == depth) continue;
        entries.emplace_back(to + a, to + b, block(a, b));
        entries.emplace_back(from + a, to + b, -block(a, b));
        entries.emplace_back(to + a, from + b, -block(a, b));
      }
  };
  for (int i = 0; i < pairs; ++i)
    for (int j = 0; j < depth; ++j) {
      bar(i, j, i + 1, j, 1.0);
      bar(i, j, i, j + 1, 1.0);
      bar(i, j, i + 1, j + 1, 0.5);
      bar(i, j, i - 1, j + 1, 0.5);
    }
  const Eigen::Index size = 2 * static_cast<Eigen::Index>(pairs) * depth;
  linalg::SparseMatrix K(size, size);
  K.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> B(size, 2 * pairs);
  for (int i = 0; i < pairs; ++i)
    for (int a = 0; a < 2; ++a) B.insert(2 * node(i, 0) + a, 2 * i + a) = 1.0;
  return contact::Delassus(std::make_shared<const contact::FactorisedPairs>(K, B, 2));
}

/// The layer pressed and sheared in waves, so that pairs open, stick and slip.
inline contact::Problem layer_problem(int pairs, int depth, double mu) {
  contact::Problem problem;
  problem.W = layer_flexibility(pairs, depth);
  problem.q.resize(2 * pairs);
  for (int i = 0; i < pairs; ++i) {
    const double s = static_cast<double>(i) / pairs;
    problem.q[2 * i] = std::cos(40.0 * s) - 0.2;
    problem.q[2 * i + 1] = 0.6 * std::sin(27.0 * s);
  }
  problem.mu = Vector::Constant(pairs, mu);
  problem.G.resize(2 * pairs, 0);
  return problem;
}

}  // namespace scabo::test
