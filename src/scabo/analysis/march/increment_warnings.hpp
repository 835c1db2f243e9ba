// Warnings about a single increment.
#pragma once

#include "scabo/analysis/march/reached.hpp"

namespace scabo::analysis {

/// Adds each kind of warning once, for the increment where it first applies. `solution` has the increments before it.
void add_warnings(const Prepared& prepared, const Reached& reached, const IncrementResult& at,
                  StaticSolution& solution);

}  // namespace scabo::analysis
