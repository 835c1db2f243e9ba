// Stress of a body before it deforms (model::UniformStress, model::GroundStress), linear in x and y.
//
// The stress of a body is sigma0 + D eps(u): u and the energies are those of the change from the undisturbed body.
#pragma once

#include "scabo/element/facet/radial_load.hpp"
#include "scabo/element/plane/elasticity.hpp"

namespace scabo::element {

struct InitialStress {
  /// [xx, yy, xy]: constant, per x, per y.
  Vec3 constant = Vec3::Zero(), per_x = Vec3::Zero(), per_y = Vec3::Zero();
  /// The part of it whose out-of-plane stress follows the law of the material, as in plane strain; that of the rest is
  /// `zz`.
  Vec3 plain_constant = Vec3::Zero();
  LinearField zz;

  Vec3 at(const Vec2& x) const { return constant + x.x() * per_x + x.y() * per_y; }
  double zz_at(const Vec2& x, const model::Material& material, model::Plane plane) const;
  bool is_zero() const { return constant.isZero(0.0) && per_x.isZero(0.0) && per_y.isZero(0.0) && zz.is_zero(); }
  void add(const InitialStress& other, double factor);
};

/// Traction n sigma of a stress [xx, yy, xy] on a side with the outward normal n.
inline Vec2 traction_of(const Vec3& stress, const Vec2& n) {
  return {stress[0] * n.x() + stress[2] * n.y(), stress[2] * n.x() + stress[1] * n.y()};
}

InitialStress initial_stress(const model::UniformStress& uniform);
InitialStress initial_stress(const model::GroundStress& ground);

}  // namespace scabo::element
