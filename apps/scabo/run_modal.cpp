// `scabo run` of a modal analysis.
#include <fmt/format.h>

#include <chrono>

#include "commands.hpp"
#include "failures.hpp"
#include "progress.hpp"
#include "scabo/analysis/modal_analysis.hpp"
#include "scabo/result/modal_results.hpp"
#include "scabo/result/results_directory.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

ExitStatus run_modal(const model::Model& model, const std::filesystem::path& directory, const RunOptions& options,
                     double reading) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  ignore_broken_pipes();
  analysis::ModalResult begun;
  begun.structure.mesh = analysis::check(model);
  begun.structure.model = model;
  const result::DirectoryLock lock = result::prepare_directory(directory);
  result::replace_file(directory / "summary.json", result::modal_summary_content(begun, true));
  Progress progress(options.quiet);
  analysis::Options analysis_options;
  analysis_options.threads = threads_that_fit(options.threads);
  analysis_options.on_stage = [&](const std::string& stage) { progress.stage(stage); };
  analysis::ModalResult result = marking_failures(directory, [&] {
    analysis::ModalResult solved = analysis::solve_modal(model, analysis_options);
    progress.stage("shapes");
    result::write_shapes(directory, solved);
    solved.timing.read = reading;
    solved.timing.total = reading + std::chrono::duration<double>(Clock::now() - start).count();
    result::write_modal_summary(directory, solved);
    return solved;
  });
  progress.meshed(result.structure);
  progress.clear();
  for (const Warning& warning : result.warnings) print_warning(warning.text);
  if (!options.quiet)
    print_summary(fmt::format("{} in {:.3g} s\n{}Results: {}\n",
                              count(static_cast<long>(result.modes.size()), "natural mode"), result.timing.total,
                              result::report_modes(result), directory.string()));
  return ExitStatus::solved;
}

}  // namespace scabo::app
