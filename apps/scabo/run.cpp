// `scabo run`: from the model file to certified results on disk.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "commands.hpp"
#include "failures.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/contact/files/fclib.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/result/version.hpp"
#include "settings.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// `model.results` beside `model.yaml`.
std::filesystem::path default_output(const std::string& model) {
  std::filesystem::path path(model);
  return path.replace_extension("results");
}

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

}  // namespace

ExitStatus run(const RunOptions& options) {
  const Clock::time_point start = Clock::now();
  const model::Model model = input::read_model(options.model, parse_settings(options.settings));
  const double reading = seconds_since(start);
  const auto output = options.output.empty() ? default_output(options.model) : options.output;
  if (model.analysis.type == model::AnalysisType::modal) return run_modal(model, output, options, reading);

  ignore_broken_pipes();
  // The model is checked before the directory is created or cleared, and the directory is created before the solve: a
  // mistake in either then costs seconds and no results. Meshing twice takes a hundredth of the time of a solve.
  mesh::Mesh mesh = analysis::check(model);
  const Interrupt interrupt;
  result::ResultsDirectory directory(output, model, std::move(mesh));

  Progress progress(options.quiet);
  analysis::Options analysis_options;
  analysis_options.threads = threads_that_fit(options.threads);
  analysis_options.keep_fields = false;  // they are written as they come
  analysis_options.stop = &interrupt.requested();
  analysis_options.on_stage = [&](const std::string& stage) { progress.stage(stage); };
  analysis_options.on_mesh = [&](const auto& solution) { progress.meshed(solution); };
  analysis_options.on_increment = [&](const auto& solution, const auto& increment) {
    directory.add(solution, increment);
    progress.increment(solution, increment);
  };
  if (model.output.discrete_problems)
    analysis_options.on_problems = [&](const auto& increment, const auto& problems) {
      write_problems(directory, model, increment, problems);
    };
  const analysis::StaticSolution solution = marking_failures(directory.path(), [&] {
    analysis::StaticSolution solved = analysis::solve_static(model, analysis_options);
    solved.timing.read = reading;
    solved.timing.total = seconds_since(start);
    directory.finish(solved);
    return solved;
  });
  progress.clear();

  const ExitStatus status = status_of(solution, interrupt.signal());
  for (const Warning& warning : solution.warnings) print_warning(warning.text);
  for (const std::string& warning : directory.warnings()) print_warning(warning);
  print_reason(solution, status);
  if (!options.quiet) print_summary(summary_text(solution, directory.path()));
  return status;
}

}  // namespace scabo::app
