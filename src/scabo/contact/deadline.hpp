// Where a solver ends with its best iterate: after a time, or after an amount of work. It is checked between iterations
// and sweeps; a factorisation of a large problem is not interrupted.
//
// A limit of time is for users who wait. Work is counted, in operations as work.hpp estimates them, and ends a search
// at the same iterate on every machine: it is for results that must not depend on the machine.
#pragma once

#include <chrono>
#include <memory>

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
  /// Copies count together. Solvers spend from the thread that called them.
  static Deadline after(double operations) {
    Deadline deadline;
    deadline.left_ = std::make_shared<double>(operations);
    return deadline;
  }

  void spend(double operations) const {
    if (left_) *left_ -= operations;
  }
  bool passed() const { return (left_ && *left_ <= 0.0) || (limited_ && Clock::now() >= end_); }
  bool of_work() const { return left_ != nullptr; }
  double seconds() const { return seconds_; }  ///< as given

 private:
  using Clock = std::chrono::steady_clock;
  bool limited_ = false;
  double seconds_ = 0.0;
  Clock::time_point end_;
  std::shared_ptr<double> left_;  // operations; null: not limited
};

}  // namespace scabo::contact
