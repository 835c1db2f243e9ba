#include "support/long_double.hpp"

#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

namespace scabo::test::long_double {

LongMatrix multiply(const LongMatrix& A, const LongMatrix& B) { return A * B; }
LongMatrix solve_lu(const LongMatrix& A, const LongMatrix& B) { return A.partialPivLu().solve(B); }
LongMatrix exponential(const LongMatrix& A) { return A.exp(); }

}  // namespace scabo::test::long_double
