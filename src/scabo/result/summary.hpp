// summary.json: the results of a run, for programs (docs/results.md describes every key).
#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/result/history.hpp"

namespace scabo::result {

/// Sizes of the model.
struct ModelSizes {
  int nodes = 0;
  int dofs = 0;  ///< two for each node, supported ones included
  int super_elements = 0;
  int finite_elements = 0;
  int contact_pairs = 0;  ///< pairs that can move; pairs held by supports on both sides do not count
};
ModelSizes sizes_of(const analysis::Discretisation& discretisation);  ///< with all pairs
ModelSizes sizes_of(const analysis::StaticSolution& solution);        ///< with the pairs that can move

/// Peak memory of this process in bytes; nothing if the system does not report it.
std::optional<long long> peak_memory();

/// Content of summary.json. `running`: the run has not ended, so that figures of the whole run are omitted. `timing`
/// replaces that of the solution. Values that do not exist are null. `most`: only the first so many increments.
std::string summary_content(const analysis::StaticSolution& solution, const analysis::Timing& timing, bool running,
                            const std::vector<HistoryExtremes>& history = {},
                            std::size_t most = std::numeric_limits<std::size_t>::max());

/// What an increment says of other solutions.
nlohmann::ordered_json content_of_uniqueness(const analysis::UniquenessResult& uniqueness);

/// The summary of a run ended by an error: `summary` with status `failed` and the reason.
std::string failed_summary(const std::string& summary, const std::string& reason);

/// `summary` of a run that continues: status `running`.
std::string running_summary(const std::string& summary);
/// Its `status`; nothing if it is not a summary.
std::optional<std::string> status_of_summary(const std::string& summary);
/// Likewise its `analysis`.
std::optional<std::string> analysis_of_summary(const std::string& summary);

/// `solved`, `not_converged`, `mechanism`, `collapse` or `interrupted`.
std::string_view name_of(analysis::Outcome outcome);
std::string_view name_of(element::CornerKind kind);

}  // namespace scabo::result
