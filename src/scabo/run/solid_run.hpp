// A whole run of a model in space: solve it and write its results.
#pragma once

#include <filesystem>

#include "scabo/analysis/space/posed_solids.hpp"

namespace scabo::run {

struct SolidRun {
  const model::SpaceModel& model;
  const analysis::PosedSolids& posed;
  std::filesystem::path output;  ///< directory
  int threads = 1;
};

/// All increments; the last one may be unsolved. Throws result::WriteError; a failure is recorded in the directory.
std::vector<analysis::SolidIncrement> solve(const SolidRun& run);

}  // namespace scabo::run
