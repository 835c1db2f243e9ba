#include "scabo/element/plane/initial_stress.hpp"

namespace scabo::element {

double InitialStress::zz_at(const Vec2& x, const model::Material& material, model::Plane plane) const {
  if (plane == model::Plane::stress) return 0.0;
  const double given = zz.at(x);
  return plain_constant.isZero(0.0) ? given : given + stress_zz(plain_constant, material, plane);
}

void InitialStress::add(const InitialStress& other, double factor) {
  constant += factor * other.constant;
  per_x += factor * other.per_x;
  per_y += factor * other.per_y;
  plain_constant += factor * other.plain_constant;
  zz.constant += factor * other.zz.constant;
  zz.per_x += factor * other.zz.per_x;
  zz.per_y += factor * other.zz.per_y;
}

InitialStress initial_stress(const model::UniformStress& uniform) {
  InitialStress stress;
  stress.constant = Vec3(uniform.value[0], uniform.value[1], uniform.value[2]);
  if (uniform.zz)
    stress.zz.constant = *uniform.zz;
  else
    stress.plain_constant = stress.constant;
  return stress;
}

InitialStress initial_stress(const model::GroundStress& ground) {
  // Along up: -(surcharge + unit_weight (surface - up . x)); K0 times that across, in the plane and out of it.
  const Vec2& up = ground.up;
  const Vec3 upright(up.x() * up.x(), up.y() * up.y(), up.x() * up.y());
  const Vec3 pattern = (1.0 - ground.K0) * upright + ground.K0 * Vec3(1.0, 1.0, 0.0);
  const double at_origin = -(ground.surcharge + ground.unit_weight * ground.surface);
  InitialStress stress;
  stress.constant = at_origin * pattern;
  stress.per_x = ground.unit_weight * up.x() * pattern;
  stress.per_y = ground.unit_weight * up.y() * pattern;
  stress.zz = {ground.K0 * at_origin, ground.K0 * ground.unit_weight * up.x(), ground.K0 * ground.unit_weight * up.y()};
  return stress;
}

}  // namespace scabo::element
