// Ctrl-C (SIGINT), SIGTERM and SIGHUP (the terminal was closed). The first signal requests the run to end after the
// current increment, so that all finished results are complete on disk; a second SIGINT or SIGTERM ends the program
// immediately.
#pragma once

#include <atomic>

namespace scabo::app {

class Interrupt {
 public:
  Interrupt();   ///< starts to catch signals
  ~Interrupt();  ///< restores the default handlers
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// True after a signal has arrived; analysis::Options::stop points to this.
  const std::atomic<bool>& requested() const;
  /// The signal that has arrived, or 0.
  int signal() const;
};

}  // namespace scabo::app
