#include "bindings.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/result/version.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace scabo;
  module.doc() = "Compiled part of Scabo; use the package `scabo`.";
  module.attr("version") = std::string(result::version());
  python::bind_errors(module);
  python::bind_models(module);
  python::bind_runs(module);
  python::bind_static_results(module);
  python::bind_modal_results(module);
  python::bind_super_elements(module);
  python::bind_contact(module);
}
