// One internal level of a bounded super-element: what its inside moves besides following its boundary, to first order.
//
// The boundary moves the inside by u = xi^S u(1) and leaves forces of inertia inside unbalanced. Under those of the
// acceleration xi^S w, while the boundary is held, the inside deflects by phi(xi) w against them:
//
//     u(xi) = xi^S u(1) - phi(xi) w                                                                          (1)
//     xi phi,xi = S phi - xi^2 E0^-1 M xi^S,     phi(1) = 0                                                  (2)
//
// since the domain of size xi has the mass xi^2 (xi^S)' M xi^S (mass.hpp). The two fields are orthogonal in the
// stiffness, and with w as further unknowns
//
//     kinetic 1/2 [u' w'] [M, -Z; -Z, Q] [u; w] of their velocities,     elastic 1/2 (u'K u + w'Z w)         (3)
//     (S' + 2) Z + Z (S + 2) = M E0^-1 M,     (S' + 3) Q + Q (S + 3) = M E0^-1 Z + Z E0^-1 M                 (4)
//
// Z and Q are the terms of omega^4 and omega^6 of the dynamic stiffness K - omega^2 M - omega^4 Z - omega^6 Q - ...,
// which (3) has exactly. They are energies of displacements that the body can have: the mass of (3) is positive
// definite, and frequencies are upper bounds (Rayleigh). Z is the stiffness of w and its product with the mass of u.
#pragma once

#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

struct InternalLevel {
  Matrix Z, Q;  ///< n x n, symmetric
};

/// `M`: mass of the super-element. `coupled`: whether it has entries between symmetry blocks.
InternalLevel internal_level(const Matrix& M, const SuperElementSolution& solution, const ModalSolution& modal,
                             bool coupled, int threads = 1);

/// The modes of eq. (2), together with those of xi^2 xi^S that drive them. Refers to nothing.
InternalModes internal_modes(const Matrix& M, const SuperElementSolution& solution, const ModalSolution& modal,
                             bool coupled);

}  // namespace scabo::element
