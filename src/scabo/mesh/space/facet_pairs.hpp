// Contact pairs of two faces in space whose facets do not match.
//
// A pair stands for a corner i of the facets of side B. Integrated over what the sides have in common, seen along a
// normal,
//
//     A_i = int phi_i dA,   motion of the pair = (1 / A_i) int phi_i (u_B - u_A) dA,   gap = (1 / A_i) int phi_i g dA
//
// so that its force over A_i is a pressure (mortar method with multipliers on side B). With psi_i, linear on triangles
// and bilinear on quadrilaterals, 1 at corner i and 0 at the others,
//
//     phi_i = psi_i                                   of ties, of plane faces, and on facets that side A covers in part
//     phi_i = (5 psi_i - 1) / 2                       on all other triangles
//     phi_i = (1 + 2 eta_i eta)(1 + 2 zeta_i zeta)/4  on all other quadrilaterals
//
// All have the sum 1 and, where quadrilaterals are parallelograms, the same integral. The first ones give the forces of
// a linear pressure exactly. The others are halfway from psi_i to the function that is orthogonal to psi_j of the other
// corners, along either coordinate; on triangles they are orthogonal to the shape function of the middle node opposite
// corner i. A force acts beside its corner, and pressures do not oscillate next to the edge of a contact. Both sides
// are divided into the triangles that they have in common. The motion of either side is a mean over nodes whose weights
// add up to 1.
//
// Plane faces with straight edges are seen along their common normal. There displacements are polynomials, the
// integrals are exact (on quadrilaterals that are no parallelograms to rounding), and forces of the pairs have the same
// resultant and moment on both sides if the faces lie on each other: a constant stress passes exactly. Of other faces
// every facet of B sees those of A along the line that bisects their normals, so that neither side is preferred, or
// along those of A where A alone is rigid; the gap is that of the quadratic surfaces, and the normal of a pair is the
// mean of these lines over its facets. Then errors are those of the curved edges, which are seen as straight.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::mesh {

struct WeightedNode {
  int node = -1;
  double weight = 1.0;
};

struct FacetPair {
  int corner = -1;                                  ///< node of side B
  std::vector<WeightedNode> a, b;                   ///< nodes of either side, ascending; the weights add up to 1
  double area = 0.0, gap = 0.0;                     ///< A_i > 0; gap > 0: open
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< (1 / A_i) int phi_i x dA, on side B
  /// Orthonormal: the normal, out of A towards B, and two tangents.
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
};

/// Some facets of a body. `mesh` must outlive it.
struct Face {
  const SolidMesh& mesh;
  std::vector<SolidFacet> facets;
  bool rigid = false;  ///< the other side takes its form
};

/// Why two faces have no pairs: one is empty, or they are plane and not parallel and opposite.
std::optional<std::string> why_no_pairs(const Face& a, const Face& b);

/// Whether `b` is the side whose corners are the pairs: the one with the smaller facets, more corners, or less even
/// facets, figures that no rotation changes; where all are equal to 1e-9, it is b.
bool has_pairs_on_second(const Face& a, const Face& b);

/// Gaps within the rounding of the coordinates are 0. A pair with less than 1e-6 of the area that its corner has on
/// side B is united with the largest one beside it. None where the sides have nothing in common.
std::vector<FacetPair> facet_pairs(const Face& a, const Face& b, bool tied = false);

}  // namespace scabo::mesh
