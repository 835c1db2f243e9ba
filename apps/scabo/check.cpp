// `scabo check` and `scabo schema`: information about a model without solving it.
#include <fmt/format.h>

#include "commands.hpp"
#include "plot.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/input/space/read_solid_model.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/report.hpp"
#include "scabo/run/plan.hpp"
#include "solids.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

std::string bodies_table(const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<std::vector<std::string>> rows = {{"body", "nodes", "dofs", "mesh"}};
  for (size_t i = 0; i < model.bodies.size(); ++i) {
    const mesh::BodyMesh& body = mesh.bodies[i];
    const int super_elements = body.count(mesh::CellKind::superelement);
    const int finite = body.count(mesh::CellKind::finite_element);
    std::string kind = model.bodies[i].rigid ? "rigid" : "";
    if (super_elements > 0) kind = model::counted(static_cast<size_t>(super_elements), "super-element");
    if (finite > 0) kind += (kind.empty() ? "" : ", ") + model::counted(static_cast<size_t>(finite), "finite element");
    rows.push_back(
        {model.bodies[i].name, fmt::format("{}", body.nodes.size()), fmt::format("{}", 2 * body.nodes.size()), kind});
  }
  return result::table(rows);
}

std::string contacts_table(const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<std::vector<std::string>> rows = {{"contact", "between", "law", "pairs"}};
  const std::vector<int> pairs = run::moving_pairs(model, mesh);
  for (size_t i = 0; i < mesh.interfaces.size(); ++i) {
    const model::Contact& contact = model.contacts[mesh.interfaces[i].contact];
    rows.push_back({contact.name, contact.a.text + ", " + contact.b.text, result::describe_law(contact),
                    fmt::format("{}", pairs[i])});
  }
  return result::table(rows);
}

std::string increments_text(const model::Step& step) {
  if (step.growth || step.limit) return "as many as it takes";
  if (!step.automatic) return fmt::format("{}", step.increments);
  return fmt::format("auto, {:g} to {:g} of the step", step.automatic->smallest, step.automatic->largest);
}

std::string steps_table(const model::Model& model) {
  if (model.analysis.type == model::AnalysisType::modal)
    return fmt::format("Modal analysis: the lowest {}.\n", model::counted(model.analysis.modes, "mode"));
  std::vector<std::vector<std::string>> rows = {{"step", "increments"}};
  for (const model::Step& step : model.steps) rows.push_back({step.name, increments_text(step)});
  return result::table(rows) + result::report_ground(model);
}

}  // namespace

void warn_of_memory(const run::Plan& plan) {
  const std::string why = run::why_it_does_not_fit(plan, run::available_memory(), "start the run with --ignore-memory");
  if (!why.empty()) print_warning(why);
}

ExitStatus check(const CheckOptions& options) {
  const input::AnyModel read = input::read_any_model(options.model, input::parse_settings(options.settings));
  if (const auto* solids = std::get_if<model::SpaceModel>(&read)) {
    if (options.plot)
      throw InputError(options.model, {{{}, "--plot: there are pictures of models in the plane alone"}});
    return check_solids(*solids);
  }
  const auto& model = std::get<model::Model>(read);
  const mesh::Mesh mesh = analysis::check(model);
  if (model.analysis.type == model::AnalysisType::static_) result::check_sections(model, mesh);
  for (const Warning& warning : model.warnings) print_warning(warning.text);
  std::string text = fmt::format("{}: {}\n", options.model, model.title.empty() ? "(no title)" : model.title);
  if (model.analysis.type == model::AnalysisType::modal) {
    text += run::describe_sizes(run::sizes_of(model, mesh)) + "\n";
  } else {
    const run::Plan plan = run::plan_of(model, mesh);
    text += run::describe(plan);
    warn_of_memory(plan);
  }
  text += "\n" + bodies_table(model, mesh);
  if (!mesh.interfaces.empty()) text += "\n" + contacts_table(model, mesh);
  text += "\n" + steps_table(model) + "\nNo mistakes found.\n";
  print_output(text);
  return options.plot ? draw_model(model, mesh, {options.model}) : ExitStatus::solved;
}

ExitStatus print_schema() {
  print_output(fmt::format("{}\n", input::model_schema()));
  return ExitStatus::solved;
}

}  // namespace scabo::app
