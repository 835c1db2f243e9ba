// Plane anisotropic elasticity in the Stroh formalism, without its eigenvectors.
//
// A plane law D (stress = D strain, in-plane) gives C_ijkl in Voigt's order. With (ab)_jk = a_i C_ijkl b_l for the
// frame m = (cos t, sin t), n = (-sin t, cos t),
//
//     N1 = -(nn)^-1 (nm),   N2 = (nn)^-1,   N3 = (mn)(nn)^-1(nm) - (mm),   N(t) = [[N1, N2], [N3, N1']]         (1)
//
// is the fundamental elasticity matrix (Ting 1996, sections 5.5 and 7.4). With the stress function phi (traction on a
// ray = d phi / dr on its side), a field [u; phi] = w(t) r^T satisfies
//
//     dw/dt = N(t) w T                                                                                          (2)
//
// The Barnett-Lothe tensors are the matrix function of N that is +-i on its eigenvalues in the upper and lower half
// plane,
//
//     [[S, H], [-L, S']] = lim Y,   Y <- (c Y - (c Y)^-1) / 2   from Y = N(0)                                   (3)
//
// (Newton's iteration for the matrix sign of -i N). It is quadratic and real, and repeated roots, including those of
// isotropic material, need no special treatment. Plane strain, isotropic: L = E / (2 (1 - nu^2)).
//
// Two half planes, 1 above and 2 below the x1 axis, with a crack along x1 < 0 (Suo 1990; Ting 1996, chapter 11):
//
//     D = L1^-1 + L2^-1,   W = S1 L1^-1 - S2 L2^-1,   beta^2 = -tr((D^-1 W)^2) / 2
//     |epsilon| = atanh(beta) / pi,   G = -(|epsilon| / beta) D^-1 W  (G^2 = -epsilon^2)                        (4)
//     traction ahead:     t(r) = (2 pi r)^-1/2 (r/l)^G k,              t = [s12, s22], k = [K_II, K_I]          (5)
//     opening behind:     du(r) = 2 D (r / 2 pi)^1/2 ((1 + 2 G) cosh(pi epsilon))^-1 (r/l)^G k                  (6)
//     energy release:     G_J = k' D k / (4 cosh^2(pi epsilon))                                                 (7)
//
// epsilon has the sign that makes s22 + i s12 = (K_I + i K_II) (2 pi r)^-1/2 (r/l)^(i epsilon) between isotropic
// halves. In one material G = 0 and (6) is du = 2 (2 r / pi)^1/2 L^-1 k.
#pragma once

#include "scabo/element/plane/elasticity.hpp"

namespace scabo::element {

using Mat4 = Eigen::Matrix4d;

/// D of the same material in axes rotated by `angle` (counter-clockwise); strains and stresses refer to the new axes.
Mat3 rotated_elasticity(const Mat3& D, double angle);

/// N(t) of eq. (1); `D` and the result refer to the original axes.
Mat4 fundamental_elasticity(const Mat3& D, double t);

struct BarnettLothe {
  Mat2 S, H, L;  // H: length^2 / force, L: force / length^2
};
BarnettLothe barnett_lothe(const Mat3& D);

/// Two half planes with a crack between them, in the frame of the crack.
struct CrackedBimaterial {
  Mat2 D;                ///< length^2 / force
  Mat2 G;                ///< of eq. (4); 0 in one material
  double epsilon = 0.0;  ///< signed
  /// (r/l)^G.
  Mat2 oscillation(double r_over_l) const;
  /// k = [K_II, K_I] at the reference length l, from the opening du at the distance r.
  Vec2 intensity(const Vec2& opening, double r, double l) const;
  /// The opening du at the distance r.
  Vec2 opening(const Vec2& k, double r, double l) const;
  /// Eq. (7), force / length.
  double energy_release_rate(const Vec2& k) const;
};
/// `above`, `below`: plane laws in the frame of the crack. If they are equal, G = 0 exactly.
CrackedBimaterial cracked_bimaterial(const Mat3& above, const Mat3& below);

}  // namespace scabo::element
