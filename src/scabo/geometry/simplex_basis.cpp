#include "scabo/geometry/simplex_basis.hpp"

#include <cmath>

#include "scabo/base/error.hpp"

namespace scabo::geometry {

namespace {

/// Points with all coordinates but one equal to `equal`, that one being each in turn, so that no order of corners
/// counts.
void add_orbit(SimplexRule& rule, double equal, double weight) {
  const Eigen::Index corners = rule.points.rows(), before = rule.points.cols();
  rule.points.conservativeResize(Eigen::NoChange, before + corners);
  rule.weights.conservativeResize(before + corners);
  rule.points.rightCols(corners).setConstant(equal);
  for (Eigen::Index i = 0; i < corners; ++i)
    rule.points(i, before + i) = 1.0 - static_cast<double>(corners - 1) * equal;
  rule.weights.tail(corners).setConstant(weight);
}

/// Symmetric rules with closed forms and weights above 0: of triangles exact up to degree 4, of tetrahedra up to 3
/// (Felippa, A compendium of FEM integration formulas for symbolic work, Engineering Computations 21, 2004, rules 6 and
/// 8).
SimplexRule symmetric_rule(int dimension) {
  SimplexRule rule{Matrix(dimension + 1, 0), Vector(0)};
  if (dimension == 2) {
    const double mean = (8.0 - std::sqrt(10.0)) / 18.0, half = std::sqrt(38.0 - 44.0 * std::sqrt(0.4)) / 18.0;
    const double part = std::sqrt(213125.0 - 53320.0 * std::sqrt(10.0)) / 3720.0;
    add_orbit(rule, mean + half, 1.0 / 6.0 + part);
    add_orbit(rule, mean - half, 1.0 / 6.0 - part);
  } else {
    const double root = std::sqrt(17.0), mean = (55.0 - 3.0 * root) / 196.0,
                 half = std::sqrt(1022.0 - 134.0 * root) / 196.0;
    const double part = std::sqrt((1715161837.0 - 406006699.0 * root) / 23101.0) / 3120.0;
    add_orbit(rule, mean + half, 0.125 + part);
    add_orbit(rule, mean - half, 0.125 - part);
  }
  return rule;
}

}  // namespace

SimplexBasis::SimplexBasis(int dimension, int nodes)
    : dimension_(dimension), nodes_(nodes), rule_(symmetric_rule(dimension)) {
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
