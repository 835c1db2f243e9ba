// The results of a modal analysis: summary.json, fields.pvd with one .vtu for each mode, log.txt (docs/results.md).
#pragma once

#include <filesystem>
#include <string>

#include "scabo/analysis/modal/modal_analysis.hpp"

namespace scabo::result {

/// A line for each mode: number, frequency, body, effective masses and their share of the total mass.
std::string report_modes(const analysis::ModalResult& result);

/// Content of summary.json; `running`: before modes are known.
std::string modal_summary_content(const analysis::ModalResult& result, bool running = false);

/// Writes the mode shapes into a directory created by `prepare_directory`, and adds the time to `result.timing`. Throws
/// WriteError.
void write_shapes(const std::filesystem::path& directory, analysis::ModalResult& result);

/// Writes log.txt and summary.json. Throws WriteError.
void write_modal_summary(const std::filesystem::path& directory, const analysis::ModalResult& result);

}  // namespace scabo::result
