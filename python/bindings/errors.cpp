// Exceptions of the library as those of scabo.errors, with the same text.
#include <new>

#include "bindings.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/result/files.hpp"
#include "scabo/run/failures.hpp"

namespace scabo::python {

namespace {

py::object error_class(const char* name) { return py::module_::import("scabo.errors").attr(name); }

void raise(const py::object& error) { PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr()); }

void raise_model_error(const InputError& error) {
  const py::object problem = error_class("Problem");
  py::list problems;
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    const bool placed = diagnostic.at.line > 0;
    problems.append(problem(diagnostic.at.path, placed ? py::object(py::int_(diagnostic.at.line)) : py::none(),
                            placed ? py::object(py::int_(diagnostic.at.column)) : py::none(), diagnostic.message));
  }
  raise(error_class("ModelError")(error.what(), error.file(), problems));
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise_model_error(error);
    } catch (const result::WriteError& error) {
      raise(error_class("WriteError")(error.what()));
    } catch (const element::IllPosed& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const BrokenInvariant& error) {
      raise(error_class("InternalError")(error.what()));
    } catch (const run::Stopped&) {
      raise(error_class("Interrupted")("interrupted; no increment was finished"));
    } catch (const run::NotEnoughMemory& error) {
      PyErr_SetString(PyExc_MemoryError, error.what());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError, run::not_enough_memory);
    }
  });
}

}  // namespace scabo::python
