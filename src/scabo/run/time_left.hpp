// How long a run still takes, by the part of its steps that is done.
#pragma once

#include <chrono>
#include <optional>

namespace scabo::run {

class TimeLeft {
 public:
  /// The increments begin now.
  void begin() { began_ = Clock::now(); }
  /// An increment has ended at `part` of the whole analysis, 0 to 1 (part_done). The first one of a run that was
  /// resumed is not timed, as it began elsewhere: `is_first` says that no increment was before it.
  void increment(double part, bool is_first) {
    if (is_first || part_done_ == 0.0) begun_at_ = is_first ? 0.0 : part;
    if (begun_at_ == part) began_ = Clock::now();
    part_done_ = part;
  }

  /// Seconds since the increments began.
  double since() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }
  /// Seconds, if the rest goes on as before; nothing before an increment has ended.
  std::optional<double> seconds() const {
    if (part_done_ <= begun_at_) return std::nullopt;
    return since() * (1.0 - part_done_) / (part_done_ - begun_at_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  double begun_at_ = 0.0, part_done_ = 0.0;  // of the whole analysis, when increments began and now
};

}  // namespace scabo::run
