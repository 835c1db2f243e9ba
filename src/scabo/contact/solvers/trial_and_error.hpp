// Trial and error on states: assume open, stick or slip for every pair, solve the linear equations that
// follow, correct the states that the result contradicts, and again (the way of the first contact codes:
// Francavilla and Zienkiewicz, Int. J. Numer. Meth. Engng 9 (1975) 913; Okamoto and Nakazawa, ibid. 14 (1979)
// 337).
//
//     open   p_n = 0, p_t = 0               stays while g >= 0
//     stick  g = 0, ds = 0                  stays while p_n >= 0 and |p_t| <= mu p_n
//     slip   g = 0, p_t = mu p_n e          stays while p_n >= 0 and e . ds <= 0
//
// e: along the p_t that exceeded the bound; in space turned to -ds/|ds| after each solve, so that its
// direction is found by a fixed point. All states are corrected at once. Few solves where few states change;
// nothing makes the residual fall, and with friction it can go around the same states for ever: each set of
// states is remembered, and the first one met again ends it with that reason. Coulomb's law only: no
// cohesion, no tension.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

End trial_and_error(const Problem& problem, Vector p, Vector a, const Control& control);

}  // namespace scabo::contact::solvers
