// Mass matrix of a bounded super-element, consistent with its stiffness.
//
// The boundary displacements u(1) determine the interior by the static solution u(xi) = xi^S u(1). The kinetic energy
// for velocities of the boundary is therefore 1/2 u(1)' M u(1) with
//
//     M = int_0^1 xi (xi^S)' M0 xi^S dxi,     M0: mass of the boundary (facet/mass.hpp)                         (1)
//
// and, since d/dxi of xi^2 (xi^S)' M0 xi^S is xi (xi^S)' (S' M0 + M0 S + 2 M0) xi^S,
//
//     (S' + I) M + M (S + I) = M0                                                                            (2)
//
// The integration over xi is exact. (2) is solved in the real Schur form of S, so that equal and defective exponents
// cause no difficulty; its eigenvalues are 2 + lambda_i + lambda_j, which are never zero. In symmetry blocks k, l the
// translations are separate (super_element.hpp: u = E v + R a, xi v,xi = S v, xi a,xi = A v), and with z = [v; a] and
// M0 in these coordinates (2) decouples into, in this order,
//
//     2 X_aa = M0_aa                                                                                         (3)
//     (S_k' + 2) X_va = M0_va - A_k' X_aa,     X_av (S_l + 2) = M0_av - X_aa A_l                             (4)
//     (S_k' + I) X_vv + X_vv (S_l + I) = M0_vv - A_k' X_av - X_va A_l                                        (5)
//
// (3) is half of R'M0R: for translations M gives the mass of the body, to rounding.
//
// Restricted to exponents with Re lambda > 0 besides the translations: bounded super-elements, closed or open.
#pragma once

#include <vector>

#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

/// M, n x n, mass: symmetric, positive definite where M0 is positive. `coupled`: whether M0 has entries between
/// symmetry blocks; otherwise only k = l is solved.
Matrix mass_matrix(const Eigen::SparseMatrix<double>& M0, const SuperElementSolution& solution,
                   const ModalSolution& modal, bool coupled, int threads = 1);

}  // namespace scabo::element
