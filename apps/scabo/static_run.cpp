#include "static_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "failures.hpp"
#include "progress.hpp"
#include "scabo/contact/files/fclib.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/version.hpp"
#include "sizes.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

using Clock = std::chrono::steady_clock;

/// Part of the time of a run that its checkpoints may take. More increments are then solved again after a kill, at most
/// for as long as twenty checkpoints take.
constexpr double share_of_checkpoints = 0.05;

/// One file for each attempt, with the solution if it was accepted. Not in result/, which has no access to problem
/// files.
void write_problems(const result::ResultsDirectory& directory, const model::Model& model,
                    const analysis::IncrementResult& increment,
                    const std::vector<analysis::DiscreteProblem>& problems) {
  for (std::size_t attempt = 0; attempt < problems.size(); ++attempt) {
    const analysis::DiscreteProblem& discrete = problems[attempt];
    contact::SavedProblem saved;
    saved.problem = discrete.problem;
    saved.start = discrete.start;
    saved.force_scale = discrete.force_scale;
    if (discrete.accepted) {
      saved.r = discrete.solution.p;
      saved.a = discrete.solution.a;
    }
    for (const model::Contact& contact : model.contacts) saved.contacts.push_back(contact.name);
    saved.contact_of_pair = discrete.contact_of_pair;
    saved.number_of_pair = discrete.number_of_pair;
    saved.title = fmt::format("{}: step {}, increment {}", model.title.empty() ? model.file : model.title,
                              increment.step_name, increment.increment);
    saved.description = fmt::format("By Scabo {}, attempt {} of {}, {}", result::version(), attempt + 1,
                                    problems.size(), discrete.accepted ? "accepted" : "not accepted");
    contact::write_fclib(directory.problem_file(increment, attempt).string(), saved);
  }
}

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
                       count(converged, "increment"), solution.timing.total, certificate);
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
      break;
  }
  // A signal also ends the halving of an increment; the run was then stopped by the signal.
  return signal != 0 ? static_cast<ExitStatus>(ExitStatus::signalled + signal) : ExitStatus::not_converged;
}

void print_reason(const analysis::StaticSolution& solution, ExitStatus status) {
  if (status == ExitStatus::solved) return;
  const auto finished = std::count_if(solution.increments.begin(), solution.increments.end(),
                                      [](const auto& increment) { return increment.converged; });
  const std::string kept =
      finished == 0 ? "no increment was finished" : count(finished, "finished increment") + " kept";
  if (status != ExitStatus::not_converged)
    print_error(fmt::format("interrupted; {}", kept));
  else if (solution.outcome == analysis::Outcome::mechanism)
    print_error(fmt::format("{} ({})", solution.reason, kept));
  else
    print_error(fmt::format("did not converge: {} ({})", solution.reason, kept));
}

/// Writes checkpoints, after every increment as long as that takes a twentieth of the time.
class Checkpoints {
 public:
  Checkpoints(StaticRun& run) : run_(run), seconds_before_(run.begun.from.timing.total) {
    if (keeps_checkpoints(run.model)) writer_.emplace(run.directory.path(), run.begun);
  }
  void add(const analysis::RunState& state, const analysis::StaticSolution& solution) {
    if (!writer_ || (Clock::now() < next_ && !run_.interrupt.requested())) return;
    const Clock::time_point start = Clock::now();
    analysis::WrittenResults written = run_.directory.written();
    analysis::Timing timing = run_.directory.complete(solution.timing);
    timing.read += run_.reading;
    timing.total = seconds_before_ + std::chrono::duration<double>(start - run_.start).count();
    writer_->write(state, solution, std::move(written), timing);
    const Clock::time_point end = Clock::now();
    next_ = end + std::chrono::duration_cast<Clock::duration>((end - start) / share_of_checkpoints);
  }

 private:
  StaticRun& run_;
  double seconds_before_;
  std::optional<analysis::CheckpointWriter> writer_;
  Clock::time_point next_;
};

}  // namespace

bool keeps_checkpoints(const model::Model& model) {
  return model.analysis.type == model::AnalysisType::static_ && increments_of(model) > 1;
}

ExitStatus solve_and_write(StaticRun run) {
  result::ResultsDirectory& directory = run.directory;
  Progress progress(run.quiet);
  const analysis::StaticSolution solution = marking_failures(directory.path(), [&] {
    if (run.plan && !run.ignore_memory)
      if (const std::string why = why_it_does_not_fit(*run.plan, available_memory()); !why.empty())
        throw std::runtime_error(why);
    if (run.plan) progress.plan(*run.plan);
    progress.resumed(static_cast<int>(run.begun.from.increments.size()));
    Checkpoints checkpoints(run);
    analysis::Options options;
    options.threads = run.threads;
    options.keep_fields = false;  // they are written as they come
    options.stop = &run.interrupt.requested();
    if (!run.begun.from.increments.empty()) options.from = &run.begun.from;
    options.on_stage = [&](const std::string& stage) { progress.stage(stage); };
    options.on_mesh = [&](const auto& solved) { progress.meshed(solved); };
    options.on_increment = [&](const auto& solved, const auto& increment) {
      directory.add(solved, increment);
      progress.increment(solved, increment);
    };
    options.on_accepted = [&](const auto& state, const auto& solved) { checkpoints.add(state, solved); };
    if (run.model.output.discrete_problems)
      options.on_problems = [&](const auto& increment, const auto& problems) {
        write_problems(directory, run.model, increment, problems);
      };
    const double seconds_before = run.begun.from.timing.total;
    analysis::StaticSolution solved = analysis::solve_static(run.model, options);
    solved.timing.read += run.reading;
    solved.timing.total = seconds_before + std::chrono::duration<double>(Clock::now() - run.start).count();
    directory.finish(solved);
    if (solved.outcome != analysis::Outcome::interrupted) analysis::remove_checkpoint(directory.path());
    return solved;
  });
  progress.clear();

  const ExitStatus status = status_of(solution, run.interrupt.signal());
  for (const Warning& warning : solution.warnings) print_warning(warning.text);
  for (const std::string& warning : directory.warnings()) print_warning(warning);
  print_reason(solution, status);
  if (!run.quiet) print_summary(summary_text(solution, directory.path()));
  return status;
}

}  // namespace scabo::app
