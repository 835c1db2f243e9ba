// Without friction: a convex quadratic programme in the normal forces (Conry and Seireg, J. Appl. Mech. 38
// (1971) 387),
//
//     minimise 1/2 p_n' W_nn p_n + q_n' p_n   subject to p_n >= 0
//     its conditions:   0 <= p_n  perpendicular to  W_nn p_n + q_n >= 0
//
// by an active set: the pair with the most negative gap comes in, the equations of those that are in are
// solved, and those whose force would change sign leave on the way (Lawson and Hanson, Solving Least Squares
// Problems, 1974, chapter 23, on the normal equations). The value falls from set to set, so none is met
// twice. Where W_nn of the set is singular, the way is a force that moves nothing; where nothing stops it the
// gaps cannot be closed by any forces: no solution.
//
// Exact in finitely many steps, for mu = 0 everywhere. Anything else is refused.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

End quadratic_programme(const Problem& problem, const Control& control);

}  // namespace scabo::contact::solvers
