// The results of a run that is ended by an error.
#pragma once

#include <exception>
#include <filesystem>
#include <new>

#include "scabo/result/results_directory.hpp"
#include "startup.hpp"

namespace scabo::app {

/// Returns the result of the function. If it throws, the failure is recorded in summary.json in `directory` before the
/// exception is passed on.
template <typename Function>
auto marking_failures(const std::filesystem::path& directory, Function function) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    result::mark_failed(directory, not_enough_memory);
    throw;
  } catch (const std::exception& error) {
    result::mark_failed(directory, error.what());
    throw;
  }
}

}  // namespace scabo::app
