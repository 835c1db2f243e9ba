// Starts for Newton's method if there is no history.
//
// At zero force every pair lies at the apex of its cone, which does not distinguish stick from slip. Sweeps of
// Gauss-Seidel cost less than one factorisation and do distinguish them, but many sweeps are needed to carry forces
// from one end of a joint to the other. Problems with many pairs therefore start from a problem with half as many
// (contact/coarse_problem.hpp), recursively: nested iteration.
//
//     start(N):  N < 48:  30 sweeps from zero
//                else     p_c, a from start(N / 2), then by Newton on the problem of N / 2 groups, at most
//                         3 iterations, until |H| <= 0.05 |p_c| of the start (largest components);
//                         p = P p_c;  3 sweeps
//
// Where pairs are not coupled, 30 sweeps from zero replace the coarse problem. Bodies supported by contact alone (m >
// 0) are held during sweeps by 0.7 of the mean stiffness of a pair, around the current a. With them at most 10
// iterations are made on fewer pairs, sweeps follow p = P p_c only up to 300 pairs, and where Newton does not reach its
// aim on the fewest pairs it begins there from the forces of pairs that are all held (contact/bonded_start.hpp) as
// well. Nothing here needs to converge: the last solve is always Newton on the original problem. Figures:
// docs/methods/12_contact_solver.md.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct ColdStart {
  Vector p, a;
  int coarse_iterations = 0;     ///< of Newton on the problems of fewer pairs
  std::vector<Iteration> trace;  ///< these iterations, numbered from 0, the problem of fewest pairs first
};

/// 30 sweeps from zero. W must be scaled so that the mean of its diagonal is 1, as in contact/ladder.hpp; this also
/// holds for the other functions.
ColdStart swept_start(const Problem& problem, const Vector& a);

/// By problems of fewer pairs, if may_nest().
ColdStart nested_start(const Problem& problem, const Vector& a);

/// By a problem of some of the pairs where W is not formed (contact/starts/sampled_problem.hpp), which is solved as
/// loosely as those of fewer pairs: the forces with which every pair is in the state of the nearest one among them.
/// Nothing where there is none.
std::optional<ColdStart> sampled_start(const Problem& problem, const Vector& a);

/// Whether nested iteration is possible and worthwhile: plane problems with dense W and enough pairs.
bool may_nest(const Problem& problem);

}  // namespace scabo::contact
