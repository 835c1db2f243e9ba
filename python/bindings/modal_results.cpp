// Arrays of a modal analysis.
#include <pybind11/stl.h>

#include <docstrings.hpp>  // made by make_docstrings.py
#include <memory>

#include "arrays.hpp"
#include "solved.hpp"

namespace scabo::python {

namespace {

/// One dictionary for each mode: frequency (1 / time; 0 if rigid), rigid, modal_mass (shape' M shape), effective_mass
/// (of motions of the supports along x and y), residual (of K shape = omega^2 M shape, free of units), and shape:
/// arrays (nodes, 2) by the name of the body, without a copy, whose largest displacement of a node is 1.
py::list modes(const py::object& self) {
  const auto& solved = self.cast<const ModalRunResult&>();
  py::list list;
  for (const analysis::NaturalMode& mode : solved.result.modes) {
    py::dict shapes;
    for (std::size_t i = 0; i < mode.bodies.size(); ++i) {
      const auto body = static_cast<std::size_t>(mode.bodies[i]);
      shapes[py::str(solved.result.structure.model.bodies[body].name)] = view(mode.shape[i], 2, self);
    }
    py::dict entry;
    entry["frequency"] = mode.frequency;
    entry["rigid"] = mode.rigid;
    entry["modal_mass"] = mode.modal_mass;
    entry["effective_mass"] = py::make_tuple(mode.effective_mass.x(), mode.effective_mass.y());
    entry["residual"] = mode.residual;
    entry["shape"] = shapes;
    list.append(entry);
  }
  return list;
}

/// Positions of the nodes of a body, (nodes, 2), length.
py::array nodes(const py::object& self, std::size_t body) {
  return view(self.cast<const ModalRunResult&>().result.structure.mesh.bodies.at(body).nodes, self);
}

double total_mass(const ModalRunResult& solved) { return solved.result.total_mass; }

/// Names of all bodies, in the order of the model.
std::vector<std::string> bodies(const ModalRunResult& solved) {
  std::vector<std::string> names;
  for (const model::Body& body : solved.result.structure.model.bodies) names.push_back(body.name);
  return names;
}

}  // namespace

void bind_modal_results(py::module_& module) {
  py::class_<ModalRunResult, std::shared_ptr<ModalRunResult>>(module, "ModalResult", doc::solved::ModalRunResult)
      .def_readonly("record", &ModalRunResult::record, doc::solved::ModalRunResult_record)
      .def_property_readonly("total_mass", &total_mass, doc::modal_analysis::ModalResult_total_mass)
      .def_property_readonly("bodies", &bodies, doc::modal_results::bodies)
      .def("modes", &modes, doc::modal_results::modes)
      .def("nodes", &nodes, py::arg("body"), doc::modal_results::nodes);
}

}  // namespace scabo::python
