#include "scabo/system/differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/base/components.hpp"

namespace scabo::system {

namespace {

double difference(const linalg::Twofold& a, const linalg::Twofold& b) { return (a.high - b.high) + (a.low - b.low); }

}  // namespace

ForcesByDifferences forces_by_differences(const linalg::SparseMatrix& K, const linalg::TwofoldVector& u) {
  ForcesByDifferences result{Vector(K.cols()), 0.0};
  const int *const first = K.outerIndexPtr(), *const rows = K.innerIndexPtr();
  const double* const values = K.valuePtr();
  double largest = 0.0;
  for (Eigen::Index column = 0; column < K.cols(); ++column) {  // K is symmetric: rows are columns
    const auto node = static_cast<std::size_t>(plane_components.first_of_node(column));
    const linalg::Twofold own_x = u[node], own_y = u[node + 1];
    double by_x = 0.0, by_y = 0.0, size_x = 0.0, size_y = 0.0;  // separate sums do not wait for each other
    const int end = first[column + 1];
    for (int k = first[column]; k < end; ++k) {
      const auto row = static_cast<std::size_t>(rows[k]);
      if (row % 2 == 0) {
        const double force = values[k] * difference(u[row], own_x);
        by_x += force;
        size_x += std::abs(force);
        if (k + 1 == end || rows[k + 1] != rows[k] + 1) continue;
        ++k;
      }
      const std::size_t y = static_cast<std::size_t>(plane_components.first_of_node(rows[k])) + 1;
      const double force = values[k] * difference(u[y], own_y);
      by_y += force;
      size_y += std::abs(force);
    }
    result.forces[column] = by_x + by_y;
    largest = std::max(largest, size_x + size_y);
  }
  result.rounding = std::numeric_limits<double>::epsilon() * largest;
  return result;
}

}  // namespace scabo::system
