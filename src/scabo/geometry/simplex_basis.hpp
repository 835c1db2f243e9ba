// Shape functions on triangles and tetrahedra, and the rule by which they are integrated.
//
// A point has barycentric coordinates lambda, d + 1 numbers that add up to 1. Nodes are the corners, then, of a
// quadratic one, the middles of the edges 12, 23, 31 and, of a tetrahedron, 14, 24, 34 (as Abaqus and CalculiX number
// them). Linear: N_i = lambda_i. Quadratic: N_i = lambda_i (2 lambda_i - 1) of a corner, 4 lambda_i lambda_j of the
// middle between two corners.
#pragma once

#include <array>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::geometry {

/// Points and weights on a simplex of d dimensions, exact for polynomials of degree 3; the weights add up to 1.
struct SimplexRule {
  Matrix points;  ///< (d + 1) x 2^d, barycentric
  Vector weights;
};

class SimplexBasis {
 public:
  /// dimension 2 with 3 or 6 nodes, 3 with 4 or 10.
  static const SimplexBasis& of(int dimension, int nodes);

  int dimension() const { return dimension_; }
  int nodes() const { return nodes_; }
  /// The two corners between which each middle node is, in the order of these nodes.
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }
  /// N, one for each node.
  Vector values(const Vector& lambda) const;
  /// N,xi_k with xi_k = lambda_(k + 1), k = 1 ... d; nodes x d.
  Matrix derivatives(const Vector& lambda) const;
  const SimplexRule& rule() const { return rule_; }

 private:
  SimplexBasis(int dimension, int nodes);

  int dimension_, nodes_;
  std::vector<std::array<int, 2>> edges_;
  SimplexRule rule_;
};

}  // namespace scabo::geometry
