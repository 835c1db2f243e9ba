// min |A x - b| subject to x >= 0 (Lawson and Hanson, Solving Least Squares Problems, 1974, chapter 23).
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// A: m x n with few rows. The residual b - A x of the result has A'(b - A x) <= 0: where it is not zero, it is the
/// proof that A x = b has no solution x >= 0 (Farkas).
Vector nonnegative_least_squares(const Matrix& A, const Vector& b);

}  // namespace scabo::linalg
