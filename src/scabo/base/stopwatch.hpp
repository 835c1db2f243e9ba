// Wall-clock seconds of a block, added to a figure.
#pragma once

#include <chrono>

namespace scabo {

/// Adds the time it lives to `seconds`.
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

/// What the function gives, its time added to `seconds`.
template <typename Function>
auto timed(double& seconds, Function function) {
  const Stopwatch stopwatch(seconds);
  return function();
}

}  // namespace scabo
