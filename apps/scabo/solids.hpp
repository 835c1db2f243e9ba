// `scabo run` and `scabo check` of a model in space.
#pragma once

#include "commands.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::app {

ExitStatus run_solids(const model::SpaceModel& model, const std::filesystem::path& directory, const RunOptions& options,
                      Events& events);
ExitStatus check_solids(const model::SpaceModel& model);

}  // namespace scabo::app
