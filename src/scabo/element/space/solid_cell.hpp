// Cells of bodies in space of either kind: tetrahedra as finite elements (tetrahedron.hpp), hexahedra and wedges as
// super-elements (solid_super_element.hpp).
#pragma once

#include <memory>
#include <vector>

#include "scabo/element/space/solid_super_element.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::element {

/// Of one elastic body, for each cell; null for tetrahedra. Empty: there are tetrahedra only.
using SuperElements = std::vector<std::shared_ptr<const SolidSuperElement>>;

/// Each distinct super-element once: equal ones differ by a translation, and by the rounding of their coordinates. They
/// are visible from their centres (least_of_cell).
SuperElements solve_super_elements(const mesh::SolidMesh& mesh, const Mat6& D, int threads = 1);

inline const SolidSuperElement* super_element_of(const SuperElements& solved, std::size_t cell) {
  return solved.empty() ? nullptr : solved[cell].get();
}

/// Positive: the cell has a stiffness. Of a tetrahedron least_jacobian, of a super-element least_visibility.
double least_of_cell(const Matrix& nodes);

/// K, 3n x 3n. `solved`: null for a tetrahedron.
Matrix cell_stiffness(const Matrix& nodes, const Mat6& D, const SolidSuperElement* solved);

/// int N dV, n numbers, of the cell as part of a rigid body.
Vector cell_volume_weights(const Matrix& nodes);

/// What acts inside the cells of a body.
struct InsideCells {
  Eigen::Vector3d per_volume = Eigen::Vector3d::Zero();  ///< force per volume
  Vector heated = {};  ///< change of temperature of the nodes of the body, linear in the coordinates; empty: none
  Vec6 stress = Vec6::Zero();  ///< that a change of 1 causes where strains are 0, compression positive
};
/// Of a super-element.
SolidCellLoads loads_in_cell(const Matrix& nodes, const SolidSuperElement& cell, const std::vector<int>& numbers,
                             const InsideCells& inside);

}  // namespace scabo::element
