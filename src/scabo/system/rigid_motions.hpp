// Motions without deformation that supports and springs leave to a body.
#pragma once

#include <vector>

#include "scabo/system/body_system.hpp"

namespace scabo::system {

/// Basis of the null space of A (rows x columns), its columns orthonormal.
Matrix null_space(const Matrix& A);

/// Of the motions `free`, 3 x m, with orthonormal columns: those that change no spring's length, 3 x k, k <= m.
Matrix at_rest(const Matrix& free, const std::vector<HeldDirection>& springs, const Vec2& reference, double lever);

/// Those that springs do not resist whose stiffness along all rigid motions is S, symmetric.
Matrix at_rest(const Matrix& free, const Matrix& S);

/// Rigid motions of the nodes of a body in space as [u_x, u_y, u_z, L rotations about the axes] at the middle of the
/// box around it; L is half the diagonal of the box, so that all six are lengths.
class RigidMotionsInSpace {
 public:
  explicit RigidMotionsInSpace(const Matrix& nodes);  ///< 3 x nodes
  double lever() const { return lever_; }
  /// Displacement of one degree of freedom per unit of each motion.
  Eigen::Matrix<double, 1, 6> along(Eigen::Index dof) const;

 private:
  const Matrix& nodes_;
  Eigen::Vector3d reference_;
  double lever_;
};

}  // namespace scabo::system
