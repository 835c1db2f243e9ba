// Warnings about a single increment.
#pragma once

#include <vector>

#include "scabo/analysis/large_slip.hpp"
#include "scabo/analysis/reach.hpp"

namespace scabo::analysis {

/// Adds each kind of warning once, for the increment where it first applies. `solution` has the increments before it.
void add_warnings(const Prepared& prepared, const Reached& reached, const IncrementResult& at,
                  StaticSolution& solution);

/// Adds, once for each contact, that its sides face each other over less than at the start.
void add_slid_off(const LargeSlip& large, const State& state, const IncrementResult& at, StaticSolution& solution);

}  // namespace scabo::analysis
