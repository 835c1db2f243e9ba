// `scabo run`: from the model file to certified results on disk.
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "cluster.hpp"
#include "commands.hpp"
#include "report.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/result/history.hpp"
#include "solids.hpp"
#include "startup.hpp"
#include "static_run.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// `model.results` beside `model.yaml`.
fs::path default_output(const std::string& model) {
  fs::path path(model);
  return path.replace_extension("results");
}

ExitStatus run(const RunOptions& options, Cluster* cluster, Events& events) {
  const Clock::time_point start = Clock::now();
  events.stage("reading");
  std::error_code error;
  if (const fs::file_status model = fs::status(options.model, error);
      cluster && fs::exists(model) && !fs::is_regular_file(model) && !fs::is_directory(model))
    throw InputError(options.model, {{{}, "is a pipe or a device, but every rank reads the model: save it as a file"}});
  const input::AnyModel read = input::read_any_model(options.model, input::parse_settings(options.settings));
  const double reading = std::chrono::duration<double>(Clock::now() - start).count();
  const auto output = options.output.empty() ? default_output(options.model) : options.output;
  std::optional<ReportAtEnd> report_at_end;
  if (options.report) report_at_end.emplace();
  const auto reported = [&](ExitStatus status) {  // after a signal the user wants an end, not another program
    if (!report_at_end || status >= ExitStatus::signalled) return status;
    events.stage("report");
    return report_at_end->write(output, status, options.quiet || options.json_lines);
  };
  if (const auto* solids = std::get_if<model::SpaceModel>(&read))
    return reported(run_solids(*solids, output, options, events));
  const auto& model = std::get<model::Model>(read);
  if (cluster && !analysis::can_use_ranks(model)) {
    print_warning(
        fmt::format("{}: one of the {} ranks does all of it", analysis::why_no_ranks, cluster->ranks().count()));
    cluster = nullptr;
  }
  if (model.analysis.type == model::AnalysisType::modal)
    return reported(run_modal(model, output, options, reading, events));

  ignore_broken_pipes();
  // The model is checked before the directory is created or cleared, and the directory is created before the solve: a
  // mistake in either then costs seconds and no results. Meshing twice takes a hundredth of the time of a solve.
  events.stage("checking");
  mesh::Mesh mesh = analysis::check(model);
  result::check_sections(model, mesh);
  run::Plan plan = run::plan_of(model, mesh);
  if (cluster) plan.bytes *= cluster->part_on_this_machine();
  const Interrupt interrupt;
  result::ResultsDirectory directory(output, model, std::move(mesh));
  run::StaticRun run{model, &directory};
  run.threads = threads_that_fit(options.threads);
  if (cluster) use(*cluster, model.file, options.settings, options.divide_from, run);
  run.reading = reading;
  run.start = start;
  run.plan = plan;
  if (!options.ignore_memory) run.anyway = "start it with --ignore-memory";
  if (run::keeps_checkpoints(model)) {
    run.begun.origin = run::origin_of(model, options.settings, output, run.threads);
    run.begun.results = directory.written();
  }
  return reported(solve_and_report(std::move(run), interrupt, events, options.quiet));
}

}  // namespace

ExitStatus run(const RunOptions& options, Cluster* cluster) {
  Events events(options.json_lines);
  return events.around("run", [&] { return run(options, cluster, events); });
}

}  // namespace scabo::app
