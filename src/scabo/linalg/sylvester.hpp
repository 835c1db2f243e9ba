// Sylvester's equation in real Schur form.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// Solution X of
///    T1' X + X T2 = C
/// with T1 (n x n) and T2 (m x m) upper quasi-triangular (2 x 2 blocks in LAPACK's standard form); C, X: n x m. No
/// eigenvalue of T1 may be the negative of one of T2. The larger matrix is halved recursively until LAPACK's dtrsyl,
/// which works column by column, handles only small ones; all other work is products of matrices.
///     T1' X + X T2 = C
/// with T1 (n x n) and T2 (m x m) upper quasi-triangular (2 x 2 blocks in LAPACK's standard form); C, X: n x m. No
/// eigenvalue of T1 may be the negative of one of T2. Halves the larger matrix until LAPACK's dtrsyl, which works
/// column by column, has small ones only: all the rest is products of matrices.
Matrix solve_sylvester(const Matrix& T1, const Matrix& T2, Matrix C);

}  // namespace scabo::linalg
