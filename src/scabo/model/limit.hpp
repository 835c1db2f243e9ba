// A step that looks for the largest loads, or the smallest friction, with which there still is equilibrium
// (analysis/march/limit.hpp).
#pragma once

#include <vector>

namespace scabo::model {

/// The factor begins with that of the loads at the end of the step before, and is theirs; or with 1, and the friction
/// of the contacts is divided by it.
struct LimitStep {
  std::vector<char> loads;     ///< for each of the model: the factor is that of the load; all begin alike
  std::vector<char> friction;  ///< for each contact of the model: its friction is divided; none if there are loads
  std::vector<char> cohesion;  ///< the same of its lasting cohesion
  double relative = 1e-3;      ///< width of the bracket beside the factor, 1e-9 to 0.5
};

}  // namespace scabo::model
