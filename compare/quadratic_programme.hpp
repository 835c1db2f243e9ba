// Frictionless contact as a convex quadratic programme in the normal forces (Conry and Seireg, J. Appl. Mech. 38 (1971)
// 387),
//
//     minimise 1/2 p_n' W_nn p_n + q_n' p_n   subject to p_n >= 0
//     its conditions:   0 <= p_n  perpendicular to  W_nn p_n + q_n >= 0
//
// by an active-set method: the pair with the most negative gap enters, the equations of the active pairs are solved,
// and pairs whose force would change sign on the way leave (Lawson and Hanson, Solving Least Squares Problems, 1974,
// chapter 23, on the normal equations). The objective decreases from set to set, so that no set occurs twice. If W_nn
// of the set is singular, the step is along a force that causes no motion; if nothing limits this step, no forces can
// close the gaps and there is no solution.
//
// Exact in finitely many steps, for mu = 0 at all pairs. Other problems are refused.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

End quadratic_programme(const Problem& problem, const Control& control);

}  // namespace scabo::compare
