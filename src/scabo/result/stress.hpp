// Measures of a state of stress: principal stresses, their direction, and the equivalent stress of von Mises. Tension
// is positive.
#pragma once

#include <array>

#include "scabo/element/plane/elasticity.hpp"

namespace scabo::result {

/// Measures of the stress [xx, yy, xy] with the out-of-plane stress zz.
struct StressMeasures {
  std::array<double, 3> principal{};  ///< in three dimensions, descending: the first is the largest tension
  double angle = 0.0;                 ///< radians from x, -pi/2 to pi/2: direction of the larger in-plane stress
  double von_mises = 0.0;             ///< sqrt(((s1 - s2)^2 + (s2 - s3)^2 + (s3 - s1)^2) / 2)
};

StressMeasures stress_measures(const element::Vec3& stress, double zz);

}  // namespace scabo::result
