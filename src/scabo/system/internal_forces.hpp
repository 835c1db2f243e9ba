// Forces by which an elastic body and its springs resist a displacement u of its nodes, (K + S) u.
//
// Rounding of K u is that of the largest displacement. The rigid motions of a bounded body, which K does not resist,
// are therefore taken out of u: translations in working precision, the rotation as well in twice that precision. Of
// large bodies K u is computed from differences of displacements (differences.hpp), exact but for the rounding of u.
#pragma once

#include <vector>

#include "scabo/system/stiffness.hpp"

namespace scabo::system {

/// Rigid motions of the nodes of a body, two components for each node: the translations, and the rotation about the
/// mean of the nodes, which is orthogonal to them. `revolved`: of a body of revolution, the motion along its axis
/// alone.
class NodalRigidMotions {
 public:
  explicit NodalRigidMotions(const std::vector<Vec2>& nodes, bool revolved = false);

  /// By sums in twice the working precision: those of half a million forces of weight lose 1e-10 of the largest
  /// otherwise.
  void take_out_of(linalg::TwofoldVector& v) const;
  /// In working precision, for estimates.
  Vector taken_out_of(Vector u) const;
  /// Resultant of forces along x and y, and their moment about the mean of the nodes.
  Eigen::Vector3d resultants_of(const Vector& forces) const;

 private:
  linalg::TwofoldVector turn_;  // displacements by a unit rotation
  linalg::Twofold turn_square_;
  bool revolved_;
};

/// Whether a solve takes so long that one less counts.
bool is_large(const Stiffness& stiffness);

/// Whether K u comes from differences of displacements: in working precision it is then exact but for the rounding of
/// u.
bool by_differences(const Stiffness& stiffness);

/// (K + S) u, without the part that a translation of the whole body would add to K u by rounding.
Vector internal_forces(const Stiffness& stiffness, const NodalRigidMotions& motions, Vector u);

/// How K u is computed.
enum class Product { twofold, by_differences };

/// (K + S) u - f, in twice the working precision or by differences, which also give the `rounding` of a force. Bounded
/// bodies: P K P for K, where P takes the rigid motions out; K itself resists them by what rounding its entries left,
/// which is the same in all of many equal elements, and forces that come from rounding have no resultant this way.
Vector forces_left(const Stiffness& stiffness, const NodalRigidMotions& motions, linalg::TwofoldVector u,
                   const Vector& f, Product product = Product::twofold, double* rounding = nullptr);

}  // namespace scabo::system
