// Error of a super-element's displacement by two orders: the solution u on edges of order p against U on the same edges with
// order p + 1 (or some left at p), in the energy norm |u|^2 = u'K u.
//
// Both are semi-discrete: functions N(eta) u(xi) in the whole body, the narrower space part of the wider. With P the
// prolongation of boundary displacements, k and K the two stiffnesses and e = U - P u,
//
//     |U - u|^2 = e'K e + u'(k - P'K P) u                                                                    (1)
//
// exactly: U - u is the field of boundary values e, and, orthogonal to it, what the wider space relaxes inside with the boundary
// held at P u. The second term cancels to about 1e-15 u'k u, and needs a body without loads inside; `relaxed` = false leaves it out.
//
// The estimate is that of the saturation assumption: |U - u| for the distance of u from the exact solution. It falls short by
// sqrt(1 - r^2), r the ratio of the errors of p + 1 and p.
//
// Shares of the elements: U - P u has degree p + 1 in an element, with the leading part b phi, phi = P_(p+1) - P_(p-1) scaled to
// a leading coefficient of 1. Without contact K e vanishes on everything of order p (Galerkin), so that e'K e is the sum of
// b.r, r = phi'(K e) over the nodes of the element.
#pragma once

#include <vector>

#include "scabo/element/stiffness.hpp"

namespace scabo::element {

/// P u: boundary displacements on elements of equal or higher order, element by element.
Vector prolonged(const std::vector<mesh::LineElement>& from, const Vector& u, const std::vector<mesh::LineElement>& to,
                 Eigen::Index size);

struct OrderDifference {
  double squared = 0.0;          ///< eq. (1), force times length
  std::vector<double> elements;  ///< squared, of every boundary element; they sum to `squared`
};

/// One displacement on the narrower elements and its counterpart on the wider.
struct TwoOrders {
  const std::vector<mesh::LineElement>& elements;  ///< of the narrower
  const Matrix& k;
  const Vector& u;
  const std::vector<mesh::LineElement>& wider_elements;
  const Matrix& K;
  const Vector& U;
  bool relaxed = true;  ///< with the second term of eq. (1)
};
OrderDifference order_difference(const TwoOrders& two);

}  // namespace scabo::element
