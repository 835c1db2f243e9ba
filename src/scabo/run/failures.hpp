// The results of a run that is ended by an error.
#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "scabo/result/results_directory.hpp"

namespace scabo::run {

/// Thrown by who observes a run, to end it at once, before its first increment has finished: it is then `interrupted`,
/// without increments.
struct Stopped {};

/// The estimated memory is not available; says how to start nevertheless.
struct NotEnoughMemory : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What std::bad_alloc means.
constexpr const char* not_enough_memory =
    "not enough memory for this model or problem: make its mesh coarser (`scabo check` prints the sizes), or raise the "
    "limit (`ulimit -v`)";

/// Returns the result of the function. If it throws, the failure is recorded in summary.json in `directory` before the
/// exception is passed on.
template <typename Function>
auto marking_failures(const std::filesystem::path& directory, Function function) {
  try {
    return function();
  } catch (const Stopped&) {
    result::mark_failed(directory, "interrupted");
    throw;
  } catch (const std::bad_alloc&) {
    result::mark_failed(directory, not_enough_memory);
    throw;
  } catch (const std::exception& error) {
    result::mark_failed(directory, error.what());
    throw;
  }
}

}  // namespace scabo::run
