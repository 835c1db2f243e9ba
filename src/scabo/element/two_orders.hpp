// Error of a super-element's displacement by two orders: the solution u on edges of order p against U on the same edges
// with order p + 1 (or some left at p), in the energy norm |u|^2 = u'K u.
//
// Both are semi-discrete: functions N(eta) u(xi) in the whole body, the narrower space part of the wider. With P the
// prolongation of boundary displacements, k and K the two stiffnesses and e = U - P u,
//
//     |U - u|^2 = e'K e + u'(k - P'K P) u                                                                    (1)
//
// exactly: U - u is the field of boundary values e, and, orthogonal to it, what the wider space relaxes inside with the
// boundary held at P u. The second term cancels to about 1e-15 u'k u, and needs a body without loads inside; `relaxed`
// = false leaves it out.
//
// The estimate is that of the saturation assumption: |U - u| for the distance of u from the exact solution. It falls
// short by sqrt(1 - r^2), r the ratio of the errors of p + 1 and p.
//
// Where the error is: the field U(xi) - P u(xi) has an energy in the sector that every boundary element spans, the
// integral over xi (1 / xi in an unbounded domain) by quadrature with points that crowd towards xi = 1, where short
// elements have their say. On a built-in edge the boundary itself knows nothing of the error behind it.
#pragma once

#include <vector>

#include "scabo/element/interior_field.hpp"

namespace scabo::element {

/// P u: boundary displacements on elements of equal or higher order, element by element.
Vector prolonged(const std::vector<mesh::LineElement>& from, const Vector& u, const std::vector<mesh::LineElement>& to,
                 Eigen::Index size);

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
/// |U - u|^2 of eq. (1), force times length.
double squared_difference(const TwoOrders& two);

/// A super-element with one of its displacements.
struct SuperElementField {
  const Ring& ring;
  const SuperElementSolution& solution;
  const ModalSolution& modal;
  const Vector& u;
};
/// Energy of the difference in the sector of every boundary element, up to a common factor and the error of the
/// quadrature.
std::vector<double> sector_differences(const SuperElementField& narrower, const SuperElementField& wider,
                                       const Elasticity& D);

}  // namespace scabo::element
