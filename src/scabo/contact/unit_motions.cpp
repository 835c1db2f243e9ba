#include "scabo/contact/unit_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scabo::contact {

namespace {

/// The factors that bring the largest entry of every column into [1, 2); 1 for a column of zeros, or of numbers so
/// small that the factor would be infinite.
Vector units_of(const RigidMap& G) {
  Vector unit = Vector::Ones(G.cols());
  for (Eigen::Index k = 0; k < G.cols(); ++k) {
    double largest = 0.0;
    for (RigidMap::Sparse::InnerIterator at(G.sparse(), k); at; ++at) largest = std::max(largest, std::abs(at.value()));
    if (largest >= std::numeric_limits<double>::min() && std::isfinite(largest))
      unit[k] = std::ldexp(1.0, -std::ilogb(largest));
  }
  return unit;
}

}  // namespace

UnitMotions in_unit_motions(const Problem& problem, const Start& start) {
  UnitMotions scaled{problem, start, units_of(problem.G)};
  if ((scaled.unit.array() == 1.0).all()) return scaled;
  scaled.problem.G = RigidMap(RigidMap::Sparse(problem.G.sparse() * scaled.unit.asDiagonal()));
  scaled.problem.f = scaled.unit.cwiseProduct(problem.f);
  if (start.a.size() == scaled.unit.size()) scaled.start.a = start.a.cwiseQuotient(scaled.unit);
  return scaled;
}

Solution UnitMotions::given(Solution solution) const {
  if (solution.a.size() == unit.size()) solution.a = unit.cwiseProduct(solution.a);
  if (solution.motion.size() == unit.size() && unit.size() > 0)
    solution.motion = unit.cwiseProduct(solution.motion).normalized();
  if (solution.undetermined.rows() == unit.size()) solution.undetermined = unit.asDiagonal() * solution.undetermined;
  return solution;
}

}  // namespace scabo::contact
