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
// The integration over xi is exact. (2) is solved as in lyapunov.hpp with k = 1; its eigenvalues are 2 + lambda_i +
// lambda_j, which are never zero. Of translations it is half of R'M0R: M gives the mass of the body, to rounding.
//
// Restricted to exponents with Re lambda > 0 besides the translations: bounded super-elements, closed or open.
#pragma once

#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

/// M, n x n, mass: symmetric, positive definite where M0 is positive. `coupled`: whether M0 has entries between
/// symmetry blocks; otherwise only k = l is solved.
Matrix mass_matrix(const Eigen::SparseMatrix<double>& M0, const SuperElementSolution& solution,
                   const ModalSolution& modal, bool coupled, int threads = 1);

}  // namespace scabo::element
