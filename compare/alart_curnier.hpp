// Nonsmooth Newton method on the equations of Alart and Curnier (Comput. Methods Appl. Mech. Engrg. 92 (1991) 353):
// projections of an augmented force s = p - r u onto the half line and onto the disc whose radius follows from the
// augmented normal force:
//
//     F_n = p_n - (s_n)+                 s_n = p_n - r_n g
//     F_t = p_t - P_D(b)(s_t)            s_t = p_t - r_t ds,  b = mu (s_n)+            dN equations
//     F_R = G'p + f                                                                    m equations
//
// (cohesion and tension as in common.hpp). One element of the generalised Jacobian, on the branches at the point; d(.)
// along a direction, e = s_t / |s_t|:
//
//     dF_n = r_n dg                                              s_n > 0
//     dF_n = dp_n                                                otherwise
//     dF_t = r_t d(ds)                                           |s_t| <= b
//     dF_t = dp_t - e db - b/|s_t| (1 - e e') d(s_t)             otherwise, db = mu (dp_n - r_n dg)
//
// A nonmonotone line search on |F|^2/2 accepts values up to the largest of the last five (Grippo, Lampariello, Lucidi,
// SIAM J. Numer. Anal. 23 (1986) 707). If the Jacobian is singular (rank-deficient W: redundant pairs), W + alpha
// replaces W.
//
// Properties: fast from a close start and with moderate friction, comparable to Newton on the B-differentiable
// equations, which differ by b = mu (p_n)+. There is no proof of convergence with friction: the method can stall, and
// reports it.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

/// `bound` (N): prescribed friction bounds (Tresca); mu and cohesion are then not used.
End alart_curnier(const Problem& problem, Vector p, Vector a, const Control& control, const Vector* bound = nullptr);

}  // namespace scabo::compare
