// How well K satisfies the equation that defines it, and a step of Newton's method where it does not well enough.
//
// q = K u at every xi turns the scaled boundary equation into the Riccati equation, with the part S of it that drives
// the interior, xi u,xi = S u,
//
//     P(K) = (K - E1) E0^-1 (K - E1') - E2 = 0,   S = E0^-1 (K - E1')                                        (1)
//
// A root is K only where all exponents, the eigenvalues of S, have positive real part. Newton's step dK from there
// keeps that (Kleinman 1968) and squares the error:
//
//     S' dK + dK S = -P(K)                                                                                  (2)
//
// With the Cayley transform C = (g - S) (g + S)^-1 that is a sum, which doubles its terms at every step (Smith 1968):
//
//     dK = sum_k C'^k Q C^k,  Q = -2 g (g + S)^-T P (g + S)^-1;   Q <- Q + C'Q C,  C <- C^2                   (3)
//
// The residual is measured against what rounding leaves of it, entry by entry: |P_ij| / sqrt(E2_ii E2_jj).
#pragma once

#include "scabo/base/types.hpp"
#include "scabo/linalg/cholesky_factor.hpp"

namespace scabo::element {

struct RiccatiResidual {
  Matrix P;           // n x n: -P(K), the lower triangle
  Matrix S;           // n x n
  double size = 0.0;  ///< largest |P_ij| / sqrt(E2_ii E2_jj)
};

/// With the size that belongs to them.
RiccatiResidual judged(Matrix P, Matrix S, const Matrix& E2);

/// L: Cholesky factor of E0.
RiccatiResidual riccati_residual(const linalg::CholeskyFactor& L, const Matrix& E1, const Matrix& E2, const Matrix& K);

/// dK of eq. (2), symmetric; `scale`: n positive numbers of the size of sqrt(E0_ii), which unknowns are measured with.
Matrix newton_step(const RiccatiResidual& residual, const Vector& scale);

}  // namespace scabo::element
