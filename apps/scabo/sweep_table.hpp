// sweep.csv: one row for each point of a sweep, from the summaries of its runs.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sweep_axes.hpp"

namespace scabo::app {

/// How one point of a sweep ended.
struct SweepRow {
  /// `solved`, `not_converged`, `mechanism`, `collapse`, `interrupted`, `failed`, `wrong_input`, `killed`; `waiting`
  /// before its run.
  std::string status = "waiting";
  std::string step, reached;                  ///< of the last finished increment: its step, and the part of it
  std::map<std::string, std::string> values;  ///< main quantities of the last increment by the name of their column
  std::vector<std::string> order;             ///< of the columns in `values`
};

/// Whether a second call leaves the point as it is.
bool is_finished(const SweepRow& row);

/// Row of the results in a directory; `waiting` if there are none. Quantities only of runs that are solved.
SweepRow row_of(const std::filesystem::path& results);

/// The whole table. Points are numbered from 1; the columns are those of all rows.
std::string sweep_table(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows);

}  // namespace scabo::app
