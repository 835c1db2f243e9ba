// Lemke's pivoting method for plane friction, written as a linear complementarity problem. It needs no start and does
// not iterate, but every pivot costs the square of the number of pairs, and rounding accumulates. Where it ends on a
// ray there may be no solution, which is told of problems that were not solved (uniqueness.hpp).
//
//     [g; l + ds; l - ds; mu p_n - b+ - b-]  perpendicular to  [p_n; b+; b-; l] >= 0,   p_t = b+ - b-
//
// Where mu differs by direction, p_t = mu_b b+ - mu_f b-, the tangential rows are l + mu_b ds and l - mu_f ds, and the
// last one is p_n - b+ - b-.
//
// (Klarbring, Ingenieur-Archiv 56 (1986) 529; Stewart and Trinkle, Int. J. Numer. Meth. Engng 39 (1996) 2673).
#pragma once

#include <optional>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Forces (2N); nothing if the pivoting ends on a ray. The problem must not have rigid motions (m = 0).
std::optional<Vector> lemke(const Problem& problem);

}  // namespace scabo::contact
