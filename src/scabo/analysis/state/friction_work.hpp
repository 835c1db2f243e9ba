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

/// One pair over an increment in which it slips.
struct PairCourse {
  using Tangential = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;  ///< d - 1 numbers
  const contact::Law &law_before, &law_after;
  double area = 0.0;
  contact::PairHistory history_before, history_after;
  double pressing_before = 0.0, pressing_after = 0.0;  ///< p_n
  Tangential shearing_before, shearing_after;          ///< p_t
  Tangential slip;                                     ///< of the increment
  double gap_before = 0.0;
  contact::ContactState state_before = contact::ContactState::open, state_after = state_before;
};
void add_friction_work(const PairCourse& pair, FrictionWork& total);

}  // namespace scabo::analysis
