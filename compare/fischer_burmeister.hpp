// Nonlinear complementarity on cones by a smoothing Newton method. De Saxce's change of variable turns Coulomb's law,
// whose slip is normal to the disc, into a complementarity between the cone and its dual,
//
//     p in K_mu   perpendicular to   [g + mu |ds|, ds] in its dual cone
//
// (De Saxce, Feng, Math. Comput. Modelling 28 (1998) 225), and a scaling turns both cones into the self-dual cone x_0
// >= |x_t| (in 2D a rotated quadrant):
//
//     x = [mu p_n, p_t],   y = r [g + mu |ds|, mu ds],     x . y = mu r p . [g + mu |ds|, ds] = 0
//
// The Fischer-Burmeister function of that cone, with the product x o y = [x . y, x_0 y_t + y_0 x_t] and e = [1, 0],
// vanishes exactly at the solutions (Fukushima, Luo, Tseng, SIAM J. Optim. 12 (2002) 436):
//
//     phi_eps(x, y) = x + y - (x o x + y o y + 2 eps^2 e)^(1/2)
//     d phi = dx + dy - L_z^-1 (L_x dx + L_y dy),   z the root,  L_x the matrix of x o .
//
// It is smooth for eps > 0; |ds| is replaced by (|ds|^2 + eps^2 / r^2)^(1/2) - eps / r. Newton's method with line
// search on |phi_eps|^2/2; eps decreases with the residual (Qi, Sun, Zhou, Math. Program. 87 (2000) 1). Without
// friction: the scalar function of p_n and r g, and p_t = 0.
//
// Properties: robust from any start if |phi| has no local minimum, because eps smooths all kinks; slower than Newton on
// the nonsmooth equations, and accurate only to about eps for a pair that is close to both zero force and zero motion.
// Coulomb's law only: no cohesion, no tension.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

End fischer_burmeister(const Problem& problem, Vector p, Vector a, const Control& control);

}  // namespace scabo::compare
