// What a checkpoint says about the origin of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scabo/analysis/state/checkpoint.hpp"

namespace scabo::run {

/// `model`: path of the model file; `files`: what it names; `text`: that of the model, null: as it is in the file.
/// Throws InputError if a file cannot be read.
analysis::RunOrigin origin_of(const std::string& model, const std::vector<std::string>& files,
                              const std::vector<std::string>& settings, const std::filesystem::path& output,
                              int threads, const std::string* text);

}  // namespace scabo::run
