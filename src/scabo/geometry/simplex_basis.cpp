#include "scabo/geometry/simplex_basis.hpp"

#include <cmath>

#include "scabo/base/error.hpp"

namespace scabo::geometry {

namespace {

/// Two points y and weights for the integral of y^k f(y) over 0 <= y <= 1, divided by that of y^k: Gauss-Jacobi.
struct TwoPoints {
  double y[2], weight[2];
};
TwoPoints two_points(int k) {
  // Zeros of y^2 - 2 b y + c, the polynomial of degree 2 that is orthogonal to 1 and y (Jacobi).
  const double n = k, b = (n + 2.0) / (n + 4.0), c = (n + 1.0) * (n + 2.0) / ((n + 3.0) * (n + 4.0));
  const double root = std::sqrt(b * b - c), mean = (n + 1.0) / (n + 2.0);
  TwoPoints rule{{b - root, b + root}, {}};
  rule.weight[0] = (rule.y[1] - mean) / (2.0 * root);
  rule.weight[1] = 1.0 - rule.weight[0];
  return rule;
}

/// Conical product (Stroud, Approximate Calculation of Multiple Integrals, 1971, 2.5): lambda_(k + 1) is a part 1 - y
/// of what the coordinates before it have left.
SimplexRule conical_rule(int dimension) {
  const Eigen::Index count = Eigen::Index{1} << dimension;
  SimplexRule rule{Matrix(dimension + 1, count), Vector::Ones(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    double left = 1.0;
    for (int k = 0; k < dimension; ++k) {
      const TwoPoints along = two_points(dimension - 1 - k);
      const Eigen::Index which = (i >> k) & 1;
      rule.points(k + 1, i) = left * (1.0 - along.y[which]);
      left *= along.y[which];
      rule.weights[i] *= along.weight[which];
    }
    rule.points(0, i) = left;
  }
  return rule;
}

}  // namespace

SimplexBasis::SimplexBasis(int dimension, int nodes)
    : dimension_(dimension), nodes_(nodes), rule_(conical_rule(dimension)) {
  if (nodes == dimension + 1) return;
  edges_ = {{0, 1}, {1, 2}, {2, 0}};
  if (dimension == 3) edges_.insert(edges_.end(), {{0, 3}, {1, 3}, {2, 3}});
}

const SimplexBasis& SimplexBasis::of(int dimension, int nodes) {
  static const SimplexBasis triangle3(2, 3), triangle6(2, 6), tetrahedron4(3, 4), tetrahedron10(3, 10);
  for (const SimplexBasis* basis : {&triangle3, &triangle6, &tetrahedron4, &tetrahedron10})
    if (basis->dimension() == dimension && basis->nodes() == nodes) return *basis;
  throw BrokenInvariant("no simplex has that many nodes");
}

Vector SimplexBasis::values(const Vector& lambda) const {
  if (edges_.empty()) return lambda;
  Vector N(nodes_);
  for (int i = 0; i <= dimension_; ++i) N[i] = lambda[i] * (2.0 * lambda[i] - 1.0);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    N[dimension_ + 1 + static_cast<int>(e)] = 4.0 * lambda[edges_[e][0]] * lambda[edges_[e][1]];
  return N;
}

Matrix SimplexBasis::derivatives(const Vector& lambda) const {
  Matrix by_lambda = Matrix::Zero(nodes_, dimension_ + 1);  // as if all of them were independent
  for (int i = 0; i <= dimension_; ++i) by_lambda(i, i) = edges_.empty() ? 1.0 : 4.0 * lambda[i] - 1.0;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [i, j] = edges_[e];
    by_lambda(dimension_ + 1 + static_cast<int>(e), i) = 4.0 * lambda[j];
    by_lambda(dimension_ + 1 + static_cast<int>(e), j) = 4.0 * lambda[i];
  }
  return by_lambda.rightCols(dimension_).colwise() - by_lambda.col(0);
}

}  // namespace scabo::geometry
