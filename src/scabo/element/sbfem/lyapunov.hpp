// The equations of Sylvester by which integrals over xi are known without quadrature:
//
//     (S' + k) X + X (S + k) = C,     X = int_0^1 xi^(2k - 1) (xi^S)' C xi^S dxi                              (1)
//
// In symmetry blocks the translations are separate (super_element.hpp: u = E v + R a, xi v,xi = S v, xi a,xi = A v),
// and with z = [v; a] and C in these coordinates (1) decouples into, in this order,
//
//     2k X_aa = C_aa                                                                                         (2)
//     (S_i' + 2k) X_va = C_va - A_i' X_aa,     X_av (S_j + 2k) = C_av - X_aa A_j                             (3)
//     (S_i' + k) X_vv + X_vv (S_j + k) = C_vv - A_i' X_av - X_va A_j                                         (4)
//
// Solved in the real Schur form of S, so that equal and defective exponents cause no difficulty.
#pragma once

#include <functional>

#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

/// X, n x n, for a symmetric C between blocks, `C(i, j)` = T_i' C T_j. `coupled`: whether C has entries between
/// symmetry blocks; otherwise only i = j is solved.
Matrix solve_lyapunov(const SuperElementSolution& solution, const ModalSolution& modal, double k, bool coupled,
                      int threads, const std::function<Matrix(const Block&, const Block&)>& C);

}  // namespace scabo::element
