// What a run leaves when an error ends it.
#pragma once

#include <exception>
#include <filesystem>
#include <new>

#include "scabo/result/results_directory.hpp"
#include "startup.hpp"

namespace scabo::app {

/// What the function gives; where it throws, summary.json in `directory` says so before the error goes on.
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
