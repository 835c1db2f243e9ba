// Error of the displacement of a super-element from two orders: the solution u on edges of order p is compared with U
// on the same edges with order p + 1 (some may remain at p), in the energy norm |u|^2 = u'K u.
//
// Both are semi-discrete: functions N(eta) u(xi) in the whole body, and the smaller space is contained in the larger
// one. With P the prolongation of boundary displacements, k and K the two stiffnesses and e = U - P u,
//
//     |U - u|^2 = e'K e + u'(k - P'K P) u                                                                    (1)
//
// exactly: U - u is the field with boundary values e and, orthogonal to it, the relaxation of the interior in the
// larger space with the boundary held at P u. The second term cancels to about 1e-15 u'k u and requires a body without
// loads inside; `relaxed` = false omits it.
//
// The estimate relies on the saturation assumption: |U - u| is taken as the distance of u from the exact solution. It
// is too small by the factor sqrt(1 - r^2), where r is the ratio of the errors of p + 1 and p.
//
// Location of the error: the field U(xi) - P u(xi) has an energy in the sector spanned by every boundary element. The
// integral over xi (1 / xi in an unbounded domain) is computed by quadrature with points concentrated towards xi = 1,
// where short elements matter. On a built-in edge the boundary displacement itself does not show the error behind it.
#pragma once

#include <vector>

#include "scabo/element/plane/interior_field.hpp"

namespace scabo::element {

/// P u: boundary displacements transferred to elements of equal or higher order, element by element.
Vector prolonged(const std::vector<mesh::LineElement>& from, const Vector& u, const std::vector<mesh::LineElement>& to,
                 Eigen::Index size);

/// A displacement on the elements of lower order and its counterpart on those of higher order.
struct TwoOrders {
  const std::vector<mesh::LineElement>& elements;  ///< those of lower order
  const Matrix& k;
  const Vector& u;
  const std::vector<mesh::LineElement>& wider_elements;
  const Matrix& K;
  const Vector& U;
  bool relaxed = true;  ///< include the second term of eq. (1)
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
/// Energy of the difference in the sector of every boundary element, up to a common factor and the quadrature error.
std::vector<double> sector_differences(const SuperElementField& narrower, const SuperElementField& wider,
                                       const Elasticity& D);

}  // namespace scabo::element
