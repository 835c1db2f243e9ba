// `scabo run`: from the model file to certified results on disk.
#include <chrono>

#include "commands.hpp"
#include "plan.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/version.hpp"
#include "settings.hpp"
#include "startup.hpp"
#include "static_run.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// `model.results` beside `model.yaml`.
fs::path default_output(const std::string& model) {
  fs::path path(model);
  return path.replace_extension("results");
}

/// What a checkpoint says about the origin of this run.
analysis::RunOrigin origin_of(const RunOptions& options, const model::Model& model, const fs::path& output,
                              int threads) {
  analysis::RunOrigin origin;
  std::error_code error;
  origin.version = result::version();
  origin.model = options.model;
  origin.folder = fs::current_path(error).string();
  const fs::path beside = fs::relative(options.model, output, error);
  if (!error) origin.beside = beside.string();
  origin.files.push_back(analysis::source_file(options.model));
  for (const std::string& file : model.files) origin.files.push_back(analysis::source_file(file));
  origin.settings = options.settings;
  origin.threads = threads;
  return origin;
}

}  // namespace

ExitStatus run(const RunOptions& options) {
  const Clock::time_point start = Clock::now();
  const model::Model model = input::read_model(options.model, parse_settings(options.settings));
  const double reading = std::chrono::duration<double>(Clock::now() - start).count();
  const auto output = options.output.empty() ? default_output(options.model) : options.output;
  if (model.analysis.type == model::AnalysisType::modal) return run_modal(model, output, options, reading);

  ignore_broken_pipes();
  // The model is checked before the directory is created or cleared, and the directory is created before the solve: a
  // mistake in either then costs seconds and no results. Meshing twice takes a hundredth of the time of a solve.
  mesh::Mesh mesh = analysis::check(model);
  result::check_sections(model, mesh);
  const Plan plan = plan_of(model, mesh);
  const Interrupt interrupt;
  result::ResultsDirectory directory(output, model, std::move(mesh));
  const int threads = threads_that_fit(options.threads);
  StaticRun begun{model, directory, interrupt, {}, reading, start, threads, options.quiet, plan, options.ignore_memory};
  if (keeps_checkpoints(model)) {
    begun.begun.origin = origin_of(options, model, output, threads);
    begun.begun.results = directory.written();
  }
  return solve_and_write(std::move(begun));
}

}  // namespace scabo::app
