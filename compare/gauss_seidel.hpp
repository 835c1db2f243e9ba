// Nonsmooth Gauss-Seidel in the plane and in space as a solver of its own, with the sweeps of ../gauss_seidel.hpp.
//
// A sparse W is used column by column. These are the cheapest iterations of all solvers, and the only ones without a
// factorisation. Suitable for very many pairs, rank-deficient W and low accuracy. Convergence is at best linear and not
// guaranteed.
#pragma once

#include "compare/common.hpp"

namespace scabo::compare {

/// At most 400 sweeps for each of control.iterations. Coulomb's law only; no rigid motions.
End gauss_seidel(const Problem& problem, Vector p, const Control& control);

}  // namespace scabo::compare
