// Nonsmooth Gauss-Seidel in the plane and in space, alone and to the end: the sweeps of ../gauss_seidel.hpp.
//
// Sparse W is swept by its columns: the cheapest sweeps of all roads, and the only one that needs no
// factorisation. Good for: very many pairs, W without full rank, rough accuracy. Convergence is linear at
// best, and not certain.
#pragma once

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

/// At most 400 sweeps for each of control.iterations. Coulomb's law only; no rigid motions.
End gauss_seidel(const Problem& problem, Vector p, const Control& control);

}  // namespace scabo::contact::solvers
