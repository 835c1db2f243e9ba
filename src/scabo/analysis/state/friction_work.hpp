// Work of friction over an increment (docs/methods/07_history_and_increments.md, eq. 7.7).
//
// While a pair slips, the tangential force is the bound b = c A + mu (p_n)+ of its law, against the slip: before, it
// only sticks, and no work is done. So the work is the integral of b over the slip ds, whenever in the increment the
// slip began. p_n goes linearly from its value at the start to that at the end; a coefficient that falls with slip is
// that of the slip so far.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

struct FrictionWork {
  double work = 0.0;  ///< >= 0
  /// What this is more than the trapezoidal rule gives. What moved the pairs did it as well.
  double beyond_rule = 0.0;
  /// The work is known to +- this, because pairs changed their state while their bound changed, >= 0.
  double error = 0.0;
};

FrictionWork friction_work(const Prepared& prepared, const State& from, const State& to);

}  // namespace scabo::analysis
