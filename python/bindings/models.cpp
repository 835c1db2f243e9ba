// Reading and checking of models.
#include "models.hpp"

#include <pybind11/stl.h>

#include <docstrings.hpp>  // made by make_docstrings.py
#include <numeric>
#include <variant>

#include "bindings.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/input/document.hpp"
#include "scabo/input/settings.hpp"
#include "scabo/input/text_file.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/solid/solid_outputs.hpp"
#include "scabo/run/plan.hpp"
#include "scabo/run/solid_run.hpp"
#include "tree.hpp"

namespace scabo::python {

namespace {

/// Reads a model file with settings, `path=value` each. Also checks the model: what is wrong with the text and what is
/// wrong with the model is reported together. Raises ModelError with every mistake.
Document read(const std::string& file, const std::vector<std::string>& settings) {
  const py::gil_scoped_release release;
  Document document{file, settings, nullptr};
  auto [root, model] = input::parse_document(input::read_text_file(file), file, input::parse_settings(settings));
  document.root = std::move(root);
  document.text = std::visit([](const auto& of) { return of.text; }, model);
  return document;
}

/// The content as dictionaries, lists, numbers, bool, text and None, which are new with every call.
py::object data(const Document& document) { return to_python(*document.root); }

/// Reads and checks a model that is a dictionary. `file`: stands in messages, and files that the model names are
/// relative to its folder. `document`: what the dictionary was read from, or None; unchanged parts keep their lines in
/// messages. Raises ModelError with every mistake, and TypeError for values that a model cannot contain.
CheckedModel checked_model(py::handle data, const std::string& file, const Document* document) {
  CheckedModel checked;
  const Stopwatch reading(checked.reading);
  const input::NodePtr before = document ? document->root : nullptr;
  const input::NodePtr root = tree_of(data, before, file);
  const py::gil_scoped_release release;
  checked.is_of_file = document && root == before;
  if (checked.is_of_file) checked.settings = document->settings;
  std::visit(
      [&](auto&& model) {
        if (checked.is_of_file) model.text = document->text;
        if constexpr (std::is_same_v<std::decay_t<decltype(model)>, model::SpaceModel>)
          checked.space = std::make_shared<const model::SpaceModel>(std::move(model));
        else
          checked.model = std::move(model);
      },
      input::model_of_tree(root, file));
  return checked;
}

/// Meshes the model without solving it, as `scabo check` does: numbers of bodies, nodes, dofs, super_elements,
/// finite_elements, contact_pairs (those that can move), contacts (such pairs of each), increments; memory_bytes and
/// seconds are estimates, usually right within a factor of two. Raises ModelError.
py::dict sizes(const CheckedModel& checked) {
  run::Plan plan;
  std::vector<int> pairs;
  if (checked.space) {
    const py::gil_scoped_release release;
    const analysis::PosedSolids posed = analysis::pose_solids(*checked.space);
    const result::SolidOutputs outputs(*checked.space, posed);  // checks them
    plan = run::plan_of(posed);
    pairs = analysis::count_pairs(posed.model);
    plan.sizes.contact_pairs = std::accumulate(pairs.begin(), pairs.end(), 0);
  } else {
    const py::gil_scoped_release release;
    const mesh::Mesh mesh = analysis::check(checked.model);
    if (checked.model.analysis.type == model::AnalysisType::static_) result::check_sections(checked.model, mesh);
    plan = run::plan_of(checked.model, mesh);
    pairs = run::moving_pairs(checked.model, mesh);
  }
  py::dict contacts;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    contacts[py::str(checked.space ? checked.space->contacts[i].name : checked.model.contacts[i].name)] = pairs[i];
  py::dict found;
  found["bodies"] = plan.sizes.bodies;
  found["nodes"] = plan.sizes.nodes;
  found["dofs"] = plan.sizes.dofs;
  found["super_elements"] = plan.sizes.super_elements;
  found["finite_elements"] = plan.sizes.finite_elements;
  found["contact_pairs"] = plan.sizes.contact_pairs;
  found["contacts"] = contacts;
  found["increments"] = plan.increments;
  found["memory_bytes"] = plan.bytes;
  found["seconds"] = plan.seconds();
  return found;
}

template <typename Part>
std::vector<std::string> names_of(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  for (const Part& part : parts) names.push_back(part.name);
  return names;
}

/// Whether the analysis is one of natural frequencies (`type: modal`), not a static one.
bool is_modal(const CheckedModel& checked) { return checked.model.analysis.type == model::AnalysisType::modal; }

/// Names of the bodies, in the order of the model.
std::vector<std::string> bodies(const CheckedModel& checked) {
  return checked.space ? names_of(checked.space->bodies) : names_of(checked.model.bodies);
}

/// Whether it is a model in space.
bool is_in_space(const CheckedModel& checked) { return checked.space != nullptr; }

/// What the checks warn of, one sentence each.
std::vector<std::string> warnings(const CheckedModel& checked) {
  return texts_of(checked.space ? checked.space->warnings : checked.model.warnings);
}

/// JSON Schema of the model file, as text.
std::string schema() { return std::string(input::model_schema()); }

}  // namespace

void bind_models(py::module_& module) {
  py::class_<Document>(module, "Document", doc::models::Document)
      .def_readonly("file", &Document::file, doc::models::Document_file)
      .def("data", &data, doc::models::data);
  py::class_<CheckedModel>(module, "CheckedModel", doc::models::CheckedModel)
      .def_property_readonly("is_modal", &is_modal, doc::models::is_modal)
      .def_property_readonly("is_in_space", &is_in_space, doc::models::is_in_space)
      .def_property_readonly("bodies", &bodies, doc::models::bodies)
      .def_property_readonly("warnings", &warnings, doc::models::warnings)
      .def("sizes", &sizes, doc::models::sizes);
  module.def("read", &read, py::arg("file"), py::arg("settings"), doc::models::read);
  module.def("checked_model", &checked_model, py::arg("data"), py::arg("file"), py::arg("document").none(true),
             doc::models::checked_model);
  module.def("schema", &schema, doc::models::schema);
}

}  // namespace scabo::python
