// A whole run of a modal analysis: solve a model and, if a directory is given, write its results.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "scabo/analysis/modal/modal_analysis.hpp"

namespace scabo::run {

struct ModalRun {
  const model::Model& model;
  std::optional<std::filesystem::path> output = {};  ///< directory; nothing: results are only returned
  double reading = 0.0;                              ///< seconds for reading the model
  int threads = 1;
  std::function<void(const std::string& stage)> on_stage = {};  ///< may throw, as `Stopped`, which ends the run
};

/// Timing contains reading and total. Throws InputError and result::WriteError; a failure is recorded in the directory.
analysis::ModalResult solve(const ModalRun& run);

}  // namespace scabo::run
