// Arrays of a modal analysis.
#include <pybind11/stl.h>

#include <memory>

#include "arrays.hpp"
#include "solved.hpp"

namespace scabo::python {

namespace {

/// One dictionary for each mode; shapes are arrays (n, 2) by the name of the body.
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

py::array nodes(const py::object& self, std::size_t body) {
  return view(self.cast<const ModalRunResult&>().result.structure.mesh.bodies.at(body).nodes, self);
}

}  // namespace

void bind_modal_results(py::module_& module) {
  py::class_<ModalRunResult, std::shared_ptr<ModalRunResult>>(module, "ModalResult")
      .def_readonly("record", &ModalRunResult::record)
      .def_property_readonly("total_mass", [](const ModalRunResult& solved) { return solved.result.total_mass; })
      .def_property_readonly("bodies",
                             [](const ModalRunResult& solved) {
                               std::vector<std::string> names;
                               for (const model::Body& body : solved.result.structure.model.bodies)
                                 names.push_back(body.name);
                               return names;
                             })
      .def("modes", &modes)
      .def("nodes", &nodes, py::arg("body"));
}

}  // namespace scabo::python
