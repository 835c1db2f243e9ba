// Interior points for Coulomb's law: all forces at once, from the inside of the friction cones. Stacks of bodies, rigid
// or elastic, need that: sweeps carry forces from body to body, Newton needs nearly all states right, and this asks for
// neither.
//
// Variables. S_i = D_i diag(mu_i, 1[, 1]), D_i^2 the mean of the pair's own W_ii; with W' = S^-1 W S^-1, q' = S^-1 q,
//
//     x = S p = D (mu p_n, p_t)                                      forces; D_i >= 1e-3 of the root mean square of all
//     u' = W' x + q' + G' a = S^-1 u,   y = (u'_n + |u'_t|, u'_t)    motions, signs of problem.hpp; G' = S^-1 G
//     G'^T x + f = 0                                                 balance of the rigid motions, if there are any
//
// The law is that x and y lie in the cone K = {x_n >= |x_t|}, its own dual, with x o y = 0, where x o y = (x . y, x_n
// y_t + y_n x_t): y in K is u_n >= 0, and x . y = p_n u_n + mu p_n |u_t| + p_t . u_t (De Saxce and Feng, Math. Comput.
// Modelling 28 (1998) 225).
//
// Step. One F scales both to the same point, F x = F^-1 y = l (Nesterov and Todd, SIAM J. Optim. 8 (1998) 324). In the
// plane K is the angle between two rays, in coordinates along them F is diagonal, sqrt(y / x), and x o y is taken by
// components; in space F = Q diag(phi) Q' with phi and Q known. With the distance b = u' + |u'_t| n - y, that y is from
// the motions, the balance g = G'^T x + f, and t = u'_t / |u'_t|
//
//     dy = T (W' dx + G' da) + b,   T = [1 t'; 0 I]                  b and g vanish with whole steps
//     l o (F dx + F^-1 dy) = sigma m e - l o l - correction =: l o c     m = x . y / N, e = (1, 0[, 0])
//     (phi^2 + Q'T W'Q) z + Q'T G' da = phi Q'c - Q'b,   G'^T Q z = -g,   dx = Q z
//
// T W' is not symmetric, so the matrix is factorised by LU; it is regular also if W is rank deficient. Components with
// large phi (open, or slipping) stand alone in their rows, and the others keep the size of W: multiplied by F^-1 from
// both sides, as is usual, the same matrix loses four to six digits more near the solution. A predictor with sigma = 0
// comes first, then sigma = (m reached / m)^3 and the second-order correction (F^-1 dy) o (F dx) of that step
// (Mehrotra, SIAM J. Optim. 2 (1992) 575). Acary, Armand, Nguyen, Shpakovych (Optim. Methods Softw. 38 (2023) 1071)
// solve the problem with |u_t| held, as held_slips.hpp does; here its derivative stands in T. The problem is not
// convex: where the steps collapse the best point met is returned. The last point is moved to the boundary of the
// cones, P_K(x - y), if that is a solution as well.
#pragma once

#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct InteriorPointEnd {
  Vector p;  ///< where the judge is content; otherwise of the least residual; empty where no point is finite
  Vector a;  ///< of the same point
  bool content = false;
  bool jammed = false;      ///< ended after a short step, as was asked for
  Vector early_p, early_a;  ///< where jammed: the point after the first two steps, which may be short
  int iterations = 0;
  double residual = 0.0;         ///< least natural map met, of forces in the units of W p, over |q|
  std::vector<Iteration> trace;  ///< its residual, its step length; merit is m / 2
};

/// W sparse, or dense with at most so many rows, and loads: what interior points of either kind need.
bool may_factorise_with_pairs(const Problem& problem, Eigen::Index most_dense);

/// The same with 1,000 rows, and Coulomb's law alone with mu > 0.
bool may_take_interior_points(const Problem& problem);

/// `content`, which may be empty, judges forces and motions after each step. All pairs start with the same normal
/// force, `start_factor` times what the loads suggest.
InteriorPointEnd interior_points(const Problem& problem, const IsSolution& content, const Deadline& deadline = {},
                                 double start_factor = 1.0);

}  // namespace scabo::contact
