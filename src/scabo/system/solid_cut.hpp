// A body in space that is cut in two and pulled together: the section of a bolt that is tightened.
//
// The part above the cut is moved by the shortening s against the normal n, and joined to the part below again. Its
// elements see u - s n at the nodes on the cut, so that with their stiffness K_B, and c = n at these nodes and 0
// elsewhere,
//
//     E = 1/2 u'K u - s u'f_c + 1/2 s^2 k,   f_c = K_B c,   k = c'K_B c
//
// s f_c are nodal forces, without resultant and moment, and dE/ds = s k - u'f_c is the tension in the cut. The cut goes
// along sides of elements, which need not lie in the plane: both parts are moved as a whole.
#pragma once

#include "scabo/element/space/solid_cell.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::system {

struct SolidCut {
  std::vector<char> above;  ///< of each cell: whether its centroid is above the plane
  std::vector<char> on;     ///< of each node: whether it belongs to cells on both sides
  Eigen::Vector3d normal;
  Vector forces;           ///< f_c
  double stiffness = 0.0;  ///< k; 0: the plane does not cut the body

  double tension(double shortening, const Vector& u) const { return shortening * stiffness - u.dot(forces); }
  /// What a shortening adds to 1/2 u'K u.
  double energy(double shortening, const Vector& u) const {
    return shortening * (0.5 * shortening * stiffness - u.dot(forces));
  }
};

/// `normal`: of length 1. `solved`: super-elements of the body.
SolidCut cut_of(const mesh::SolidMesh& mesh, const element::Mat6& D, const Eigen::Vector3d& point,
                const Eigen::Vector3d& normal, const element::SuperElements& solved = {});

}  // namespace scabo::system
