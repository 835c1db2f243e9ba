// Where the time of an analysis goes.
#pragma once

namespace scabo::analysis {

/// Seconds.
struct Timing {
  double read = 0.0, mesh = 0.0, super_elements = 0.0, assemble = 0.0, factorise = 0.0, condense = 0.0, newton = 0.0,
         recover = 0.0, write = 0.0, total = 0.0;
};

}  // namespace scabo::analysis
