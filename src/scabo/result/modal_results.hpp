// The results of a modal analysis: summary.json, fields.pvd with one .vtu for each mode, log.txt (docs/results.md).
#pragma once

#include <filesystem>
#include <string>

#include "scabo/analysis/modal_analysis.hpp"

namespace scabo::result {

/// A line for each mode: number, frequency, body, effective masses and their share of the total mass.
std::string report_modes(const analysis::ModalResult& result);

/// Content of summary.json; `running`: before there are modes.
std::string modal_summary_content(const analysis::ModalResult& result, bool running = false);

/// Writes the shapes into a directory that `prepare_directory` has made; adds the seconds it took to `result.timing`.
/// Throws WriteError.
void write_shapes(const std::filesystem::path& directory, analysis::ModalResult& result);

/// Writes log.txt and summary.json. Throws WriteError.
void write_modal_summary(const std::filesystem::path& directory, const analysis::ModalResult& result);

}  // namespace scabo::result
