#include "interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace scabo::app {

namespace {

// Signal handlers may use only global, lock-free variables.
std::atomic<bool> stop_requested{false};
std::atomic<int> received{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void restore_default_handlers() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, SIG_DFL);
}

extern "C" void request_stop(int signal) {
  received = signal;
  stop_requested = true;
  restore_default_handlers();  // a second signal ends the program immediately
  // Except for SIGHUP: the shell and the system both send one when a terminal is closed.
  std::signal(SIGHUP, SIG_IGN);
  constexpr std::string_view message =
      "\nInterrupted: the run ends after the current increment, or now if none has begun (Ctrl-C again ends it "
      "immediately)\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
}

}  // namespace

Interrupt::Interrupt() {
  stop_requested = false;
  received = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler == SIG_IGN) continue;  // requested by nohup and for background jobs of a shell
    struct sigaction action {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;  // files being written must not fail with EINTR
    sigaction(signal, &action, nullptr);
  }
}

Interrupt::~Interrupt() { restore_default_handlers(); }

const std::atomic<bool>& Interrupt::requested() const { return stop_requested; }

int Interrupt::signal() const { return received; }

}  // namespace scabo::app
