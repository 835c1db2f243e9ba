// The columns of history.csv after the last increment of a run.
#pragma once

#include <cmath>
#include <map>
#include <string>

#include "scabo/result/history.hpp"
#include "verification/run.hpp"

namespace scabo::verification {

/// By the name of the column; not a number where it is empty.
inline std::map<std::string, double> history_of(const analysis::StaticSolution& solution) {
  result::History history(solution.model);
  history.row(solution, last(solution));
  std::map<std::string, double> values;
  for (const result::HistoryExtremes& column : history.extremes())
    values[column.column] = column.last ? column.last->value : std::nan("");
  return values;
}

}  // namespace scabo::verification
