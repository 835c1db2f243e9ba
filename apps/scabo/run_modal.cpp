// `scabo run` of a modal analysis.
#include <fmt/format.h>

#include <chrono>

#include "commands.hpp"
#include "progress.hpp"
#include "scabo/analysis/modal_analysis.hpp"
#include "scabo/result/modal_results.hpp"
#include "scabo/result/results_directory.hpp"
#include "terminal.hpp"

namespace scabo::app {

ExitStatus run_modal(const model::Model& model, const std::filesystem::path& directory, const RunOptions& options,
                     double reading) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  analysis::check(model);
  result::prepare_directory(directory);
  Progress progress(options.quiet);
  analysis::Options analysis_options;
  analysis_options.threads = options.threads;
  analysis_options.on_stage = [&](const std::string& stage) { progress.stage(stage); };
  analysis::ModalResult result = analysis::solve_modal(model, analysis_options);
  progress.stage("shapes");
  result::write_shapes(directory, result);
  result.timing.read = reading;
  result.timing.total = reading + std::chrono::duration<double>(Clock::now() - start).count();
  result::write_modal_summary(directory, result);
  progress.meshed(result.structure);
  progress.clear();
  for (const std::string& warning : result.warnings) print_warning(warning);
  if (!options.quiet)
    print_output(fmt::format("{} in {:.3g} s\n{}Results: {}\n",
                             count(static_cast<long>(result.modes.size()), "natural mode"), result.timing.total,
                             result::report_modes(result), directory.string()));
  return ExitStatus::solved;
}

}  // namespace scabo::app
