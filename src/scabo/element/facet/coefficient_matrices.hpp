// The coefficient matrices of a super-element. They represent its geometry and material in the scaled boundary equation
//
//     E0 xi^2 u,xixi + (E0 - E1 + E1') xi u,xi - E2 u = 0                            (Zhu 2017, eq. 1)
//
// The material may differ from boundary element to boundary element: each spans a sector of its own. With the boundary
// point x_b(eta) = N(eta) x relative to the scaling centre,
//
//     |J| = x y,eta - y x,eta > 0
//     b1 = 1/|J| [[ y,eta, 0], [0, -x,eta], [-x,eta, y,eta]],   b2 = 1/|J| [[-y, 0], [0, x], [x, -y]]
//     B1 = b1 N,  B2 = b2 N,eta,  strain = B1 u,xi + 1/xi B2 u
//     E0 = int B1' D B1 |J| deta,  E1 = int B2' D B1 |J| deta,  E2 = int B2' D B2 |J| deta
#pragma once

#include <Eigen/SparseCore>

#include "scabo/element/facet/strain_vectors.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::element {

/// The boundary of a super-element relative to its scaling centre: closed around the centre, or open if the
/// super-element has side faces (a crack, a notch, a corner). Side faces are straight lines from the centre to the
/// first and to the last node. The two faces of a crack coincide: its first and last node have the same position.
struct Ring {
  std::vector<Vec2> nodes;                  ///< relative to the scaling centre, counter-clockwise
  std::vector<mesh::LineElement> elements;  ///< each begins where the one before ends
  bool is_open() const { return elements.front().nodes.front() != elements.back().nodes.back(); }
  const Vec2& node(int i) const { return nodes[static_cast<std::size_t>(i)]; }
  int first_node() const { return elements.front().nodes.front(); }
  int last_node() const { return elements.back().nodes.back(); }
};

/// Elasticity of the sectors spanned by the boundary elements: one matrix for all of them, or one for each.
class Elasticity {
 public:
  Elasticity() = default;
  Elasticity(const Mat3& everywhere) : D_{everywhere} {}
  Elasticity(std::vector<Mat3> of_elements) : D_(std::move(of_elements)) {}

  const Mat3& of(std::size_t element) const { return D_.size() == 1 ? D_.front() : D_[element]; }
  std::size_t size() const { return D_.size(); }
  bool fits(const Ring& ring) const { return D_.size() == 1 || D_.size() == ring.elements.size(); }
  /// Ratio of the stiffnesses (trace of D) of the stiffest and the softest sector.
  double contrast() const;
  bool operator==(const Elasticity&) const = default;

 private:
  std::vector<Mat3> D_;  // force / length^2
};

/// The boundary of a cell with its own node numbers (mesh::Cell::nodes()). `nodes`: those of the body.
Ring ring_of(const mesh::Cell& cell, const std::vector<Vec2>& nodes);

/// Strain at a boundary point: strain = B1 u,xi + 1/xi B2 u, with the 2 (p + 1) displacements of its element.
struct StrainMatrices {
  Eigen::Matrix<double, 3, Eigen::Dynamic> B1, B2;
  double J = 0.0;  ///< |J|, length^2
};
StrainMatrices strain_matrices(const Ring& ring, const mesh::LineElement& element, const Vector& N,
                               const Vector& N_eta);

template <typename Real>
struct CoefficientMatricesOf {
  Eigen::SparseMatrix<Real> E0, E1, E2;  // n x n, n = 2 nodes
};
using CoefficientMatrices = CoefficientMatricesOf<double>;
using ExactCoefficientMatrices = CoefficientMatricesOf<long double>;

/// All three are multiplied by `thickness`. Throws IllPosed, with the number of the boundary element, if an element has
/// no length or is not entirely visible from the centre (|J| <= 0), or if its elasticity is not positive definite.
CoefficientMatrices coefficient_matrices(const Ring& ring, const Elasticity& D, double thickness);

/// The same with 64-bit significands, at the points of the same quadrature: E1'R = 0 and E2 R = 0 for translations R,
/// and no strain under rotation, hold to as many digits.
ExactCoefficientMatrices exact_coefficient_matrices(const Ring& ring, const Elasticity& D, double thickness);

/// Position of a boundary point and its derivative along eta, by values and derivatives of the shape functions.
struct BoundaryPoint {
  Vec2 x = Vec2::Zero(), x_eta = Vec2::Zero();
  double jacobian() const { return cross(x, x_eta); }  ///< |J|
};
BoundaryPoint boundary_point(const Ring& ring, const mesh::LineElement& element, const Vector& N, const Vector& N_eta);

}  // namespace scabo::element
