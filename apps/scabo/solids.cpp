#include "solids.hpp"

#include <fmt/format.h>

#include "scabo/contact/status_name.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/solid/solid_results.hpp"
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
  print_output(fmt::format("{}: {}\n\n{}\n{}, {}, {}.\nNo mistakes found.\n", model.file,
                           model.title.empty() ? "(no title)" : model.title, bodies_of(model, posed),
                           model::counted(static_cast<long>(model.contacts.size()), "contact or tie"),
                           model::counted(static_cast<long>(model.steps.size()), "step"),
                           model::counted(static_cast<long>(posed.increments.size()), "increment")));
  return ExitStatus::solved;
}

ExitStatus run_solids(const model::SpaceModel& model, const std::filesystem::path& directory, const RunOptions& options,
                      Events& events) {
  if (options.report)
    throw InputError(model.file, {{{},
                                   "is a model in space, of which there is no page for the browser: run it "
                                   "without --report, and open fields.pvd in ParaView"}});
  const analysis::PosedSolids posed = analysis::pose_solids(model);
  ignore_broken_pipes();
  for (const Warning& warning : model.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  const auto increments = run::solve({model, posed, directory, threads_that_fit(options.threads)});
  const analysis::SolidIncrement& last = increments.back();
  const auto& [step, number] = posed.step_and_number[increments.size() - 1];
  if (last.status != contact::Status::solved) {
    print_error(fmt::format("{}: step {}, increment {}: {}: {}", model.file, model.steps[step].name, number,
                            contact::name_of(last.status), last.reason));
    return ExitStatus::not_converged;
  }
  if (!options.quiet)
    events.print_summary(fmt::format("{} solved, certificate {:.1e}\n{}Results: {}\n",
                                     model::counted(static_cast<long>(increments.size()), "increment"),
                                     last.certificate.worst(), result::report_solids(model, posed, last),
                                     directory.string()));
  return ExitStatus::solved;
}

}  // namespace scabo::app
