// summary.json: the results of a run, for programs (docs/results.md names every key).
#pragma once

#include <optional>
#include <string>

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::result {

/// Sizes of what was solved.
struct ModelSizes {
  int nodes = 0;
  int dofs = 0;  ///< two for each node, supported ones included
  int super_elements = 0;
  int finite_elements = 0;
  int contact_pairs = 0;  ///< those that can move; pairs held by supports on both sides are none
};
ModelSizes sizes_of(const analysis::StaticSolution& solution);

/// The most memory this process has used so far, in bytes; nothing where the system does not say.
std::optional<long long> peak_memory();

/// Content of summary.json. `running`: not at its end yet, so without the figures of the whole run. `timing`
/// instead of the solution's. Values that do not exist are null.
std::string summary_content(const analysis::StaticSolution& solution, const analysis::Timing& timing, bool running);

/// The summary of a run that an error ended: `summary` with status `failed` and the reason.
std::string failed_summary(const std::string& summary, const std::string& reason);

/// `solved`, `not_converged`, `mechanism` or `interrupted`.
std::string_view name_of(analysis::Outcome outcome);
std::string_view name_of(element::CornerKind kind);

}  // namespace scabo::result
