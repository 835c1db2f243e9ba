#include "solids.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "commands.hpp"
#include "interrupt.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/model/imported_body.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/solid/solid_outputs.hpp"
#include "scabo/run/failures.hpp"
#include "scabo/run/solid_run.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

std::string bodies_of(const model::SpaceModel& model, const analysis::PosedSolids& posed) {
  std::vector<std::vector<std::string>> rows = {{"body", "nodes", "dofs", "cells"}};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const mesh::SolidMesh& mesh = posed.model.bodies[b].mesh;
    rows.push_back({model.bodies[b].name, fmt::format("{}", mesh.nodes.cols()),
                    fmt::format("{}", 3 * mesh.nodes.cols()), fmt::format("{}", mesh.cells.size())});
  }
  return result::table(rows);
}

/// Faces of bodies from files and of shapes that a library divides: their names cannot be known otherwise, and are told
/// before a contact of wrong ones is.
std::string faces_of(const model::SpaceModel& model) {
  std::vector<std::vector<std::string>> rows = {{"face", "area", "centre"}};
  for (const model::SpaceBody& body : model.bodies) {
    if (!body.mesh) continue;
    for (const files::SolidSideSet& set : body.mesh->side_sets) {
      double area = 0.0;
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (const files::SolidSide& side : set.sides) {
        for (const std::vector<int>& corners :
             files::triangles_of_side(body.mesh->cells[static_cast<std::size_t>(side.cell)], side.side)) {
          const Eigen::Matrix3d x = body.mesh->nodes(Eigen::all, corners);
          const Eigen::Vector3d a = x.col(1) - x.col(0), b = x.col(2) - x.col(0);
          const double of_triangle = 0.5 * a.cross(b).norm();
          area += of_triangle;
          centre += of_triangle * x.rowwise().mean();
        }
      }
      if (!(area > 0.0)) continue;
      centre = (centre / area).unaryExpr([&](double c) { return c * c < 1e-12 * area ? 0.0 : c; });
      rows.push_back({body.name + "." + model::name_from(set.name), fmt::format("{:.4g}", area),
                      fmt::format("{:.4g}, {:.4g}, {:.4g}", centre.x(), centre.y(), centre.z())});
    }
  }
  return rows.size() > 1 ? result::table(rows) + "\n" : "";
}

}  // namespace

ExitStatus check_solids(const model::SpaceModel& model) {
  for (const Warning& warning : model.warnings) print_warning(warning.text);
  print_output(
      fmt::format("{}: {}\n\n{}", model.file, model.title.empty() ? "(no title)" : model.title, faces_of(model)));
  const analysis::PosedSolids posed = analysis::pose_solids(model);
  const result::SolidOutputs outputs(model, posed);  // checks them
  const run::Plan plan = run::plan_of(posed);
  print_output(fmt::format("{}\n{}, {}, {}.\n{}No mistakes found.\n", bodies_of(model, posed),
                           model::counted(static_cast<long>(model.contacts.size()), "contact or tie"),
                           model::counted(static_cast<long>(model.steps.size()), "step"),
                           model::counted(static_cast<long>(posed.increments.size()), "increment"),
                           run::describe(plan)));
  warn_of_memory(plan);
  return ExitStatus::solved;
}

namespace {

/// A signal ends the run at once.
result::SolidEnd solve_until(const Interrupt& interrupt, const run::SolidRun& run) {
  const Interruptible::Ask ask = [&] {
    if (interrupt.requested()) throw run::Stopped{};
  };
  const Interruptible here(&ask);
  return run::solve(run);
}

ExitStatus solve_and_report(const run::SolidRun& run, bool quiet, Events& events) {
  const Interrupt interrupt;
  const result::SolidEnd end = solve_until(interrupt, run);
  for (const Warning& warning : end.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  if (end.status == "interrupted") {
    const std::string why = fmt::format(
        "{}: interrupted; {}{}", run.model.file,
        end.finished > 0 ? model::counted(end.finished, "finished increment") + " kept" : "no increment was finished",
        how_to_resume(run.directory));
    events.error(why);
    print_error(why);
    return static_cast<ExitStatus>(ExitStatus::signalled + interrupt.signal());
  }
  if (end.status != "solved") {
    const std::string why = fmt::format("{}: {}: {}", run.model.file, end.at, end.reason);
    events.error(why);
    print_error(why);
    return ExitStatus::not_converged;
  }
  if (!quiet)
    events.print_summary(fmt::format("{} solved, certificate {:.1e}\n{}Results: {}\n",
                                     model::counted(end.finished, "increment"), end.certificate, end.totals,
                                     run.directory.string()));
  return ExitStatus::solved;
}

/// Warnings and the plan, before the work.
run::Plan begin(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                const std::filesystem::path& directory, Events& events) {
  ignore_broken_pipes();
  events.files(model.file, directory, "space");
  for (const Warning& warning : model.warnings) {
    events.warning(warning);
    print_warning(warning.text);
  }
  const run::Plan plan = run::plan_of(posed);
  events.plan(plan);
  return plan;
}

}  // namespace

ExitStatus run_solids(const model::SpaceModel& model, const std::filesystem::path& directory, const RunOptions& options,
                      Events& events) {
  events.stage("checking");
  const analysis::PosedSolids posed = analysis::pose_solids(model);
  const result::SolidOutputs outputs(model, posed);  // checks them
  const run::Plan plan = begin(model, posed, directory, events);
  if (!options.ignore_memory)
    if (const std::string why =
            run::why_it_does_not_fit(plan, run::available_memory(), "start it with --ignore-memory");
        !why.empty())
      throw run::NotEnoughMemory(why);
  const int threads = threads_that_fit(options.threads);
  events.stage("solving");
  result::SolidResults results(directory, model, posed);
  run::SolidRun run{model, posed, results, directory, threads};
  run.begun.origin = run::origin_of(model, options.settings, directory, threads);
  return solve_and_report(run, options.quiet, events);
}

ExitStatus resume_solids(const model::SpaceModel& model, analysis::SolidCheckpoint begun, result::DirectoryLock lock,
                         const std::filesystem::path& directory, int threads, bool quiet, Events& events) {
  events.stage("checking");
  const analysis::PosedSolids posed = analysis::pose_solids(model);
  begin(model, posed, directory, events);
  events.stage("solving");
  result::SolidResults results(directory, std::move(lock), model, posed, begun.results);
  return solve_and_report({model, posed, results, directory, threads, std::move(begun)}, quiet, events);
}

}  // namespace scabo::app
