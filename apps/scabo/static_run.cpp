#include "static_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "commands.hpp"
#include "progress.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/report.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

/// Totals of the last converged increment, which bodies move after it, and the location of the results.
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
    text += result::report_totals(solution.model, *last);
  }
  return text + result::report_growth(solution) + result::report_limit(solution) + result::report_mechanism(solution) +
         fmt::format("Results: {}\n", directory.string());
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

/// mpirun ends all processes when one is lost, by SIGTERM and a second later by SIGKILL: while it exists, such an end
/// is recorded in the results at once. A run that still ends by itself writes another summary.
class EndFromOutside {
 public:
  EndFromOutside(const Interrupt& interrupt, std::filesystem::path directory)
      : watch_([&interrupt, directory = std::move(directory)](const std::stop_token& over) {
          while (!over.stop_requested()) {
            if (interrupt.requested()) {
              if (result::status_in(directory) == "running")
                result::mark_failed(directory,
                                    "the processes were told to end: a rank was lost (mpirun says which), or the run "
                                    "was ended from outside");
              return;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        }) {}

 private:
  std::jthread watch_;
};

/// Of the analysis and of its files.
void tell_warnings(const analysis::StaticSolution& solution, const result::ResultsDirectory& directory,
                   Events& events) {
  for (const Warning& warning : solution.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  for (const std::string& warning : directory.warnings()) {
    events.warning(warning);
    print_warning(warning);
  }
}

}  // namespace

void use(Cluster& cluster, const std::string& file, const std::vector<std::string>& settings, double divide_from,
         run::StaticRun& run) {
  const std::filesystem::path& directory = run.directory->path();
  run::marking_failures(directory, [&] { cluster.begin(file, settings, directory, divide_from); });
  run.directory->divide_fields(&cluster.fields());
  run.ranks = &cluster.ranks();
}

ExitStatus solve_and_report(run::StaticRun run, const Interrupt& interrupt, Events& events, bool quiet) {
  events.files(run.model.file, run.directory->path(), "static");
  Progress progress(quiet);
  progress.resumed(static_cast<int>(run.begun.from.increments.size()));
  run.stop = &interrupt.requested();
  run.observer.on_plan = [&](const run::Plan& plan) {
    events.plan(plan);
    progress.plan(plan);
  };
  // Nothing is lost by an end before the first increment. One that has begun is finished; on several meshes, stages
  // tell when the first one begins.
  bool begun = false;
  const Interruptible::Ask ask = [&] {
    if (!begun && interrupt.requested()) throw analysis::EndAtOnce{};
  };
  run.observer.on_stage = [&](const std::string& stage) {
    begun = begun || stage.find(", increment ") != std::string::npos;
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
  std::optional<EndFromOutside> watch;
  if (run.ranks) watch.emplace(interrupt, run.directory->path());
  const analysis::StaticSolution solution = [&] {
    const Interruptible here(run.ranks ? nullptr : &ask);  // other processes are in the midst of it
    return run::solve(run);
  }();
  watch.reset();
  progress.clear();

  const ExitStatus status = status_of(solution, interrupt.signal());
  tell_warnings(solution, *run.directory, events);
  if (status != ExitStatus::solved) {
    const bool interrupted = status != ExitStatus::not_converged;
    const std::string why = run::why_not_solved(solution, interrupted) +
                            (interrupted ? how_to_resume(run.directory->path()) : std::string());
    events.not_solved(solution);
    events.error(why);
    print_error(why);
  }
  if (!quiet) events.print_summary(summary_text(solution, run.directory->path()));
  return status;
}

}  // namespace scabo::app
