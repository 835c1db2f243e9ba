// Proximal point (Rockafellar, SIAM J. Control Optim. 14 (1976) 877): a sequence of problems that are easier
// because they are held where the last one ended. In the forces
//
//     (W + alpha) p + q - alpha p_k,
//
// and where rigid motions are free, in these: G'p + f = beta (a - a_k). Where p and a stand still, the terms
// are gone and the problem itself is solved. W + alpha has full rank, so Alart and Curnier's Newton does well
// inside; alpha and beta fall tenfold where a problem was quickly solved, and rise where it was not.
//
// Good for: W without full rank (redundant pairs, stacks of rigid bodies), floating bodies. Forces that are
// not unique end near where they started.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

/// At most 4 problems for each of control.iterations, each with at most control.iterations Newton steps.
/// `bound` as in alart_curnier.
End proximal_point(const Problem& problem, Vector p, Vector a, const Control& control, const Vector* bound = nullptr);

/// Where rigid motions are free and there are no forces to start from, nothing holds the bodies yet: (p, a)
/// becomes the solution with the bodies held softly where they are. Returns the iterations it took.
int start_softly(const Problem& problem, Vector& p, Vector& a, const Control& control);

}  // namespace scabo::contact::solvers
