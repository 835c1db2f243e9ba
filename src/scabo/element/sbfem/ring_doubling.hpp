// Stiffness of the domain inside or outside a ring, from coefficient matrices without zero exponents.
//
// In s = ln xi the scaled boundary equation has constant coefficients, so that all rings [xi, xi e^d] are alike. One
// midpoint (Cayley) step gives the symmetric stiffness of a ring on its inner (1) and outer (2) nodes,
//
//     K22 = E0/d + (E1 + E1')/2 + d/4 E2                                                                    (1)
//     K11 = E0/d - (E1 + E1')/2 + d/4 E2
//     K12 = -E0/d + (E1 - E1')/2 + d/4 E2
//
// and joining two rings, a inside b, eliminates their common nodes, with B = K22a + K11b symmetric positive definite:
//
//     K22 = K22b - K12b' B^-1 K12b,   K11 = K11a - K12a B^-1 K12a',   K12 = -K12a B^-1 K12b                 (2)
//
// With a = b this doubles a ring; K22 tends quadratically to the stiffness of the domain inside, and K11 to that of the
// domain outside. The Cayley step preserves invariant subspaces, so that the limit is exact although the ring is not.
// Only Cholesky factors, triangular solves and symmetric products are used.
//
// Over a ring, a mode of exponent lambda is reduced by the factor (g - lambda) / (g + lambda), g = 2/d. The first ring,
// which is then doubled, is made of two rings with
//
//     g = w +- sqrt(w^2 - h),  w^2 = sqrt(h) (1 + h) / 2,  h the largest exponent                           (3)
//
// the pair that minimises the largest product of factors over 1 <= lambda <= h (Wachspress 1966): at h = 200 it is
// 0.45, instead of 0.75 for one ring doubled, which saves 1.3 doublings. The choice affects the number of doublings,
// not their result.
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

/// Throws IllPosed if E0 or a ring is not positive definite (to working precision), or the doubling does not converge.
/// If the Riccati residual is above 1e-13 (or n 1e-15), K is corrected (riccati.hpp) up to three times; the caller
/// judges the remaining residual.
RingStiffness ring_doubling(const Matrix& E0, const Matrix& E1, const Matrix& E2, Side side = Side::inside);

}  // namespace scabo::element
