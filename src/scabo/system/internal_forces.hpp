// Forces by which an elastic body and its springs resist a displacement u of its nodes, (K + S) u.
//
// Rounding of K u is that of the largest displacement. The rigid motions of a bounded body, which K does not resist,
// are therefore taken out of u: translations in working precision, the rotation as well in twice that precision. Of
// large bodies K u is computed from differences of displacements (differences.hpp), exact but for the rounding of u.
#pragma once

#include <vector>

#include "scabo/system/positions.hpp"
#include "scabo/system/stiffness.hpp"

namespace scabo::system {

/// Rigid motions of the nodes of a body, in the plane or in space: the translations, and rotations about the mean of
/// the nodes (one, or three), which are orthogonal to them and to each other. `revolved`: of a body of revolution, the
/// motion along its axis alone.
class NodalRigidMotions {
 public:
  explicit NodalRigidMotions(const Positions& nodes, bool revolved = false);
  const Components& components() const { return components_; }

  /// By sums in twice the working precision: those of half a million forces of weight lose 1e-10 of the largest
  /// otherwise.
  void take_out_of(linalg::TwofoldVector& v) const;
  /// In working precision, for estimates.
  Vector taken_out_of(Vector u) const;
  /// Resultant of forces along the axes, and what they do in the rotations: their moment about the mean of the nodes.
  Vector resultants_of(const Vector& forces) const;

 private:
  struct Rotation {
    linalg::TwofoldVector turn;  // displacements by it
    linalg::Twofold square;
  };
  template <int d>
  void take_out(linalg::TwofoldVector& v) const;
  template <int d>
  Vector taken_out(Vector u) const;

  Components components_;
  bool revolved_;
  std::vector<Rotation> rotations_;
};

/// Whether a solve takes so long that one less counts.
bool is_large(const Stiffness& stiffness);

/// Whether K u comes from differences of displacements (in the plane): in working precision it is then exact but for
/// the rounding of u.
bool by_differences(const Stiffness& stiffness, const NodalRigidMotions& motions);

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
