// Hexahedra with 20 nodes and wedges with 15 in space as scaled boundary super-elements.
//
// The scaling centre x_c is the mean of the corners. With a place (eta, zeta) on a facet of the boundary (facet.hpp)
// and x_b(eta, zeta) relative to the centre, x = x_c + xi x_b and
//
//     |J| = x_b . (x,eta x x,zeta) > 0
//     g1 = (x,eta x x,zeta) / |J|,   g2 = (x,zeta x x_b) / |J|,   g3 = (x_b x x,eta) / |J|
//     B1 = L(g1) N,   B2 = L(g2) N,eta + L(g3) N,zeta,   strain = B1 u,xi + 1/xi B2 u
//
// L(g) v being the strain of the gradient v g'. E0, E1 and E2 follow as in the plane. The energy has the factor xi more
// than there; with u = xi^(-1/2) v it is that of a super-element of the plane with
//
//     E0^ = E0,   E1^ = E1 - E0/2,   E2^ = E2 - (E1 + E1')/2 + E0/4                                          (1)
//
// and of these ring doubling gives K, whose exponents are S^ = E0^-1 (K - E1^'), so that xi u,xi = S u with S = S^ -
// 1/2. None of those of S^ is 0: the translations have 1/2. K is made to leave the six rigid motions without any force.
//
// The result is a SuperElementSolution with one block, whose three translations are apart. Loads of power j,
//
//     q = E0 xi u,xi + E1' u - xi^j c,    q + xi q,xi = E1 xi u,xi + E2 u - xi^j g                           (2)
//
// have the nodal forces (S' + j + 1) h = S' c + g, and xi u,xi = S u + xi^j E0^-1 (c - h): the inside is that of a
// super-element of the plane with the load g - h in place of g.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "scabo/element/sbfem/modal_solution.hpp"
#include "scabo/element/space/tetrahedron.hpp"

namespace scabo::element {

/// E0, E1, E2: 3n x 3n.
struct SolidCoefficients {
  Matrix E0, E1, E2;
};
SolidCoefficients solid_coefficients(const Matrix& nodes, const Mat6& D);

/// Where the boundary is seen least from the centre: the least |J| over the lengths of both of its factors, at places
/// of the facets. Positive: the cell has a solution.
double least_visibility(const Matrix& nodes);

/// One cell. `nodes`: 3 x 15 or 20, as in CellTopology.
class SolidSuperElement {
 public:
  /// Throws IllPosed if part of the boundary is not seen from the centre.
  SolidSuperElement(const Matrix& nodes, const Mat6& D);

  const Matrix& K() const { return solution_.K; }  ///< 3n x 3n, symmetric
  const SuperElementSolution& solution() const { return solution_; }
  const ModalSolution& modes() const;  ///< computed when it is first needed; safe for several threads

 private:
  SuperElementSolution solution_;
  mutable std::once_flag modes_flag_;
  mutable std::unique_ptr<const ModalSolution> modes_;
};

/// Loads inside a cell, and their nodal forces h.
struct SolidCellLoads {
  std::vector<RadialLoad> inside;  ///< of the super-element of the plane
  Vector h;                        ///< 3n; empty: none

  void add(const SolidCellLoads& others);
};
/// Of a force per volume.
SolidCellLoads loads_of_volume_force(const Matrix& nodes, const SolidSuperElement& cell,
                                     const Eigen::Vector3d& per_volume);
/// Of a stress times T, which is linear between the centre and the boundary and has a value at every node; h: the
/// forces that hold the nodes are -h.
SolidCellLoads loads_of_stress(const Matrix& nodes, const SolidSuperElement& cell, const Vec6& stress, const Vector& T);

/// int N dV, with functions that are linear from the centre to the boundary and at the centre the mean of the corners.
Vector super_element_volume_weights(const Matrix& nodes);
/// int T^2 dV of T as of loads_of_stress.
double super_element_integral_of_square(const Matrix& nodes, const Vector& T);
/// Work of loads on the motion that they cause inside while the nodes are held.
double work_inside(const SolidSuperElement& cell, const SolidCellLoads& loads);

/// A place in a cell: xi (eta, zeta, 1) of the pyramid over a facet, so that straight lines remain straight.
struct PyramidPlace {
  int facet = -1;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();

  double xi() const { return at.z(); }
};
/// None if the point lies outside of the cell by more than `allowed` of its size.
std::optional<PyramidPlace> place_in_super_element(const Matrix& nodes, const Eigen::Vector3d& point, double allowed);

/// Of a function with values at the nodes that is linear between the centre, where it is the mean of the corners, and
/// the boundary.
double value_in_super_element(const Matrix& nodes, const Vector& values, const PyramidPlace& place);

/// The field inside a cell whose nodes have the displacements u under loads: by the modes at twelve values of xi, those
/// of Chebyshev in its square root, and between them by the polynomial of that root, which is within some 1e-4 of what
/// the modes vary.
class SolidInterior {
 public:
  SolidInterior(const Matrix& nodes, const SolidSuperElement& cell, const Vector& u, const SolidCellLoads& loads = {});

  Eigen::Vector3d displacement_at(const PyramidPlace& place) const;
  Vec6 strain_at(const PyramidPlace& place) const;

 private:
  Matrix nodes_;
  Matrix u_, u_xi_, u_part_;  // RadialField::Values, a column for each xi
};

/// Strains at the nodes, 6 x n: the mean of those on all facets that have a node.
Matrix strains_at_nodes(const Matrix& nodes, const SolidSuperElement& cell, const Vector& u,
                        const SolidCellLoads& loads = {});

}  // namespace scabo::element
