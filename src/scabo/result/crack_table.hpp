// cracks.csv: one line for every tip that may grow, after every increment of a step in which cracks grow
// (docs/results.md).
#pragma once

#include <string>
#include <string_view>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::result {

/// First line, with the names of the columns.
extern const std::string_view crack_table_header;

/// Lines of an increment, with the shortest numbers that read back exactly; none of another step.
std::string crack_table_rows(const analysis::IncrementResult& increment);

}  // namespace scabo::result
