// `scabo run` of a modal analysis.
#include <fmt/format.h>

#include "commands.hpp"
#include "progress.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/modal_results.hpp"
#include "scabo/run/modal_run.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

ExitStatus run_modal(const model::Model& model, const std::filesystem::path& directory, const RunOptions& options,
                     double reading, Events& events) {
  events.files(model.file, directory, "modal");
  ignore_broken_pipes();
  Progress progress(options.quiet);
  run::ModalRun run{model, directory, reading};
  run.threads = threads_that_fit(options.threads);
  run.on_stage = [&](const std::string& stage) {
    events.stage(stage);
    progress.stage(stage);
  };
  const analysis::ModalResult result = run::solve(run);
  progress.meshed(result.structure);
  progress.clear();
  for (const Warning& warning : result.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  if (!options.quiet)
    events.print_summary(fmt::format("{} in {:.3g} s\n{}Results: {}\n",
                              model::counted(static_cast<long>(result.modes.size()), "natural mode"),
                              result.timing.total, result::report_modes(result), directory.string()));
  return ExitStatus::solved;
}

}  // namespace scabo::app
