// METIS takes SIGTERM for the sign of an error of its own: while it works, it handles the signal in place of the
// program, and jumps out of whatever was being done, also out of malloc, which then corrupts memory. While an object of
// this class exists the signal waits for its thread. New threads inherit that it waits, and keep it. METIS gives back
// the program's handler as one that is used once; it is therefore set anew.
#pragma once

#include <pthread.h>

#include <csignal>

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
  struct sigaction handled_ {};
  sigset_t before_;
};

}  // namespace scabo::linalg
