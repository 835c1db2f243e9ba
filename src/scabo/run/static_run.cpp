#include "scabo/run/static_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/analysis/state/restart.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/contact/files/fclib.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/version.hpp"
#include "scabo/run/checkpoint_pace.hpp"
#include "scabo/run/origin.hpp"
#include "scabo/run/sizes.hpp"

namespace scabo::run {

namespace {

using Clock = std::chrono::steady_clock;

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
    for (const model::Bar& bar : model.bars) saved.contacts.push_back(bar.name);
    for (const model::Support& support : model.supports)
      if (support.is_staged()) saved.contacts.push_back(support.name);
    saved.contact_of_pair = discrete.contact_of_pair;
    saved.number_of_pair = discrete.number_of_pair;
    saved.title = fmt::format("{}: step {}, increment {}", model.title.empty() ? model.file : model.title,
                              increment.step_name, increment.increment);
    saved.description = fmt::format("By Scabo {}, attempt {} of {}, {}", result::version(), attempt + 1,
                                    problems.size(), discrete.accepted ? "accepted" : "not accepted");
    contact::write_fclib(directory.problem_file(increment, attempt).string(), saved);
  }
}

class Checkpoints {
 public:
  explicit Checkpoints(const StaticRun& run) : run_(run), seconds_before_(run.begun.from.timing.total) {
    if (run.directory && !run.begun.origin.files.empty() && keeps_checkpoints(run.model))
      writer_.emplace(run.directory->path(), run.begun);
  }
  void add(const analysis::RunState& state, const analysis::StaticSolution& solution) {
    const bool stopping = run_.stop && *run_.stop;
    if (!writer_ || (!pace_.is_due() && !stopping)) return;
    pace_.write([&] {
      const Clock::time_point start = Clock::now();
      analysis::WrittenResults written = run_.directory->written();
      analysis::Timing timing = run_.directory->complete(solution.timing);
      timing.read += run_.reading;
      timing.total = seconds_before_ + std::chrono::duration<double>(start - run_.start).count();
      writer_->write(state, solution, std::move(written), timing);
    });
  }

 private:
  const StaticRun& run_;
  double seconds_before_;
  std::optional<analysis::CheckpointWriter> writer_;
  CheckpointPace pace_;
};

analysis::StaticSolution stopped_before_any_increment(const StaticRun& run) {
  analysis::StaticSolution solution;
  solution.model = run.model;
  const Interruptible nobody(nullptr);
  solution.mesh = analysis::check(run.model);
  solution.warnings = run.model.warnings;
  solution.outcome = analysis::Outcome::interrupted;
  solution.reason = "interrupted: no increment was finished";
  return solution;
}

analysis::StaticSolution solve_and_write(const StaticRun& run) {
  if (run.plan && !run.anyway.empty())
    if (const std::string why = why_it_does_not_fit(*run.plan, available_memory(), run.anyway); !why.empty())
      throw NotEnoughMemory(why);
  if (run.plan && run.observer.on_plan) run.observer.on_plan(*run.plan);
  Checkpoints checkpoints(run);
  analysis::Options options;
  options.threads = run.threads;
  options.ranks = run.ranks;
  options.keep_fields = run.keep_fields;
  options.stop = run.stop;
  if (!run.begun.from.increments.empty()) options.from = &run.begun.from;
  options.on_stage = run.observer.on_stage;
  options.on_mesh = run.observer.on_mesh;
  options.on_increment_begin = run.observer.on_increment_begin;
  options.on_iteration = run.observer.on_iteration;
  options.on_increment = [&](const auto& solved, const auto& increment) {
    if (run.directory) run.directory->add(solved, increment);
    if (run.observer.on_increment) run.observer.on_increment(solved, increment);
  };
  if (run.directory)
    options.on_end = [&](const analysis::EndState& end) { analysis::write_end_state(run.directory->path(), end); };
  options.on_accepted = [&](const auto& state, const auto& solved) { checkpoints.add(state, solved); };
  if (run.directory && run.model.output.discrete_problems)
    options.on_problems = [&](const auto& increment, const auto& problems) {
      write_problems(*run.directory, run.model, increment, problems);
    };
  analysis::StaticSolution solved;
  try {
    solved = analysis::solve_static(run.model, options);
  } catch (const Stopped&) {
    solved = stopped_before_any_increment(run);
  } catch (const analysis::EndAtOnce&) {  // between the passes of an analysis on several meshes
    solved = stopped_before_any_increment(run);
  }
  solved.timing.read += run.reading;
  solved.timing.total = run.begun.from.timing.total + std::chrono::duration<double>(Clock::now() - run.start).count();
  if (!run.directory) return solved;
  const Interruptible nobody(nullptr);
  run.directory->finish(solved);
  if (solved.outcome != analysis::Outcome::interrupted) analysis::remove_checkpoint(run.directory->path());
  return solved;
}

}  // namespace

bool keeps_checkpoints(const model::Model& model) {
  return model.analysis.type == model::AnalysisType::static_ && increments_of(model) > 1;
}

analysis::RunOrigin origin_of(const model::Model& model, const std::vector<std::string>& settings,
                              const std::filesystem::path& output, int threads) {
  return origin_of(model.file, model.files, settings, output, threads, model.text.get());
}

analysis::StaticSolution solve(const StaticRun& run) {
  if (!run.directory) return solve_and_write(run);
  return marking_failures(run.directory->path(), [&] { return solve_and_write(run); });
}

double part_done(const model::Model& model, const analysis::IncrementResult& increment) {
  return (increment.step - 1 + increment.reached) / static_cast<double>(model.steps.size());
}

std::string why_not_solved(const analysis::StaticSolution& solution, bool interrupted) {
  if (solution.outcome == analysis::Outcome::solved) return "";
  const auto finished = std::count_if(solution.increments.begin(), solution.increments.end(),
                                      [](const auto& increment) { return increment.converged; });
  const std::string kept = finished == 0 ? "no increment was finished"
                                         : model::counted(static_cast<long>(finished), "finished increment") + " kept";
  if (interrupted) return fmt::format("interrupted; {}", kept);
  if (solution.outcome != analysis::Outcome::not_converged) return fmt::format("{} ({})", solution.reason, kept);
  return fmt::format("did not converge: {} ({})", solution.reason, kept);
}

}  // namespace scabo::run
