// Nonlinear complementarity on cones by a smoothing Newton method. De Saxce's change of variable makes
// Coulomb's law with the slip normal to the disk a complementarity of the cone and its dual,
//
//     p in K_mu   perpendicular to   [g + mu |ds|, ds] in its dual cone
//
// (De Saxce, Feng, Math. Comput. Modelling 28 (1998) 225), and a scaling turns both into the self-dual cone
// x_0 >= |x_t| (2D: a quadrant, turned):
//
//     x = [mu p_n, p_t],   y = r [g + mu |ds|, mu ds],     x . y = mu r p . [g + mu |ds|, ds] = 0
//
// The Fischer-Burmeister function of that cone, with the product x o y = [x . y, x_0 y_t + y_0 x_t] and e =
// [1, 0], is zero there and nowhere else (Fukushima, Luo, Tseng, SIAM J. Optim. 12 (2002) 436):
//
//     phi_eps(x, y) = x + y - (x o x + y o y + 2 eps^2 e)^(1/2)
//     d phi = dx + dy - L_z^-1 (L_x dx + L_y dy),   z the root,  L_x the matrix of x o .
//
// smooth for eps > 0; |ds| becomes (|ds|^2 + eps^2 / r^2)^(1/2) - eps / r. Newton with line search on
// |phi_eps|^2/2; eps goes down with the residual (Qi, Sun, Zhou, Math. Program. 87 (2000) 1). Without
// friction: the scalar function of p_n and r g, and p_t = 0.
//
// Good for: robust from any start where |phi| has no local minimum, as each eps smooths all kinks; slower
// than Newton on the kinks themselves, and accurate only to about eps where a pair has neither force nor
// motion to spare. Coulomb's law only: no cohesion, no tension.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

End fischer_burmeister(const Problem& problem, Vector p, Vector a, const Control& control);

}  // namespace scabo::contact::solvers
