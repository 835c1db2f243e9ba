// Runs of this program as processes of their own: what ends one of them ends no other.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scabo::app {

/// A running process; it ends with the increment that it works on if this program ends.
class ChildProcess {
 public:
  /// Starts this program with other arguments. Its standard output and error go to `output`. Throws std::runtime_error.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& output);

  /// Its exit status as in a shell (128 and the signal if one ended it), or nothing while it runs.
  std::optional<int> ended();
  /// Asks it to end.
  void stop(int signal) const;

 private:
  pid_t id_ = -1;
};

}  // namespace scabo::app
