// Fixed point on the friction bound: with bounds b given, the law is Tresca's and the problem convex for
// symmetric W,
//
//     minimise 1/2 p'W p + q'p   subject to p_n >= 0, |p_t| <= b
//
// solved, b = c + mu (p_n)+ of the result, and again (Panagiotopoulos, Ingenieur-Archiv 44 (1975) 421; Necas,
// Jarusek, Haslinger, Boll. Un. Mat. Ital. B 17 (1980) 796). Inside: Alart and Curnier's Newton with the
// bound held, and where that stalls, the same with W + 0.1 in the sense of the proximal point.
//
// Each round makes the error smaller by about mu |coupling of normal and tangent|: sure and quick for little
// friction, many rounds or none that helps for much.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

/// At most 4 rounds for each of control.iterations.
End tresca(const Problem& problem, Vector p, Vector a, const Control& control);

}  // namespace scabo::contact::solvers
