// The coefficient matrices of a super-element: everything the scaled boundary equation
//
//     E0 xi^2 u,xixi + (E0 - E1 + E1') xi u,xi - E2 u = 0                            (Zhu 2017, eq. 1)
//
// knows of geometry and material. With the boundary point x_b(eta) = N(eta) x relative to the scaling centre,
//
//     |J| = x y,eta - y x,eta > 0
//     b1 = 1/|J| [[ y,eta, 0], [0, -x,eta], [-x,eta, y,eta]],   b2 = 1/|J| [[-y, 0], [0, x], [x, -y]]
//     B1 = b1 N,  B2 = b2 N,eta,  strain = B1 u,xi + 1/xi B2 u
//     E0 = int B1' D B1 |J| deta,  E1 = int B2' D B1 |J| deta,  E2 = int B2' D B2 |J| deta
#pragma once

#include <Eigen/SparseCore>

#include "scabo/element/elasticity.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::element {

/// The boundary of a super-element as its scaling centre sees it.
struct Ring {
  std::vector<Vec2> nodes;                  ///< relative to the scaling centre, counter-clockwise
  std::vector<mesh::LineElement> elements;  ///< closed
};

Ring ring_of(const mesh::SuperElement& super_element, const std::vector<Vec2>& nodes);

/// Strain of one boundary point: strain = B1 u,xi + 1/xi B2 u over the 2 (p + 1) displacements of its element.
struct StrainMatrices {
  Eigen::Matrix<double, 3, Eigen::Dynamic> B1, B2;
  double J = 0.0;  ///< |J|, length^2
};
StrainMatrices strain_matrices(const Ring& ring, const mesh::LineElement& element, const Vector& N,
                               const Vector& N_eta);

struct CoefficientMatrices {
  Eigen::SparseMatrix<double> E0, E1, E2;  // n x n, n = 2 nodes
};

/// `D` is force / length^2; `thickness` multiplies all three. Throws BrokenInvariant when |J| <= 0: the mesh has
/// made sure that the centre sees the whole boundary.
CoefficientMatrices coefficient_matrices(const Ring& ring, const Mat3& D, double thickness);
/// The same with the plane law of every boundary element, or one for all.
CoefficientMatrices coefficient_matrices(const Ring& ring, const std::vector<Mat3>& D, double thickness);

/// int N |J| deta for every node: with a body force b (force / length^3) times thickness, the term xi^2 F_b of the
/// scaled boundary equation. Sums to twice the area.
Vector body_load_weights(const Ring& ring);

}  // namespace scabo::element
