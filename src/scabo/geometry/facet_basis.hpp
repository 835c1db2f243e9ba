// Shape functions on the facets of cells in space, triangles and quadrilaterals, and the rules by which they are
// integrated.
//
// A place on a triangle is (lambda_2, lambda_3) of its barycentric coordinates, and its nodes are those of
// SimplexBasis. A place on a quadrilateral is (eta, zeta), both from -1 to 1. Its nodes are the corners (-1, -1),
// (1, -1), (1, 1), (-1, 1), then with eight of them the middles of the edges 12, 23, 34, 41. With 4:
// N_i = (1 + eta_i eta)(1 + zeta_i zeta)/4. With 8, the middle of an edge along eta has (1 - eta^2)(1 + zeta_i zeta)/2,
// and a corner its function with 4 less half of those of both middles beside it.
#pragma once

#include <array>

#include "scabo/geometry/simplex_basis.hpp"

namespace scabo::geometry {

/// Places and weights; the weights add up to the area of the facet in its coordinates, 1/2 or 4.
struct FacetRule {
  Matrix places;  ///< 2 x m
  Vector weights;
};

class FacetBasis {
 public:
  /// Triangles with 3 or 6 nodes, quadrilaterals with 4 or 8.
  static const FacetBasis& of(int nodes);

  int nodes() const { return nodes_; }
  int corners() const { return corners_; }
  /// Of the nodes, 2 x nodes.
  const Matrix& places() const { return places_; }
  /// The place in the middle.
  Vec2 middle() const { return corners_ == 3 ? Vec2(1.0 / 3.0, 1.0 / 3.0) : Vec2(0.0, 0.0); }
  /// How far a place lies inside of the edges, as a part of the size; negative: outside.
  double inside(const Vec2& at) const;
  Vector values(const Vec2& at) const;       ///< N, one for each node
  Matrix derivatives(const Vec2& at) const;  ///< N by both coordinates, nodes x 2
  /// Exact for degree 3 on triangles, and 7 in each coordinate on quadrilaterals.
  const FacetRule& rule() const { return rule_; }
  /// Exact for degree 6 in both coordinates.
  const FacetRule& finer_rule() const { return finer_; }
  /// For functions that are no polynomials: of 64 places.
  const FacetRule& finest_rule() const { return finest_; }

 private:
  explicit FacetBasis(int nodes);

  int nodes_, corners_;
  Matrix places_;
  FacetRule rule_, finer_, finest_;
};

/// Of a triangle with `count` x `count` places, exact for degree 2 count - 2: Gauss-Legendre on a square that is
/// collapsed into it (Stroud, Approximate Calculation of Multiple Integrals, 1971, 2.5).
FacetRule triangle_rule(int count);

}  // namespace scabo::geometry
