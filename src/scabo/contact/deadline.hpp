// A time after which a solver ends with its best iterate. It is checked between iterations and sweeps; a factorisation
// of a large problem is not interrupted.
#pragma once

#include <chrono>

namespace scabo::contact {

class Deadline {
 public:
  Deadline() = default;  ///< never
  static Deadline in(double seconds) {
    Deadline deadline;
    deadline.limited_ = true;
    deadline.seconds_ = seconds;
    deadline.end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    return deadline;
  }

  bool passed() const { return limited_ && Clock::now() >= end_; }
  double seconds() const { return seconds_; }  ///< as given

 private:
  using Clock = std::chrono::steady_clock;
  bool limited_ = false;
  double seconds_ = 0.0;
  Clock::time_point end_;
};

}  // namespace scabo::contact
