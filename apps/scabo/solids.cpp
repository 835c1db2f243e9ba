#include "solids.hpp"

#include <fmt/format.h>

#include <optional>

#include "interrupt.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/contact/status_name.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/solid/solid_results.hpp"
#include "scabo/run/failures.hpp"
#include "scabo/run/solid_run.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

std::string bodies_of(const model::SpaceModel& model, const analysis::PosedSolids& posed) {
  std::vector<std::vector<std::string>> rows = {{"body", "nodes", "dofs", "tetrahedra"}};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const mesh::SolidMesh& mesh = posed.model.bodies[b].mesh;
    rows.push_back({model.bodies[b].name, fmt::format("{}", mesh.nodes.cols()),
                    fmt::format("{}", 3 * mesh.nodes.cols()), fmt::format("{}", mesh.cells.size())});
  }
  return result::table(rows);
}

}  // namespace

ExitStatus check_solids(const model::SpaceModel& model) {
  const analysis::PosedSolids posed = analysis::pose_solids(model);
  for (const Warning& warning : model.warnings) print_warning(warning.text);
  print_output(fmt::format(
      "{}: {}\n\n{}\n{}, {}, {}.\n{}No mistakes found.\n", model.file, model.title.empty() ? "(no title)" : model.title,
      bodies_of(model, posed), model::counted(static_cast<long>(model.contacts.size()), "contact or tie"),
      model::counted(static_cast<long>(model.steps.size()), "step"),
      model::counted(static_cast<long>(posed.increments.size()), "increment"), run::describe(run::plan_of(posed))));
  return ExitStatus::solved;
}

namespace {

/// All increments; nothing if a signal has ended the run before they were made.
std::optional<std::vector<analysis::SolidIncrement>> solve_until(const Interrupt& interrupt, const run::SolidRun& run) {
  const Interruptible::Ask ask = [&] {
    if (interrupt.requested()) throw run::Stopped{};
  };
  const Interruptible here(&ask);
  try {
    return run::solve(run);
  } catch (const run::Stopped&) {
    return std::nullopt;
  }
}

ExitStatus solve_and_report(const run::SolidRun& run, bool quiet, Events& events) {
  const Interrupt interrupt;
  const auto increments = solve_until(interrupt, run);
  if (!increments) {
    const std::string why =
        fmt::format("{}: interrupted; increments that were finished are in {}", run.model.file, run.output.string());
    events.error(why);
    print_error(why);
    return static_cast<ExitStatus>(ExitStatus::signalled + interrupt.signal());
  }
  const analysis::SolidIncrement& last = increments->back();
  const auto& [step, number] = run.posed.step_and_number[increments->size() - 1];
  if (last.status != contact::Status::solved) {
    const std::string why = fmt::format("{}: step {}, increment {}: {}: {}", run.model.file, run.model.steps[step].name,
                                        number, contact::name_of(last.status), last.reason);
    events.error(why);
    print_error(why);
    return ExitStatus::not_converged;
  }
  if (!quiet)
    events.print_summary(fmt::format("{} solved, certificate {:.1e}\n{}Results: {}\n",
                                     model::counted(static_cast<long>(increments->size()), "increment"),
                                     last.certificate.worst(), result::report_solids(run.model, run.posed, last),
                                     run.output.string()));
  return ExitStatus::solved;
}

}  // namespace

ExitStatus run_solids(const model::SpaceModel& model, const std::filesystem::path& directory, const RunOptions& options,
                      Events& events) {
  if (options.report)
    throw InputError(model.file, {{{},
                                   "is a model in space, of which there is no page for the browser: run it "
                                   "without --report, and draw it by `scabo plot`"}});
  events.stage("checking");
  const analysis::PosedSolids posed = analysis::pose_solids(model);
  ignore_broken_pipes();
  events.files(model.file, directory, "space");
  for (const Warning& warning : model.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  const run::Plan plan = run::plan_of(posed);
  events.plan(plan);
  if (!options.ignore_memory)
    if (const std::string why =
            run::why_it_does_not_fit(plan, run::available_memory(), "start it with --ignore-memory");
        !why.empty())
      throw run::NotEnoughMemory(why);
  events.stage("solving");
  return solve_and_report({model, posed, directory, threads_that_fit(options.threads)}, options.quiet, events);
}

}  // namespace scabo::app
