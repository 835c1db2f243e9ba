// Residual of the equation that defines K, and a step of Newton's method that reduces it.
//
// With q = K u at every xi the scaled boundary equation becomes the Riccati equation, and S governs the interior, xi
// u,xi = S u:
//
//     P(K) = (K - E1) E0^-1 (K - E1') - E2 = 0,   S = E0^-1 (K - E1')                                        (1)
//
// A root is the stiffness only if all exponents, the eigenvalues of S, have positive real part. Newton's step dK
// preserves that (Kleinman 1968) and squares the error:
//
//     S' dK + dK S = -P(K)                                                                                  (2)
//
// With the Cayley transform C = (g - S) (g + S)^-1 the solution is a sum, whose number of terms doubles at every step
// (Smith 1968):
//
//     dK = sum_k C'^k Q C^k,  Q = -2 g (g + S)^-T P (g + S)^-1;   Q <- Q + C'Q C,  C <- C^2                   (3)
//
// The residual is compared, entry by entry, with what rounding leaves of it: |P_ij| / sqrt(E2_ii E2_jj).
#pragma once

#include "scabo/base/types.hpp"
#include "scabo/linalg/cholesky_factor.hpp"

namespace scabo::element {

struct RiccatiResidual {
  Matrix P;           // n x n: -P(K), the lower triangle
  Matrix S;           // n x n
  double size = 0.0;  ///< largest |P_ij| / sqrt(E2_ii E2_jj)
};

/// The residual P together with its size.
RiccatiResidual judged(Matrix P, Matrix S, const Matrix& E2);

/// L: Cholesky factor of E0.
RiccatiResidual riccati_residual(const linalg::CholeskyFactor& L, const Matrix& E1, const Matrix& E2, const Matrix& K);

/// dK of eq. (2), symmetric; `scale`: n positive numbers of the order of sqrt(E0_ii), by which the unknowns are scaled.
Matrix newton_step(const RiccatiResidual& residual, const Vector& scale);

}  // namespace scabo::element
