// Nonsmooth Newton on the equations of Alart and Curnier (Comput. Methods Appl. Mech. Engrg. 92 (1991) 353),
// projections of an augmented force s = p - r u on the half line and on the disk whose radius the augmented
// normal force gives:
//
//     F_n = p_n - (s_n)+                 s_n = p_n - r_n g
//     F_t = p_t - P_D(b)(s_t)            s_t = p_t - r_t ds,  b = mu (s_n)+            dN equations
//     F_R = G'p + f                                                                    m equations
//
// (cohesion and tension as in road.hpp). One element of the generalised Jacobian, on the branches of the point;
// d(.) along a direction, e = s_t / |s_t|:
//
//     dF_n = r_n dg                                              s_n > 0
//     dF_n = dp_n                                                otherwise
//     dF_t = r_t d(ds)                                           |s_t| <= b
//     dF_t = dp_t - e db - b/|s_t| (1 - e e') d(s_t)             otherwise, db = mu (dp_n - r_n dg)
//
// A line search on |F|^2/2 lets it rise above the largest of the last five values only (Grippo, Lampariello,
// Lucidi, SIAM J. Numer. Anal. 23 (1986) 707). Where the Jacobian is singular (W without full rank: redundant
// pairs), W + alpha in its place.
//
// Good for: fast where the start is near and friction moderate; the peer of Newton on the B-differentiable
// equations, which differ by b = mu (p_n)+. No proof of convergence with friction: it can stall, and says so.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

/// With `bound` (N): the friction bounds are given (Tresca), mu and cohesion are not looked at.
End alart_curnier(const Problem& problem, Vector p, Vector a, const Control& control, const Vector* bound = nullptr);

}  // namespace scabo::contact::solvers
