// Whether a vector is a non-negative combination of the columns of a large sparse matrix, or a proof that it is not
// (Farkas): either x >= 0 with A x = b, or y with A'y <= 0 and b'y > 0.
//
// Interior-point method (Mehrotra, SIAM J. Optim. 2 (1992) 575) on the first phase of the simplex method,
//
//     min t    A x + t (b - A 1) = b,    x, t >= 0            (x = 1, t = 1 is feasible)
//
// Each step factorises A D A' (m x m, sparse). The minimum of t is 0 if the combination exists; otherwise the dual
// variables y are the proof. linalg/nonnegative_least_squares does the same for small dense matrices by an exact
// method.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// y with A'y <= 0 (to rounding), b'y > 0 and |y| = 1; nothing if b is a non-negative combination of the columns of A
/// or the question could not be decided. The columns of A and b should be of order 1.
std::optional<Vector> separating_vector(const Eigen::SparseMatrix<double>& A, const Vector& b);

}  // namespace scabo::linalg
