// Trial and error on states: assume open, stick or slip for every pair, solve the resulting linear equations, correct
// the states that the result contradicts, and repeat (the method of the first contact programs: Francavilla and
// Zienkiewicz, Int. J. Numer. Meth. Engng 9 (1975) 913; Okamoto and Nakazawa, ibid. 14 (1979) 337).
//
//     open   p_n = 0, p_t = 0               stays while g >= 0
//     stick  g = 0, ds = 0                  stays while p_n >= 0 and |p_t| <= mu p_n
//     slip   g = 0, p_t = mu p_n e          stays while p_n >= 0 and e . ds <= 0
//
// e: direction of the p_t that exceeded the bound; in space it is set to -ds/|ds| after each solve, so that the
// direction is found by a fixed-point iteration. All states are corrected at once. Few solves are needed if few states
// change. Nothing ensures that the residual decreases, and with friction the states can cycle: all sets of states are
// stored, and the method ends with that reason when one occurs again. Coulomb's law only: no cohesion, no tension.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

End trial_and_error(const Problem& problem, Vector p, Vector a, const Control& control);

}  // namespace scabo::compare
