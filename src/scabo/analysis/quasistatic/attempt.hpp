// One load increment in equilibrium: from an accepted state to factors of loads and supports.
#pragma once

#include "scabo/analysis/march/attempt.hpp"

namespace scabo::analysis {

/// To reach `factors` from `from`.
Attempt attempt(const Prepared& prepared, const State& from, const Factors& factors);
/// Whether the attempt `tried` from `from` is, but for a factor of all forces and motions, that to `less` as well: no
/// contact forces or slip so far, no gaps, loads in the same proportion, and laws that are cones and do not remember.
bool is_same_scaled(const Prepared& prepared, const State& from, const Attempt& tried, const Factors& less);

}  // namespace scabo::analysis
