// `scabo run`, `scabo resume` and `scabo check` of a model in space.
#pragma once

#include "commands.hpp"
#include "scabo/analysis/space/solid_checkpoint.hpp"
#include "scabo/model/solid_model.hpp"
#include "scabo/result/files.hpp"
#include "scabo/run/plan.hpp"

namespace scabo::app {

ExitStatus run_solids(const model::SpaceModel& model, const std::filesystem::path& directory, const RunOptions& options,
                      Events& events);
/// Of a run whose model is as it was when it began.
ExitStatus resume_solids(const model::SpaceModel& model, analysis::SolidCheckpoint begun, result::DirectoryLock lock,
                         const std::filesystem::path& directory, int threads, bool quiet, Events& events);
ExitStatus check_solids(const model::SpaceModel& model);

/// Of `scabo check`, in the plane too: where `scabo run` would not start.
void warn_of_memory(const run::Plan& plan);

}  // namespace scabo::app
