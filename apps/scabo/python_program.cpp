// Programs in Python beside this one: where they are, which interpreter runs them, and how they are started.
#include "python_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace scabo::app {

namespace {

namespace fs = std::filesystem;

/// Prints what an interpreter lacks of the modules that follow it, one word a line.
constexpr const char* probe = R"py(import sys
from importlib.util import find_spec
if sys.version_info < (3, 9): print("Python 3.9 (this is %d.%d)" % sys.version_info[:2])
for name in sys.argv[1:]:
    if find_spec(name) is None: print(name))py";

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What the interpreter lacks; empty if nothing.
std::string missing_in(const std::string& interpreter, const std::vector<std::string>& modules) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  std::vector<std::string> words = {interpreter, "-c", probe};
  words.insert(words.end(), modules.begin(), modules.end());
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

std::string find_interpreter(const PythonProgram& program) {
  const char* named = std::getenv("SCABO_PYTHON");
  const std::vector<std::string> candidates =
      named && *named ? std::vector<std::string>{named} : std::vector<std::string>{"/usr/bin/python3", "python3"};
  std::string report;
  for (const std::string& candidate : candidates) {
    const std::string missing = missing_in(candidate, program.modules);
    if (missing.empty()) return candidate;
    report += fmt::format("{}{} {}", report.empty() ? "" : "; ", candidate, missing);
  }
  throw std::runtime_error(fmt::format(
      "no Python with {} for {}: {}. Install {} (apt install {}), or name another interpreter with SCABO_PYTHON",
      program.needs, program.purpose, report, program.modules.size() > 1 ? "them" : "it", program.package));
}

[[noreturn]] void fail_to_start(const std::string& interpreter, int error) {
  throw std::runtime_error(fmt::format("cannot start {}: {}", interpreter, std::strerror(error)));
}

}  // namespace

PythonProgram pictures() {
  return {"scabo_plot", "pictures", {"numpy", "matplotlib"}, "NumPy and Matplotlib", "python3-matplotlib"};
}

PythonProgram reports() { return {"scabo_report", "reports", {"numpy"}, "NumPy", "python3-numpy"}; }

fs::path data_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error)
    throw std::runtime_error(fmt::format("cannot find the place of this program in /proc: {}", error.message()));
  return (program.parent_path() / SCABO_BIN_TO_DATA / "scabo").lexically_normal();
}

std::vector<std::string> command_of(const PythonProgram& program) {
  const fs::path folder = data_folder() / program.folder;
  std::error_code error;
  if (!fs::exists(folder / "__main__.py", error))
    throw std::runtime_error(fmt::format("the program for {} is not at {}: install Scabo completely (make install)",
                                         program.purpose, folder.string()));
  return {find_interpreter(program), "-B", folder.string()};
}

ExitStatus become(std::vector<std::string> command, const std::vector<std::string>& arguments) {
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::vector<char*> pointers = pointers_to(command);
  execvp(pointers[0], pointers.data());
  fail_to_start(command[0], errno);
}

int run_and_wait(std::vector<std::string> command, const std::vector<std::string>& arguments) {
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::vector<char*> pointers = pointers_to(command);
  const pid_t child = fork();
  if (child < 0) fail_to_start(command[0], errno);
  if (child == 0) {
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace scabo::app
