// When a run writes checkpoints: after every increment, as long as that takes a twentieth of the time. More increments
// are then solved again after a kill, at most for as long as twenty checkpoints take.
#pragma once

#include <chrono>

namespace scabo::run {

class CheckpointPace {
 public:
  bool is_due() const { return Clock::now() >= next_; }

  /// Calls `write` and measures its time.
  template <typename Write>
  void write(const Write& write) {
    constexpr double share = 0.05;  // of the time
    const Clock::time_point start = Clock::now();
    write();
    const Clock::time_point end = Clock::now();
    next_ = end + std::chrono::duration_cast<Clock::duration>((end - start) / share);
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_;
};

}  // namespace scabo::run
