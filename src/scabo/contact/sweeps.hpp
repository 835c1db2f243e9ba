// Accelerated sweeps: nonsmooth Gauss-Seidel (gauss_seidel.hpp), its limit extrapolated, for problems of
// others that are judged by the natural map (certificate.hpp). Most of them need no factorisation at all.
//
// A sweep is a map p -> S(p) whose fixed points are the solutions. After each, from the last five changes of
// p and of f = S(p) - p, the next forces are (Anderson, J. ACM 12 (1965) 547; type II)
//
//     p+ = S(p) - sum_j gamma_j dS_j,   gamma = argmin | f - sum_j gamma_j df_j |
//
// The motions follow by the same sum, without a product with W. Where the natural map rises to twice the
// least met since, the changes are forgotten. Sweeps go on while thirty of them divide the least natural map
// by four or more, and end where the judge is content with motions computed afresh.
//
// Its functions and those of a sweep are marked hot so that they lie together in the program: what a small problem
// costs in a new process is mostly the code that it is the first to touch (4 to 8 us for each 64 kB; a second solve
// takes 2 to 20).
#pragma once

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

struct SweepsEnd {
  Vector p, motion;  // dN, where the judge is content; otherwise the last ones
  bool content = false;
  int sweeps = 0;
  double residual = 0.0;  ///< largest |H| of b_differentiable.hpp as a force, where content
};

/// Coulomb's law alone, no rigid motions, W dense or sparse.
bool may_accelerate(const Problem& problem);

/// From the forces `p`. Content: the natural map is not above `tolerance`.
SweepsEnd accelerated_sweeps(const Problem& problem, Vector p, double tolerance);

}  // namespace scabo::contact
