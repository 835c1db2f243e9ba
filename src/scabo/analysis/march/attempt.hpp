// An attempt to reach the end of an increment, or of a part of it: what a scheme returns, accepted or not.
#pragma once

#include <optional>
#include <string>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// With its certificate.
struct Attempt {
  State state;
  contact::Solution solution;
  contact::Certificate certificate;
  double rounding = 0.0;  ///< possible share of rounding of the displacements in equilibrium and rigid balance
  std::string beyond;     ///< why a solution contradicts small displacements (beyond_sides.hpp) or the displacements of
                          ///< its bodies (softly_held.hpp); else empty
  bool lost = false;      ///< in rounding, whatever part of the loads acts (softly_held.hpp)
  std::string rolls;      ///< which body of a solution would roll away (rolling.hpp); else empty
  bool accepted = false;
  contact::Problem problem;  ///< the problem solved, from `start`; W is shared, not copied
  contact::Start start;
  double force_scale = 0.0;
  std::optional<UniquenessResult> uniqueness;
};

/// The problem of an attempt in a form that other solvers can use.
DiscreteProblem discrete_problem(const Prepared& prepared, const Attempt& attempt);

}  // namespace scabo::analysis
