// A whole run of a model in space: plan it, solve it and write its results.
#pragma once

#include <filesystem>
#include <functional>

#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/analysis/space/solid_checkpoint.hpp"
#include "scabo/result/solid/solid_results.hpp"
#include "scabo/run/plan.hpp"

namespace scabo::run {

/// Memory and time: of a body of n degrees of freedom a factor of n^1.42 bytes in n^2.05 seconds (nested dissection in
/// space), sweeps over it for the pairs, and their dense matrices.
Plan plan_of(const analysis::PosedSolids& posed);

struct SolidRun {
  const model::SpaceModel& model;
  const analysis::PosedSolids& posed;
  result::SolidResults& results;
  std::filesystem::path directory;  ///< of the results
  int threads = 1;
  analysis::SolidCheckpoint begun = {};  ///< of a new run: without increments; without origin none are written
  std::function<void(const analysis::SolidIncrement&)> on_increment = {};  ///< told when it is written
};

/// What a checkpoint says about the origin of a run. Throws InputError if a file cannot be read.
analysis::RunOrigin origin_of(const model::SpaceModel& model, const std::vector<std::string>& settings,
                              const std::filesystem::path& output, int threads);

/// All increments that are not done, with checkpoints. Ends as interrupted where an interruption point throws Stopped
/// (base/interruption.hpp; one follows every increment but the last). Throws result::WriteError; a failure is recorded
/// in the directory.
result::SolidEnd solve(const SolidRun& run);

/// All increments without files, told as they are made. Whether it was interrupted.
bool solve_in_memory(const model::SpaceModel& model, const analysis::PosedSolids& posed, int threads,
                     const std::function<void(const analysis::SolidIncrement&)>& on_increment);

}  // namespace scabo::run
