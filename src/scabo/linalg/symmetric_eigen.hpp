// Eigenvalues of pairs of symmetric matrices, A x = nu B x.
#pragma once

#include <Eigen/SparseCore>
#include <functional>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

struct EigenPairs {
  Vector values;   // descending
  Matrix vectors;  // n x count
};

/// The `count` largest nu of A x = nu B x; A symmetric, B symmetric positive definite, both dense, n x n (LAPACK's
/// dsygvx). Small eigenvalues are only as accurate as rounding of the largest allows; small eigenvalues of interest
/// should therefore be computed as large ones of the inverse problem: for K x = lambda M x use A = M, B = K.
EigenPairs largest_eigenpairs(Matrix A, Matrix B, int count);

/// y = A x for a symmetric A.
using Operator = std::function<Vector(const Vector&)>;

/// The `count` largest nu of inverse(B x) = nu x, by the Lanczos method with implicit restarts in the inner product of
/// B (Spectra); `inverse` and B symmetric, n x n, B positive definite; count < n. With inverse = K^-1, B = M: nu = 1 /
/// lambda of K x = lambda M x. Fewer than `count` if it does not converge. Equal eigenvalues may be found fewer times
/// than they occur; `eigenvalues_below` counts them. `start` selects the initial vector.
EigenPairs largest_by_lanczos(const Operator& inverse, const Eigen::SparseMatrix<double>& B, int count,
                              unsigned start = 0);

/// Number of eigenvalues of A x = lambda B x below `shift`, by Sylvester's law of inertia: the signs of the pivots of A
/// - shift B = L D L'. -1 if a pivot vanishes.
int eigenvalues_below(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B, double shift);

}  // namespace scabo::linalg
