// The report that `scabo run --report` writes when the run has ended.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exit_status.hpp"

namespace scabo::app {

/// Made before the run, so that what a report needs is missed before the work and not after it.
class ReportAtEnd {
 public:
  /// Throws std::runtime_error if there is no Python with NumPy, or no page to fill.
  ReportAtEnd();

  /// Writes the report beside the results. Returns `status`, or `failure` if the run is solved and the report could
  /// not be written.
  ExitStatus write(const std::filesystem::path& directory, ExitStatus status, bool quiet) const;

 private:
  std::vector<std::string> command_;
};

}  // namespace scabo::app
