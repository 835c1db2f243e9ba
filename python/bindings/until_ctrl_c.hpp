// Work without a callback that Ctrl-C ends.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "bindings.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/run/failures.hpp"

namespace scabo::python {

/// Time between two looks for signals: each needs the interpreter lock.
constexpr std::chrono::milliseconds between_looks{100};

/// Raises an exception that Python holds.
[[noreturn]] inline void raise(const py::object& error) {
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
  throw py::error_already_set();
}

/// What is raised by the handlers of signals that have arrived; None if none has, or in another thread than the main
/// one. With the interpreter lock.
inline py::object raised_by_signals() {
  if (PyErr_CheckSignals() == 0) return py::none();
  py::error_already_set raised;
  py::object error = raised.value();
  if (raised.trace()) error.attr("__traceback__") = raised.trace();
  return error;
}

/// Returns the result of `work`, which runs without the interpreter lock. At its interruption points signals are looked
/// for; an exception of a handler, as KeyboardInterrupt, ends the work and is raised.
template <typename Work>
auto until_ctrl_c(const Work& work) {
  py::object error = py::none();
  std::atomic<bool> stopped{false};
  const std::thread::id thread = std::this_thread::get_id();
  auto looked = std::chrono::steady_clock::now();
  const Interruptible::Ask ask = [&] {
    if (!stopped && std::this_thread::get_id() == thread &&
        std::chrono::steady_clock::now() - looked >= between_looks) {
      const py::gil_scoped_acquire acquire;
      error = raised_by_signals();
      stopped = !error.is_none();
      looked = std::chrono::steady_clock::now();
    }
    if (stopped) throw run::Stopped{};
  };
  try {
    const py::gil_scoped_release release;
    const Interruptible here(&ask);
    return work();
  } catch (const run::Stopped&) {
    raise(error);
  }
}

}  // namespace scabo::python
