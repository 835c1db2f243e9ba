// The point nearest to a given one under linear conditions (Lawson and Hanson, Solving Least Squares Problems, 1974,
// chapter 23: least distance programming).
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// min |v - aim| subject to B v >= h. The active conditions that non-negative least squares finds are put right where
/// rounding has left one out; where no v is admissible, one that is by little outside.
Vector nearest_within(const Matrix& B, const Vector& h, const Vector& aim);

}  // namespace scabo::linalg
