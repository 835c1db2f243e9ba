// Static stiffness of a bounded super-element by ring doubling.
//
// Rings are doubled (ring_doubling.hpp, eqs. 1 and 2) after the translations have been removed.
//
// The translations R (E1' R = 0, E2 R = 0) carry no force, R'q = 0, and are removed first. With M = R'E0R, G = M^-1
// R'E0, H = M^-1 R'E1' and u = R a + v, where v = 0 in as many rows J as there are translations,
//
//     xi a,xi = -(G xi v,xi + H v)                                                                          (3)
//     E0 -> P'E0P,  E1 -> E1P,  E2 -> E2 - H'MH,   P = 1 - RG, without rows and columns J                   (4)
//
// They are restored exactly: the rows J of K follow from K R = 0.
//
// Unbounded domain (outside the ring, xi >= 1): -K11 replaces K22, and S has the exponents with negative real part.
// Loads on it need not be in equilibrium: their resultant, R'q = F for every xi, adds
//
//     v = v_h + V F,  V = -E2^-1 H',   xi a,xi = A v_h + C F,  C = M^-1 - H V                               (5)
//
// so that a grows with ln xi and the displacement is defined only up to a translation proportional to F. The stiffness
// computed here is that of a domain whose mean displacement over a circle around the scaling centre vanishes (for F =
// 0: at infinity, for any circle). Its radius is far times the largest distance of the ring from the centre. A bar is
// the mean over the angle, r the distance of the ring over the largest one:
//
//     a = A S^-1 v_h - (C (ln(far) - bar(ln r)) + N) F,
//     sym N = sym bar(V),  skew N = -skew V'(E1'V + G_I')                                                  (6)
//
// V depends on the rows J, as a does; with bar(V), (6) does not. The skew part of N is the one for which Betti's
// theorem holds, so that K is symmetric; where a line of symmetry makes the mean fulfil it, it is that of bar(V).
#pragma once

#include "scabo/element/facet/coefficient_matrices.hpp"
#include "scabo/element/sbfem/super_element.hpp"

namespace scabo::element {

/// Solves the super-element. Throws IllPosed if the boundary is not entirely visible from the centre, an elasticity is
/// not positive definite, or too much precision is lost: a ring is not positive definite to working precision, the
/// Riccati residual remains above 1e-9, K resists rotation, or K is not positive definite apart from rigid motions.
/// Symmetry blocks are distributed over `threads` threads.
SuperElementSolution solve_super_element(const Ring& ring, const Elasticity& D, double thickness, int threads = 1,
                                         const Domain& domain = {});

/// Imposes K r = 0 for the rotation r, which is known exactly and which short elements beside long ones violate,
///
///     K <- (1 - w r') K (1 - r w'),  w = D r / (r'D r),  D = diag K,  t'D r = 0 for the translations t          (7)
///
/// so that every row is changed in proportion to its own size (with D = 1 the residual of stiff sectors would be moved
/// to a soft one: 1e-8 of its stiffness where moduli differ by 1e6) and K t = 0 is preserved. `K`: of a bounded
/// super-element (n x n); its lower triangle is read, both are written. Throws IllPosed if K violates K r = 0 by 1e-8:
/// accuracy has been lost.
void take_rotation_out(const Ring& ring, Matrix& K);

}  // namespace scabo::element
