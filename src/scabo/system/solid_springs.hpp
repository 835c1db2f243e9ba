// Springs between a body in space and the ground. Their forces on the body are -S u.
#pragma once

#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::system {

struct SolidSpring {
  linalg::SparseMatrix on_nodes;  ///< 3n x 3n
  /// Of a rigid body as a whole, in addition along diag(stiffness) along'.
  Matrix along = Matrix();  ///< 3n x 3: nodal forces of a force of size 1 along each axis at its centroid
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();

  Matrix times(const Matrix& u) const;
};

/// On facets, force / length^3 along their normals and along them.
SolidSpring springs_on_facets(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets, double k_n,
                              double k_t);
/// At every one of these nodes, force / length along the axes.
SolidSpring springs_at_nodes(const mesh::SolidMesh& mesh, const std::vector<int>& nodes, const Eigen::Vector3d& k);
/// At the centroid of a rigid body.
SolidSpring springs_at_centroid(const mesh::SolidMesh& mesh, const Eigen::Vector3d& k);

}  // namespace scabo::system
