// Stress intensity at a crack or corner at the scaling centre of an open super-element.
//
// Crack frame: x1 points from the mouth to the tip and ahead of it, x2 to its left. The left face (end of the boundary
// chain) is above, x2 > 0. du = u(left) - u(right).
//
// Crack in one material. K_I, K_II: traction ahead [s12, s22] = (2 pi r)^-1/2 [K_II, K_I]. K_I > 0 opens the crack;
// K_II > 0 slides the left face along +x1, with s12 > 0 ahead. They follow from the opening of the singular modes at
// the mouth (nodal values: order 2p),
//
//     du = 2 (2 r / pi)^1/2 L^-1 [K_II, K_I]             isotropic: du = 8/E' (r / 2 pi)^1/2 [K_II, K_I]            (1)
//
// Interface crack (materials meet on x1 > 0): [s12, s22] = (2 pi r)^-1/2 (r/l)^G [K_II, K_I] with the reference length
// l; anisotropic_plane.hpp, eqs. (4) to (7).
//
// T-stress: the non-singular s11 at the tip, from the strain of the faces in the modes of exponent 1,
//
//     e11 = -u_1 x1 / r at the mouth,   T = e11 / (D^-1)_11 in the crack frame, on either side                      (2)
//
// Energy release rate. G from K: 1/4 [K_II, K_I] D [K_II, K_I]' / cosh^2(pi epsilon) = 1/2 K'L^-1 K in one material.
// Independently, J from the whole field: the tip moves by da along x1 while the boundary stays,
//
//     J = -dU/da = -1/2 c'X c,   T'X + X T = T'dE0_ T + dE1_ T + T'dE1_' + dE2_,   dEi_ = Phi' (dEi / da) Phi       (3)
//
// over all modes (u = Phi xi^T c). It is the domain J-integral with weight 1 - xi, integrated exactly; no exponent is
// selected.
//
// Loads inside (radial_load.hpp) add xi^j f to xi u,xi = S u. In a group, xi c,xi = T c + xi^j Q f, so that the part of
// the modes alone is
//
//     c = Q u(1) - sum of (j - T)^-1 Q f                                                                            (5)
//
// Corner (notch, junction of materials, crack that ends at an interface). At the distance r on a ray,
//
//     [K_tt, K_rt](r) = (2 pi r)^1/2 [s_tt, s_rt](r)   of the singular part                                         (4)
//
// is a generalised pair of factors at the characteristic length r (Song, Tin-Loi, Gao 2010): force / length^(3/2), for
// any exponents. For a real exponent separate from the others there is also the limit lim (2 pi)^1/2 r^(1 - lambda)
// [s_tt, s_rt] of its own mode (Gross, Mendelson 1972), which is r^(1/2 - lambda) times (4) of that mode. Where
// exponents merge, the factors of single modes grow without bound and cancel; close exponents are therefore kept
// together.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "scabo/element/plane/singular_field.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

enum class CornerKind { crack, interface_crack, corner };

/// One group of exponents of a corner.
struct CornerTerm {
  std::vector<std::complex<double>> exponents;
  Vec2 factors = Vec2::Zero();  ///< [K_tt, K_rt] of eq. (4) at the reference length, for this group only
  /// lim sqrt(2 pi) r^(1 - lambda) [s_tt, s_rt], only for a single real exponent. force / length^(1 + lambda)
  std::optional<Vec2> limit;
  bool defective = false;  ///< power-logarithmic
};

struct StressIntensity {
  CornerKind kind = CornerKind::crack;
  std::vector<std::complex<double>> exponents;  ///< all singular exponents, ascending
  double reference_length = 1.0;                ///< l or r of the factors; no effect for a crack in one material
  double epsilon = 0.0;                         ///< theoretical oscillation index
  double K_I = 0.0, K_II = 0.0;                 ///< crack; corner: eq. (4), all groups together
  std::optional<double> T_left, T_right;        ///< T-stress on either side; cracks only
  std::optional<double> G, J;                   ///< force / length; cracks only
  double ray = 0.0;                             ///< angle of the ray of the factors from the first face, radians
  std::vector<CornerTerm> terms;                ///< corners only
};

/// Contains the results that are computed once for a super-element; `of` then costs one product for each increment.
/// Keeps a reference to the solution.
class CornerAnalysis {
 public:
  /// `reference_length`: if empty, the distance of the mouth (cracks) or of the boundary along the ray (corners).
  CornerAnalysis(const Ring& ring, const Elasticity& D, const SuperElementSolution& solution,
                 std::optional<double> reference_length = std::nullopt);

  /// Factors for a displacement of the boundary under `loads` inside. With such loads J is not given, because its path
  /// crosses them. T is not given if one of them has the power 1: tractions on the faces that do not vanish at the tip,
  /// or constant temperature.
  StressIntensity of(const Vector& u, const std::vector<RadialLoad>& loads = {}) const;
  CornerKind kind() const { return kind_; }
  const SingularModes& modes() const { return modes_; }
  const CrackedBimaterial& bimaterial() const { return bimaterial_; }

 private:
  struct Forced {
    double power;
    Vector f;  // of eq. (5), n
  };
  std::vector<Forced> forced(const std::vector<RadialLoad>& loads) const;
  Vector coordinates(const ModeGroup& group, const Vector& u, const std::vector<Forced>& loads) const;
  void prepare_crack();
  void prepare_energy();

  Ring ring_;
  Elasticity D_;
  const SuperElementSolution& solution_;
  CornerKind kind_ = CornerKind::corner;
  SingularModes modes_;
  double mouth_ = 0.0;   // distance of the first node
  double length_ = 1.0;  // reference length
  double ray_ = 0.0;
  Mat2 frame_ = Mat2::Identity();  // rows x1, x2
  CrackedBimaterial bimaterial_;
  double softness_left_ = 0.0, softness_right_ = 0.0;  // (D^-1)_11
  std::vector<RayTraction> tractions_;                 // of the singular groups, corners only
  Matrix energy_;                                      // n x n: J = -1/2 u' energy u
};

/// d(E0, E1, E2) / da when the scaling centre moves along `direction` and the boundary stays, thickness 1.
CoefficientMatrices coefficient_derivatives(const Corner& corner, const Vec2& direction);

}  // namespace scabo::element
