// The point nearest to a given one under linear conditions (Lawson and Hanson, Solving Least Squares Problems, 1974,
// chapter 23: least distance programming).
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// min |v - aim| subject to B v >= h, where v = 0 is admissible (h <= 0); a point on the way from 0 to it where
/// rounding leaves it outside.
Vector nearest_within(const Matrix& B, const Vector& h, const Vector& aim);

}  // namespace scabo::linalg
