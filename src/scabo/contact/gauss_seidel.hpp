// Nonsmooth Gauss-Seidel: pair by pair, the exact solution of the local problem. Slow and hard to stop: a start for
// Newton where Newton's own fail (Jourdan, Alart, Jean, Comput. Methods Appl. Mech. Engrg. 155 (1998) 31).
#pragma once

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Forces after `sweeps` sweeps from `p`. The problem has no rigid motions (m = 0).
Vector gauss_seidel(const Problem& problem, Vector p, int sweeps);

}  // namespace scabo::contact
