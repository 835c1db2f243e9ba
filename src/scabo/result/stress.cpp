#include "scabo/result/stress.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::result {

StressMeasures stress_measures(const element::Vec3& stress, double zz) {
  const double mean = 0.5 * (stress[0] + stress[1]);
  const double half_difference = 0.5 * (stress[0] - stress[1]);
  const double radius = std::hypot(half_difference, stress[2]);  // radius of Mohr's circle
  StressMeasures measures;
  const double larger = mean + radius, smaller = mean - radius;
  const double s1 = std::max(larger, zz), s3 = std::min(smaller, zz);
  const double s2 = std::max(std::min(larger, zz), smaller);
  measures.principal = {s1, s2, s3};
  measures.angle = 0.5 * std::atan2(stress[2] + 0.0, half_difference + 0.0);  // + 0.0: no direction of -0
  measures.von_mises = std::sqrt(0.5 * ((s1 - s2) * (s1 - s2) + (s2 - s3) * (s2 - s3) + (s3 - s1) * (s3 - s1)));
  return measures;
}

}  // namespace scabo::result
