// Ctrl-C (SIGINT), SIGTERM and SIGHUP (the terminal was closed). The first asks the run to end after the increment at
// work, so that everything finished lies on disk whole; a second SIGINT or SIGTERM ends the program at once.
#pragma once

#include <atomic>

namespace scabo::app {

class Interrupt {
 public:
  Interrupt();   ///< from here on signals are caught
  ~Interrupt();  ///< and from here on no more
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// True once a signal has come; what analysis::Options::stop points to.
  const std::atomic<bool>& requested() const;
  /// The signal that came, or 0.
  int signal() const;
};

}  // namespace scabo::app
