#include "static_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "progress.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/report.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

/// Totals of the last converged increment, and the location of the results.
std::string summary_text(const analysis::StaticSolution& solution, const std::filesystem::path& directory) {
  int converged = 0;
  double certificate = 0.0;
  const analysis::IncrementResult* last = nullptr;
  for (const analysis::IncrementResult& increment : solution.increments) {
    if (!increment.converged) continue;
    ++converged;
    certificate = std::max(certificate, increment.certificate.worst());
    last = &increment;
  }
  std::string text;
  if (last) {
    text = fmt::format("{} solved and certified in {:.3g} s; worst figure of the certificate {:.1e}\n",
                       model::counted(converged, "increment"), solution.timing.total, certificate);
    if (last->error) text += fmt::format("Estimated error {:.2g} of the energy norm\n", last->error->relative);
    text += fmt::format("After step {}, increment {}:\n", last->step_name, last->increment);
    text += result::report_totals(solution.model, *last);
  }
  return text + fmt::format("Results: {}\n", directory.string());
}

ExitStatus status_of(const analysis::StaticSolution& solution, int signal) {
  switch (solution.outcome) {
    case analysis::Outcome::solved:
      return ExitStatus::solved;
    case analysis::Outcome::interrupted:
    case analysis::Outcome::not_converged:
    case analysis::Outcome::mechanism:
    case analysis::Outcome::collapse:
      break;
  }
  // A signal also ends the halving of an increment; the run was then stopped by the signal.
  return signal != 0 ? static_cast<ExitStatus>(ExitStatus::signalled + signal) : ExitStatus::not_converged;
}

}  // namespace

ExitStatus solve_and_report(run::StaticRun run, const Interrupt& interrupt, Events& events, bool quiet) {
  events.files(run.model.file, run.directory->path(), "static");
  Progress progress(quiet);
  progress.resumed(static_cast<int>(run.begun.from.increments.size()));
  run.stop = &interrupt.requested();
  run.observer.on_plan = [&](const run::Plan& plan) {
    events.plan(plan);
    progress.plan(plan);
  };
  run.observer.on_stage = [&](const std::string& stage) {
    events.stage(stage);
    progress.stage(stage);
  };
  run.observer.on_mesh = [&](const analysis::StaticSolution& solved) {
    events.meshed();
    progress.meshed(solved);
  };
  run.observer.on_increment_begin = [&](const analysis::IncrementBegin& begin) { events.increment_begin(begin); };
  run.observer.on_iteration = [&](const contact::Iteration& iteration) {
    events.iteration(iteration);
    progress.iteration(iteration);
  };
  run.observer.on_increment = [&](const analysis::StaticSolution& solved, const analysis::IncrementResult& increment) {
    events.increment_end(solved.model, increment, solved.increments.size() == 1);
    progress.increment(solved, increment);
  };
  const analysis::StaticSolution solution = run::solve(run);
  progress.clear();

  const ExitStatus status = status_of(solution, interrupt.signal());
  for (const Warning& warning : solution.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  for (const std::string& warning : run.directory->warnings()) {
    events.warning(warning);
    print_warning(warning);
  }
  if (status != ExitStatus::solved) {
    const std::string why = run::why_not_solved(solution, status != ExitStatus::not_converged);
    events.outcome(solution.outcome);
    events.error(why);
    print_error(why);
  }
  if (!quiet) events.print_summary(summary_text(solution, run.directory->path()));
  return status;
}

}  // namespace scabo::app
