// `scabo run`, `scabo resume` and `scabo check` of a model in space.
#pragma once

#include "commands.hpp"
#include "scabo/analysis/space/solid_checkpoint.hpp"
#include "scabo/model/solid_model.hpp"
#include "scabo/result/files.hpp"

namespace scabo::app {

ExitStatus run_solids(const model::SpaceModel& model, const std::filesystem::path& directory, const RunOptions& options,
                      Events& events);
/// Of a run whose model is as it was when it began.
ExitStatus resume_solids(const model::SpaceModel& model, analysis::SolidCheckpoint begun, result::DirectoryLock lock,
                         const std::filesystem::path& directory, int threads, bool quiet, Events& events);
ExitStatus check_solids(const model::SpaceModel& model);

}  // namespace scabo::app
