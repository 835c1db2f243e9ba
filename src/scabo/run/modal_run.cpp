#include "scabo/run/modal_run.hpp"

#include <chrono>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/result/modal_results.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/run/failures.hpp"

namespace scabo::run {

analysis::ModalResult solve(const ModalRun& run) {
  using SteadyClock = std::chrono::steady_clock;
  const SteadyClock::time_point start = SteadyClock::now();
  const auto total = [&] { return run.reading + std::chrono::duration<double>(SteadyClock::now() - start).count(); };
  analysis::Options options;
  options.threads = run.threads;
  options.on_stage = run.on_stage;
  if (!run.output) {
    analysis::ModalResult solved = analysis::solve_modal(run.model, options);
    solved.timing.read = run.reading;
    solved.timing.total = total();
    return solved;
  }
  analysis::ModalResult begun;
  begun.structure.mesh = analysis::check(run.model);
  begun.structure.model = run.model;
  const std::string summary = result::modal_summary_content(begun, true);
  const result::DirectoryLock lock = result::prepare_directory(*run.output, summary);
  result::replace_file(*run.output / "summary.json", summary);
  return marking_failures(*run.output, [&] {
    analysis::ModalResult solved = analysis::solve_modal(run.model, options);
    if (run.on_stage) run.on_stage("shapes");
    result::write_shapes(*run.output, solved);
    solved.timing.read = run.reading;
    solved.timing.total = total();
    result::write_modal_summary(*run.output, solved);
    return solved;
  });
}

}  // namespace scabo::run
