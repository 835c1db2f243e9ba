// Wall-clock time of a block of code, added to a variable.
#pragma once

#include <chrono>

namespace scabo {

/// Adds its lifetime, in seconds, to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns the result of the function and adds its run time to `seconds`.
template <typename Function>
auto timed(double& seconds, Function function) {
  const Stopwatch stopwatch(seconds);
  return function();
}

}  // namespace scabo
