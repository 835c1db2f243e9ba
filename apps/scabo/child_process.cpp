#include "child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

namespace scabo::app {

namespace {

[[noreturn]] void fail_to_start(const std::string& what, int error) {
  throw std::runtime_error(fmt::format("cannot {}: {}", what, std::system_category().message(error)));
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& output) {
  const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail_to_start("write " + output.string(), errno);
  std::error_code error;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", error).string();
  if (error) fail_to_start("find the program that runs", error.value());
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ == 0) {
    // Only calls that are allowed between fork and exec. A process group of its own: Ctrl-C reaches the sweep alone,
    // which passes it on once.
    ::setpgid(0, 0);
#if defined(__linux__)
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(128 + SIGTERM);
#endif
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::execv(pointers.front(), pointers.data());
    ::_exit(127);
  }
  const int reason = errno;
  ::close(file);
  if (id_ < 0) fail_to_start("start a run", reason);
}

std::optional<int> ChildProcess::ended() {
  int status = 0;
  const pid_t done = ::waitpid(id_, &status, WNOHANG);
  if (done == 0 || (done < 0 && errno == EINTR)) return {};
  if (done < 0) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void ChildProcess::stop(int signal) const { ::kill(id_, signal); }

}  // namespace scabo::app
