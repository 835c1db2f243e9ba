// Open super-elements (cracks, notches, corners) for tests, and exact fields around a crack tip.
#pragma once

#include <complex>
#include <numbers>

#include "theory/rings.hpp"

namespace scabo::test {

/// Chain of straight edges vertices[0] -> vertices[1] -> ...; edge i is divided into elements that end at the given
/// fractions of its length (all of them: the last is 1).
element::Ring open_ring(const std::vector<Vec2>& vertices, const std::vector<std::vector<double>>& ends, int order);

std::vector<double> equal_parts(int count);

element::Ring open_ring(const std::vector<Vec2>& vertices, int divisions, int order);

element::Ring open_ring(const std::vector<Vec2>& vertices, const std::vector<int>& divisions, int order);

Vec2 turned(const Vec2& x, double angle);

/// Square of side 2 around a crack tip at the origin, mouth at (-1, 0) turned by `angle`; the boundary has a node ahead
/// of the tip.
element::Ring cracked_square(int divisions, int order, double angle = 0.0, double size = 1.0);

/// A corner of the material angle `opening`, first face along `first`: elements of equal angle on the unit circle's
/// polygon, with a node at every angle of `marks` (from the first face).
element::Ring sector_ring(double first, double opening, std::vector<double> marks, double longest, int order);

/// Angle of every element's middle from the first face: to choose its material.
std::vector<double> middle_angles(const element::Ring& ring);

/// Values at the nodes of a field given in the crack's frame by distance and angle, -pi on the right face, pi on the
/// left.
template <typename Field>
Vector around_tip(const element::Ring& ring, Field field) {
  Vector u(static_cast<Eigen::Index>(2 * ring.nodes.size()));
  const double zero = std::atan2(-ring.nodes.front().y(), -ring.nodes.front().x());  // of x1
  double angle = -std::numbers::pi;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    if (i > 0) angle += std::atan2(cross(ring.nodes[i - 1], ring.nodes[i]), ring.nodes[i - 1].dot(ring.nodes[i]));
    const double theta = i + 1 == ring.nodes.size() ? std::numbers::pi : angle;
    u.segment<2>(static_cast<Eigen::Index>(2 * i)) = turned(field(ring.nodes[i].norm(), theta), zero);
  }
  return u;
}

/// Isotropic material of the plane: shear modulus and Kolosov's constant.
struct Kolosov {
  double mu, kappa, young, poisson;  // young and poisson of the plane: E', nu'
  Kolosov(double E, double nu, model::Plane plane)
      : mu(E / (2 * (1 + nu))),
        kappa(plane == model::Plane::strain ? 3 - 4 * nu : (3 - nu) / (1 + nu)),
        young(plane == model::Plane::strain ? E / (1 - nu * nu) : E),
        poisson(plane == model::Plane::strain ? nu / (1 - nu) : nu) {}
};

/// Williams' terms of K_I, K_II and T (closed form).
Vec2 williams(const Kolosov& m, double K_I, double K_II, double T, double r, double t);

/// Sih, Paris, Irwin (1965): K_I, K_II in an anisotropic plane of compliance a in the crack's frame; distinct roots.
Vec2 sih_paris_irwin(const element::Mat3& a, double K_I, double K_II, double r, double t);

/// Oscillation index between isotropic halves (Hutchinson, Suo 1992).
double interface_epsilon(const Kolosov& above, const Kolosov& below);

/// Interface crack between isotropic halves, s22 + i s12 = (K_I + i K_II) (r/l)^(i epsilon) / sqrt(2 pi r) ahead, plus
/// the strain e11 of a T-stress. By Muskhelishvili's potentials: 2 mu (u + i v) = kappa phi(z) - omega(zbar) - (z -
/// zbar) conj(phi'(z)), with phi_1' = omega_2' = a z^s above, omega_1' = phi_2' = a e^(2 pi epsilon) z^s below, s =
/// -1/2 - i epsilon.
Vec2 interface_crack(const Kolosov& above, const Kolosov& below, std::complex<double> K, double l, double e11, double r,
                     double t);

}  // namespace scabo::test
