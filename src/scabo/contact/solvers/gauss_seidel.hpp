// Nonsmooth Gauss-Seidel in the plane and in space (Jourdan, Alart, Jean, Comput. Methods Appl. Mech. Engrg.
// 155 (1998) 31): pair by pair, the exact solution of Coulomb's law for its own part of W, the other forces
// held.
//
// One pair with u = b + W_ii p:
//
//     b_n >= 0:                          p = 0
//     p = -W_ii^-1 b in the cone:        stick
//     slip, p_t = mu p_n e:              p_n = -b_n / (W_nn + mu W_nt e),  e x u_t(e) = 0,  e . u_t <= 0
//
// In the plane e = +-1. In space e = (cos, sin) of an angle: times the denominator, e x u_t is a
// trigonometric polynomial of degree two, with at most four zeros. They are bracketed on 32 points and found
// by bisection and secant; near the last sweep's angle first. Where no zero fits (large mu, W_ii not
// positive), one projection p <- P_K(p - r (u + mu |u_t| n)).
//
// Sparse W is swept by its columns: the cheapest sweeps of all roads, and the only one that needs no
// factorisation. Good for: very many pairs, W without full rank, rough accuracy. Convergence is linear at
// best, and not certain.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

/// Exact forces of one pair; `last` tells where to look first.
Local one_pair(const LocalMatrix& W, const Local& free, double mu, const Local& last);

/// At most 400 sweeps for each of control.iterations. Coulomb's law only; no rigid motions.
End gauss_seidel(const Problem& problem, Vector p, const Control& control);

}  // namespace scabo::contact::solvers
