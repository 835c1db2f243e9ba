// The singular part of the field of an open super-element: at a crack, a notch, or a corner where materials meet.
//
// The exponents of S (modal_solution.hpp) are of three kinds: below 1 (singular stress), equal to 1 (rotation,
// T-stress), and the rest. For a group, with the spectral projections of linalg/ordered_schur.hpp,
//
//     u(xi) = Phi xi^T c,   c = Q u(1)                                                                              (1)
//
// T is quasi-triangular and small; xi^T is its matrix function, so that power-logarithmic fields (defective T) need no
// special treatment. Phi includes the translation that belongs to the modes, so that (1) vanishes at the scaling
// centre.
//
// Stress. With the strain matrices of a boundary point, stress = D (B1 Phi T + B2 Phi) xi^(T - 1) c, which converges
// with order p. Tractions on a ray between two boundary elements converge with order 2p, like nodal values, if they are
// computed from the equilibrium of the element that ends there:
//
//     r t(r) = -R xi^T c,   R = [E0 Phi T^2 + (E1' - E1) Phi T - E2 Phi] of that element, rows of the node          (2)
//
// The exact angular equation (anisotropic_plane.hpp, eq. 2) gives them on any other ray.
#pragma once

#include <complex>
#include <vector>

#include "scabo/element/plane/anisotropic_plane.hpp"
#include "scabo/element/plane/stiffness.hpp"

namespace scabo::element {

/// Modes of a group of exponents, eq. (1).
struct ModeGroup {
  Matrix Phi;                                   // n x m
  Matrix T;                                     // m x m
  Matrix Q;                                     // m x n
  std::vector<std::complex<double>> exponents;  ///< m
  double projection_norm = 1.0;                 ///< amplification of rounding in c; large if the next group is close

  Eigen::Index size() const { return T.rows(); }
  /// Whether some exponents are equal (within `spread`) and have fewer modes than their number: power-logarithmic.
  bool defective(double spread = 1e-5) const;
  /// Displacement of the ring at xi for the coordinates c.
  Vector displacement(double xi, const Vector& c) const;
};

struct SingularModes {
  std::vector<ModeGroup> singular;  ///< 0 < Re < 1 - tolerance, close exponents in one group; ascending
  ModeGroup linear;                 ///< exponents within `tolerance` of 1
};

struct SingularOptions {
  double tolerance = 1e-4;  ///< exponents within this distance of 1 count as 1
  double cluster = 2e-2;    ///< exponents closer than this form one group: separate factors would be large and cancel
};

SingularModes singular_modes(const SuperElementSolution& solution, const SingularOptions& options = {});

/// The ring of an open super-element and its material.
struct Corner {
  const Ring& ring;
  const Elasticity& D;
};

/// Whether the first and the last node have the same position: the two sides of the mouth of a crack.
bool is_crack(const Ring& ring);

/// Angle of a ray from the scaling centre, counter-clockwise from the first face, 0 to `opening_angle`.
double opening_angle(const Ring& ring);  ///< angle of the material, 2 pi for a crack

/// Tractions of a group of modes on a ray: [s_tt, s_rt](r) = F (r / r0)^(T - 1) c.
struct RayTraction {
  Matrix F;         // 2 x m, force / length^2 per coordinate
  double r0 = 1.0;  ///< distance of the boundary along the ray
};
/// `angle` is measured from the first face. Eq. (2) is used at the nearest node between elements, and the angular
/// equation from there.
RayTraction ray_traction(const Corner& corner, const ModeGroup& group, double angle);

/// sqrt(2 pi r) [s_tt, s_rt] at the distance r: generalised stress intensity factors at a characteristic length (Song
/// 2010).
Vec2 generalised_factors(const RayTraction& ray, const ModeGroup& group, const Vector& c, double r);

}  // namespace scabo::element
