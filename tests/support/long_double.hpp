// Matrices of long double (64-bit significands), where a test needs an oracle better than double. Eigen compiles its
// products and decompositions anew for them, so the heavy ones are functions here, compiled once.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::test {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

namespace long_double {

/// A B, also of a vector B (one column).
LongMatrix multiply(const LongMatrix& A, const LongMatrix& B);

/// A^-1 B by LU with partial pivoting.
LongMatrix solve_lu(const LongMatrix& A, const LongMatrix& B);

/// exp(A) by Pade approximants, scaling and squaring.
LongMatrix exponential(const LongMatrix& A);

}  // namespace long_double
}  // namespace scabo::test
