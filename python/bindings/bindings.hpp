// The parts of the extension module scabo._core; each adds its classes and functions. What users see is written in
// Python (python/scabo) on top of it.
#pragma once

#include <pybind11/pybind11.h>

namespace scabo::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_models(py::module_& module);
void bind_runs(py::module_& module);
void bind_static_results(py::module_& module);
void bind_space_results(py::module_& module);
void bind_modal_results(py::module_& module);
void bind_super_elements(py::module_& module);
void bind_contact(py::module_& module);

}  // namespace scabo::python
