#include "scabo/element/elasticity.hpp"

namespace scabo::element {

Mat3 elasticity_matrix(const model::Material& material, model::Plane plane) {
  const double E = material.young, nu = material.poisson;
  Mat3 D = Mat3::Zero();
  if (plane == model::Plane::stress) {
    const double c = E / (1.0 - nu * nu);
    D << c, c * nu, 0.0, c * nu, c, 0.0, 0.0, 0.0, E / (2.0 * (1.0 + nu));
  } else {
    const double c = E / ((1.0 + nu) * (1.0 - 2.0 * nu));
    D << c * (1.0 - nu), c * nu, 0.0, c * nu, c * (1.0 - nu), 0.0, 0.0, 0.0, E / (2.0 * (1.0 + nu));
  }
  return D;
}

Vec3 thermal_strain(const model::Material&, model::Plane) { return Vec3::Zero(); }

double stress_zz(const Vec3& stress, const model::Material& material, model::Plane plane, double) {
  return plane == model::Plane::strain ? material.poisson * (stress[0] + stress[1]) : 0.0;
}

}  // namespace scabo::element
