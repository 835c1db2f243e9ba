// Accelerated sweeps: nonsmooth Gauss-Seidel (gauss_seidel.hpp) with extrapolation to its limit, for problem files
// that are judged by the natural map (judge.hpp). Most of them need no factorisation at all.
//
// A sweep is a map p -> S(p) whose fixed points are the solutions. After each, from the last five changes of
// p and of f = S(p) - p, the next forces are (Anderson, J. ACM 12 (1965) 547; type II)
//
//     p+ = S(p) - sum_j gamma_j dS_j,   gamma = argmin | f - sum_j gamma_j df_j |
//
// The motions follow from the same sum, without a product with W. When the natural map rises to twice its
// least value since the last restart, the stored changes are discarded. Sweeps continue while thirty of them
// reduce the least natural map by a factor of four or more, and end when the judge accepts the point with motions
// computed afresh.
//
// Its functions and those of a sweep are marked hot so that they lie together in the program: what a small problem
// costs in a new process is mostly the code that it is the first to touch (4 to 8 us for each 64 kB; a second solve
// takes 2 to 20).
#pragma once

#include <cmath>
#include <utility>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"

namespace scabo::contact {

struct SweepsEnd {
  Vector p, motion;  // dN, accepted by the judge; otherwise those of the least natural map
  bool content = false;
  int sweeps = 0;
  double natural_map = HUGE_VAL;  ///< of p, as computed during the sweeps
  double residual = 0.0;          ///< largest |H| of b_differentiable.hpp as a force, where content
};

/// Whether the problem has Coulomb's law only, no rigid motions, and a dense or sparse W.
bool may_accelerate(const Problem& problem);

/// From the forces `p`. Content: natural map and rounding (judge.hpp) are not above `tolerance`.
SweepsEnd accelerated_sweeps(const Problem& problem, Vector p, double tolerance, const Measure& measure,
                             const Deadline& deadline = {});
inline SweepsEnd accelerated_sweeps(const Problem& problem, Vector p, double tolerance) {
  return accelerated_sweeps(problem, std::move(p), tolerance, Measure(problem));
}

}  // namespace scabo::contact
