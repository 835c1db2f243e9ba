// A whole run of a model in space: plan it, solve it and write its results.
#pragma once

#include <filesystem>

#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/run/plan.hpp"

namespace scabo::run {

/// Memory and time: of a body of n degrees of freedom a factor of n^1.42 bytes in n^2.05 seconds (nested dissection in
/// space), sweeps over it for the pairs, and their dense matrices.
Plan plan_of(const analysis::PosedSolids& posed);

struct SolidRun {
  const model::SpaceModel& model;
  const analysis::PosedSolids& posed;
  std::filesystem::path output;  ///< directory
  int threads = 1;
};

/// All increments; the last one may be unsolved. Throws result::WriteError, and what an interruption point throws
/// (base/interruption.hpp; one follows every increment but the last); a failure is recorded in the directory.
std::vector<analysis::SolidIncrement> solve(const SolidRun& run);

}  // namespace scabo::run
