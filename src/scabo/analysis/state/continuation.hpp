// What a run continues from: plain data, which a checkpoint keeps (checkpoint.hpp).
#pragma once

#include <vector>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Ends of the increments of one step. Plain data, which a checkpoint keeps.
struct StepProgress {
  int increment = 0;     ///< that are finished
  double reached = 0.0;  ///< part of the step, 0 to 1
  /// Of the next increment of an automatic step; 0: its first. Of a step that looks for a limit a difference of factors.
  double size = 0.0;
  /// The nearest part ahead at which there was no equilibrium: of an automatic step a mechanism or collapse, of one that
  /// looks for a limit whatever was not solved; 0: none.
  double limit = 0.0;
};

/// Position and state after an accepted increment.
struct RunState {
  std::size_t step = 0;   ///< index into Model::steps
  StepProgress progress;  ///< within this step
  State state;
};

struct Continuation {
  RunState at;                              ///< of its state, displacements are needed in time only (complete())
  std::vector<IncrementResult> increments;  ///< so far, without fields and pairs
  std::vector<Warning> warnings;            ///< so far
  Timing timing;                            ///< of all sessions so far, to which this one adds
};

}  // namespace scabo::analysis
