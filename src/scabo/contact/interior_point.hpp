// Interior points for Coulomb's law: all forces at once, from the inside of the friction cones. Stacks of rigid bodies
// need that: sweeps carry forces from body to body, Newton needs nearly all states right, and this asks for neither.
//
// Variables. S_i = D_i diag(mu_i, 1[, 1]), D_i^2 the mean of the pair's own W_ii; with W' = S^-1 W S^-1, q' = S^-1 q,
//
//     x = S p = D (mu p_n, p_t)                                      forces
//     u' = W' x + q' = S^-1 u,   y = (u'_n + |u'_t|, u'_t)           motions, signs of problem.hpp
//
// The law is that x and y lie in the cone K = {x_n >= |x_t|}, its own dual, with x o y = 0, where x o y = (x . y, x_n
// y_t + y_n x_t): y in K is u_n >= 0, and x . y = p_n u_n + mu p_n |u_t| + p_t . u_t (De Saxce and Feng, Math. Comput.
// Modelling 28 (1998) 225).
//
// Step. Of all w in K one scales both to the same point, F x = F^-1 y = l (Nesterov and Todd, SIAM J. Optim. 8 (1998)
// 324). With the distance b = u' + |u'_t| n - y, that y is from the motions, and t = u'_t / |u'_t|
//
//     dy = T W' dx + b,   T = [1 t'; 0 I]                            b vanishes with whole steps
//     l o (F dx + F^-1 dy) = sigma g e - l o l - correction          g = x . y / N, e = (1, 0[, 0])
//     (I + F^-1 T W' F^-1) z = l \ (right-hand side) - F^-1 b,   dx = F^-1 z
//
// T W' is not symmetric, so the matrix is factorised by LU; it is regular where W has rank too. First sigma = 0 (where
// does that lead?), then sigma = (g reached / g)^3 and the second-order correction (F^-1 dy) o (F dx) of that step
// (Mehrotra, SIAM J. Optim. 2 (1992) 575). Acary, Armand, Nguyen, Shpakovych (Optim. Methods Softw. 38 (2023) 1071)
// solve the problem with |u_t| held; here its derivative stands in T. The problem is not convex: where the steps
// collapse the best point met is handed back.
#pragma once

#include <functional>
#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct InteriorPointEnd {
  Vector p;  ///< where the judge is content; otherwise of the least residual; empty where no point is finite
  bool content = false;
  int iterations = 0;
  double residual = 0.0;         ///< least natural map met, of forces in the units of W p, over |q|
  std::vector<Iteration> trace;  ///< its residual, its step length; merit is g / 2
};

/// Coulomb's law alone with mu > 0, no rigid motions, W sparse with W_ii > 0.
bool may_take_interior_points(const Problem& problem);

/// `content` is asked of forces and motions after each step.
InteriorPointEnd interior_points(const Problem& problem,
                                 const std::function<bool(const Vector& p, const Vector& motion)>& content,
                                 const Deadline& deadline = {});

}  // namespace scabo::contact
