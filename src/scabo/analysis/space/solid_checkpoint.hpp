// Checkpoint of a model in space, from which `scabo resume` continues as if the run had not been interrupted. The
// increments so far are in summary.json: `results.finished` says how many count.
#pragma once

#include <filesystem>
#include <string>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/analysis/state/checkpoint.hpp"

namespace scabo::analysis {

struct SolidCheckpoint {
  RunOrigin origin;
  WrittenResults results;  ///< without finished increments: the run starts from the beginning
  SolidState state;
};

/// Throws std::runtime_error.
void write_solid_checkpoint(const std::filesystem::path& directory, SolidCheckpoint checkpoint);

/// Throws InputError if there is none, if it is damaged, or if another version of the program wrote it.
SolidCheckpoint read_solid_checkpoint(const std::filesystem::path& directory, const std::string& version);

}  // namespace scabo::analysis
