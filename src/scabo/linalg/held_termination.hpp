// METIS takes SIGTERM for the sign of an error of its own: while it works, it handles the signal in place of the
// program, and jumps out of whatever was being done, also out of malloc, which then corrupts memory. While an object of
// this class exists the signal waits for its thread. New threads inherit that it waits, and keep it. METIS gives back
// the program's handler as one that is used once; it is therefore set anew. One object at a time exists: METIS draws
// from rand(), and of two threads one would take the other's handler for the program's.
#pragma once

#include <pthread.h>

#include <csignal>
#include <mutex>

namespace scabo::linalg {

class HeldTermination {
 public:
  HeldTermination() {
    sigaction(SIGTERM, nullptr, &handled_);
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldTermination() {
    sigaction(SIGTERM, &handled_, nullptr);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  HeldTermination(const HeldTermination&) = delete;
  HeldTermination& operator=(const HeldTermination&) = delete;

 private:
  static inline std::mutex one_at_a_time_;
  const std::lock_guard<std::mutex> lock_{one_at_a_time_};
  struct sigaction handled_ {};
  sigset_t before_;
};

}  // namespace scabo::linalg
