// An open super-element whose side faces are held as a whole: its stiffness, its exponents, and its mirror image.
//
// A face that is held along a unit vector d moves with one displacement along d, that of its node on the boundary. With
// u = R a + v, R the translations, a follows from the held components h(u) = A a of the end nodes of the faces, and
// d.v = 0 on them. The shape functions of v are those without these components, so that the scaled boundary equation
// has E0, E1, E2 without their rows and columns (T: columns of the free components), and
//
//     K = P' K_v P,   P = T' (1 - R A^-1 h)                                                                       (1)
//
// K_v is the stiffness of ring doubling (ring_doubling.hpp). One held direction leaves the translation along the face
// at right angles to it, t = T'R d_perp, which carries no force and is removed first, as in stiffness.hpp, eq. (4). The
// force of K on a held component is the resultant of the reaction of its face.
//
// K is exact for faces that are held in one direction or two that differ. Where more is held, a does not follow from
// it, and only the exponents are computed: those of a field that is 0 on the faces.
//
// Known: a wedge of angle w, one face fixed and the other free, plane strain: sin^2(lambda w) = (4 (1 - nu)^2 -
// lambda^2 sin^2 w) / (3 - 4 nu) (Williams 1952); fixed only along its normal and free of shear, it is half of a wedge
// of 2 w between free faces.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "scabo/element/facet/radial_load.hpp"

namespace scabo::element {

struct HeldSolution {
  std::optional<Matrix> K;  // n x n, symmetric; nothing if more is held than eq. (1) takes
  double rounding = 0.0;    ///< as SuperElementSolution::rounding
  /// All exponents, ascending real part: 0 for a translation that remains, then those of v.
  std::vector<std::complex<double>> exponents;
};

/// Throws IllPosed as solve_super_element() does.
HeldSolution solve_held(const Ring& ring, const Elasticity& D, double thickness, const mesh::HeldFaces& held);

/// A super-element and its reflection across one of its side faces, as one open super-element.
struct Mirrored {
  Ring ring;
  Elasticity D;
  Mat2 reflection = Mat2::Identity();
  std::vector<int> own, image;  ///< node of the union of each node, and of its image

  Vector displacement(const Vector& u) const;  ///< of the union, 2 components a node
  std::vector<RadialLoad> loads(const std::vector<RadialLoad>& loads) const;
};

/// `normal`: unit normal of the face. An image whose faces meet at 360 degrees closes to a crack exactly.
Mirrored with_image(const Ring& ring, const Elasticity& D, Face face, const Vec2& normal);

}  // namespace scabo::element
