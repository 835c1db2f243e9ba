// `scabo plot`: pictures of results by the Python program beside this one (python/scabo/plot). This process becomes
// that program, so that its output and exit status are those of the command.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

namespace fs = std::filesystem;

/// Prints what an interpreter lacks, one word a line.
constexpr const char* probe = R"py(import sys
from importlib.util import find_spec
if sys.version_info < (3, 9): print("Python 3.9 (this is %d.%d)" % sys.version_info[:2])
for name in ("numpy", "matplotlib"):
    if find_spec(name) is None: print(name))py";

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What the interpreter lacks; empty if nothing.
std::string missing_in(const std::string& interpreter) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  std::vector<std::string> words = {interpreter, "-c", probe};
  const std::vector<char*> arguments = pointers_to(words);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process");
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  std::string said;
  char buffer[512];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0 || (n < 0 && errno == EINTR);)
    if (n > 0) said.append(buffer, static_cast<size_t>(n));
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) return "not found";
  while (!said.empty() && said.back() == '\n') said.pop_back();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return "does not run" + (said.empty() ? "" : ": " + said.substr(said.rfind('\n') + 1));
  if (said.empty()) return "";
  for (size_t at; (at = said.find('\n')) != std::string::npos;) said.replace(at, 1, ", ");
  return "lacks " + said;
}

/// The interpreter named by SCABO_PYTHON, otherwise the distribution's or the first on PATH.
std::string find_interpreter() {
  const char* named = std::getenv("SCABO_PYTHON");
  const std::vector<std::string> candidates =
      named && *named ? std::vector<std::string>{named} : std::vector<std::string>{"/usr/bin/python3", "python3"};
  std::string report;
  for (const std::string& candidate : candidates) {
    const std::string missing = missing_in(candidate);
    if (missing.empty()) return candidate;
    report += fmt::format("{}{} {}", report.empty() ? "" : "; ", candidate, missing);
  }
  throw std::runtime_error(fmt::format(
      "no Python with NumPy and Matplotlib for pictures: {}. Install them (apt install python3-matplotlib), "
      "or name another interpreter with SCABO_PYTHON",
      report));
}

/// Beside the program, in the build directory as where it is installed.
fs::path find_pictures() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error)
    throw std::runtime_error(fmt::format("cannot find the place of this program in /proc: {}", error.message()));
  const fs::path folder = (program.parent_path() / SCABO_BIN_TO_DATA / "scabo" / "scabo_plot").lexically_normal();
  if (!fs::exists(folder / "__main__.py", error))
    throw std::runtime_error(
        fmt::format("the program for pictures is not at {}: install Scabo completely (make install)", folder.string()));
  return folder;
}

}  // namespace

ExitStatus plot(const std::vector<std::string>& arguments) {
  const std::string folder = find_pictures().string();
  std::vector<std::string> words = {find_interpreter(), "-B", folder};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<char*> pointers = pointers_to(words);
  execvp(pointers[0], pointers.data());
  throw std::runtime_error(fmt::format("cannot start {}: {}", words[0], std::strerror(errno)));
}

}  // namespace scabo::app
