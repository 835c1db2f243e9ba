#include "bindings.hpp"
#include "scabo/linalg/blas_kernels.hpp"
#include "scabo/result/version.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace scabo;
  // NumPy may use the same library for its products: kernels change now, and not between two of its results.
  linalg::choose_blas_kernels();
  module.doc() = "Compiled part of Scabo; use the package `scabo`.";
  module.attr("version") = std::string(result::version());
  python::bind_errors(module);
  python::bind_models(module);
  python::bind_runs(module);
  python::bind_static_results(module);
  python::bind_space_results(module);
  python::bind_modal_results(module);
  python::bind_super_elements(module);
  python::bind_contact(module);
}
