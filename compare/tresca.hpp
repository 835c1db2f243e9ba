// Fixed-point iteration on the friction bound. With given bounds b the law is Tresca's, and the problem is convex for
// symmetric W,
//
//     minimise 1/2 p'W p + q'p   subject to p_n >= 0, |p_t| <= b
//
// It is solved, b = c + mu (p_n)+ is computed from the result, and so on (Panagiotopoulos, Ingenieur-Archiv 44 (1975)
// 421; Necas, Jarusek, Haslinger, Boll. Un. Mat. Ital. B 17 (1980) 796). The inner solver is the Newton method of Alart
// and Curnier with fixed bounds and, if it stalls, the same with W + 0.1 as in the proximal point method.
//
// Each iteration reduces the error by a factor of about mu |coupling of normal and tangent|: reliable and fast for low
// friction, slow or not convergent for high friction.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

/// At most 4 outer iterations for each of control.iterations.
End tresca(const Problem& problem, Vector p, Vector a, const Control& control);

}  // namespace scabo::compare
