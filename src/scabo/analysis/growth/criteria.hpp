// Where a crack grows, and when: from its stress intensity factors K_I and K_II at the tip, isotropic material.
//
// Angles a are counter-clockwise from the direction of the crack. In its frame (element/plane/stress_intensity.hpp)
// K_II > 0 turns the crack clockwise. K* is the equivalent factor: the tip is critical at K* = K_Ic. In pure mode I
// a = 0 and K* = K_I by all criteria.
//
// hoop_stress. Maximum hoop stress (Erdogan and Sih 1963):
//
//     tan(a / 2) = -2 K_II / (K_I + (K_I^2 + 8 K_II^2)^1/2),   K* = cos(a / 2) (K_I cos^2(a / 2) - 3/2 K_II sin a)  (1)
//
// With the T-stress, at a distance r from the tip (Williams and Ewing 1972; Smith, Ayatollahi and Pavier 2001): a is
// where
//
//     cos(a / 2) (K_I cos^2(a / 2) - 3/2 K_II sin a) + T (2 pi r)^1/2 sin^2 a                                       (7)
//
// is largest, which is K*. Where T (2 pi r)^1/2 > 3/8 K_I a crack in pure mode I turns, to its left.
//
// Factors of an infinitesimal kink at the angle a, F_ij as series in a / pi (Amestoy and Leblond 1992):
//
//     k_1 = F11 K_I + F12 K_II,   k_2 = F21 K_I + F22 K_II                                                          (2)
//
// energy_release:   a maximises k_1^2 + k_2^2, whose root is K* (G = (k_1^2 + k_2^2) / E')                          (3)
// zero_K_II:        k_2 = 0, K* = k_1                                                                               (4)
//
// strain_energy_density. Sih (1974), with kappa = 3 - 4 nu (plane strain), (3 - nu) / (1 + nu) (plane stress):
//
//     S = A K_I^2 + 2 B K_I K_II + C K_II^2,   A = (1 + c)(kappa - c),  B = s (2 c - kappa + 1),
//     C = (kappa + 1)(1 - c) + (1 + c)(3 c - 1),   c = cos a,  s = sin a                                            (5)
//
// up to a factor; a is its minimum that is next to 0, and K* = (S / (2 (kappa - 1)))^1/2.
//
// straight:         a = 0, K* = (K_I^2 + K_II^2)^1/2, so that G = K*^2 / E' whatever the mode (6)
#pragma once

#include "scabo/base/types.hpp"
#include "scabo/model/growth.hpp"

namespace scabo::analysis {

struct Kink {
  double angle = 0.0;       ///< radians, counter-clockwise from the direction of the crack
  double equivalent = 0.0;  ///< K*, force / length^(3/2)
};

/// Of a tip, force / length^(3/2).
struct TipFactors {
  Vec2 K = Vec2::Zero();  ///< [K_I, K_II]
  double T = 0.0;         ///< T (2 pi r)^1/2 of eq. (7); 0 without a distance

  /// A tip that is closed counts with K_I = 0.
  TipFactors opened() const { return {Vec2(K[0] > 0.0 ? K[0] : 0.0, K[1]), T}; }
};
inline TipFactors operator+(const TipFactors& a, const TipFactors& b) { return {a.K + b.K, a.T + b.T}; }
inline TipFactors operator-(const TipFactors& a, const TipFactors& b) { return {a.K - b.K, a.T - b.T}; }
inline TipFactors operator*(double factor, const TipFactors& a) { return {factor * a.K, factor * a.T}; }

/// `factors`: with K_I >= 0, K not zero. `kappa` > 1.
Kink kink_of(model::GrowthCriterion criterion, const TipFactors& factors, double kappa);

/// The angle; a tip that is closed counts with K_I = 0, and 0 is that of no load.
double kink_at(model::GrowthCriterion criterion, const TipFactors& factors, double kappa);

/// Eq. (2): [k_1, k_2] at a kink of up to 90 degrees either way.
Vec2 factors_at_kink(const Vec2& factors, double angle);

/// The kink that is followed, radians. Small ones are errors of the factors: the crack goes on straight, and stays on
/// the line of cells that it is on.
double kink_or_none(double kink);

}  // namespace scabo::analysis
