// What a run continues from: plain data, which a checkpoint keeps (checkpoint.hpp).
#pragma once

#include "scabo/analysis/increment_size.hpp"

namespace scabo::analysis {

/// Position and state after an accepted increment.
struct RunState {
  std::size_t step = 0;   ///< index into Model::steps
  StepProgress progress;  ///< within this step
  State state;
};

struct Continuation {
  RunState at;                              ///< of its state, the displacements are not needed (complete())
  std::vector<IncrementResult> increments;  ///< so far, without fields and pairs
  std::vector<Warning> warnings;            ///< so far
  Timing timing;                            ///< of all sessions so far, to which this one adds
};

}  // namespace scabo::analysis
