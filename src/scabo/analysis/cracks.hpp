// Stress intensity factors of the cracks and corners of a structure after an increment (element/stress_intensity.hpp).
#pragma once

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::analysis {

/// One for each bounded open super-element, from its boundary displacements and the loads inside it.
std::vector<CrackResult> crack_results(const StaticSolution& solution, const IncrementResult& increment);

}  // namespace scabo::analysis
