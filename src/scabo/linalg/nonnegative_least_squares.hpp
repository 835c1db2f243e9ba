// min |A x - b| subject to x >= 0 (Lawson and Hanson, Solving Least Squares Problems, 1974, chapter 23).
#pragma once

#include <functional>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// A: m x n with few rows. The residual b - A x of the result satisfies A'(b - A x) <= 0: if it is not zero, it proves
/// that A x = b has no solution x >= 0 (Farkas).
Vector nonnegative_least_squares(const Matrix& A, const Vector& b);

/// The same for many rows: G = A'A, h = A'b, and `residual` gives A'(b - A x), with which x is refined at the end. A
/// factor for the positive x is kept and extended, with about n^3 / 3 operations in total; columns that depend on those
/// remain 0.
Vector nonnegative_least_squares_of_normal(const Matrix& G, const Vector& h,
                                           const std::function<Vector(const Vector& x)>& residual);

}  // namespace scabo::linalg
