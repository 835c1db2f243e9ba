// Stiffness of the domain inside or outside a ring, from coefficient matrices without zero exponents.
//
// In s = ln xi the scaled boundary equation has constant coefficients, so all rings [xi, xi e^d] are alike. One
// midpoint (Cayley) step gives the symmetric stiffness of a ring on its inner (1) and outer (2) nodes,
//
//     K22 = E0/d + (E1 + E1')/2 + d/4 E2                                                                    (1)
//     K11 = E0/d - (E1 + E1')/2 + d/4 E2
//     K12 = -E0/d + (E1 - E1')/2 + d/4 E2
//
// and two rings joined, a inside b, eliminate their common nodes, with B = K22a + K11b symmetric positive definite:
//
//     K22 = K22b - K12b' B^-1 K12b,   K11 = K11a - K12a B^-1 K12a',   K12 = -K12a B^-1 K12b                 (2)
//
// With a = b this doubles a ring; K22 tends to the stiffness inside and K11 to that outside, quadratically. The Cayley
// step keeps invariant subspaces, so the limit is exact although the ring is not. Only Cholesky factors, triangular
// solves and symmetric products are used.
//
// A mode of exponent lambda shrinks over a ring by (g - lambda) / (g + lambda), g = 2/d. The ring that is doubled is
// two joined, with
//
//     g = w +- sqrt(w^2 - h),  w^2 = sqrt(h) (1 + h) / 2,  h the largest exponent                           (3)
//
// the pair that makes the largest product over 1 <= lambda <= h smallest (Wachspress 1966): at h = 200 0.45 instead of
// 0.75 by one ring doubled, 1.3 doublings less. It decides how many are needed, not their result.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::element {

enum class Side { inside, outside };

struct RingStiffness {
  Matrix K;  // n x n, symmetric; q = K u inside, q = -K u outside
  Matrix S;  // n x n: xi u,xi = S u
  int doublings = 0;
  double residual = 0.0;  ///< of the Riccati equation, RiccatiResidual::size
};

/// Throws IllPosed when E0 or a ring is not positive definite (to working precision), or the doubling does not end.
/// Where the Riccati residual is above 1e-13 (or n 1e-15) K is corrected (riccati.hpp), three times at most; what is
/// left of it is the caller's to judge.
RingStiffness ring_doubling(const Matrix& E0, const Matrix& E1, const Matrix& E2, Side side = Side::inside);

}  // namespace scabo::element
