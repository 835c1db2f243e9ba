// Proximal point method (Rockafellar, SIAM J. Control Optim. 14 (1976) 877): a sequence of regularised, easier
// problems, each centred at the solution of the previous one. In the forces
//
//     (W + alpha) p + q - alpha p_k,
//
// and, if rigid motions are free, in these: G'p + f = beta (a - a_k). When p and a no longer change, the additional
// terms vanish and the original problem is solved. W + alpha has full rank, so that the Newton method of Alart and
// Curnier works well for these problems; alpha and beta are reduced tenfold when a problem was solved quickly, and
// increased when it was not.
//
// Suitable for rank-deficient W (redundant pairs, stacks of rigid bodies) and floating bodies. Forces that are not
// unique end near their start.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

/// At most 4 problems for each of control.iterations, each with at most control.iterations Newton steps.
/// `bound` as in alart_curnier.
End proximal_point(const Problem& problem, Vector p, Vector a, const Control& control, const Vector* bound = nullptr);

/// If rigid motions are free and there are no forces to start from, nothing holds the bodies yet: (p, a) is set to the
/// solution with the bodies held by soft springs at their position. Returns the number of iterations.
int start_softly(const Problem& problem, Vector& p, Vector& a, const Control& control);

}  // namespace scabo::compare
