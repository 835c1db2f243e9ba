// Digests of what two models must have in common (restart.hpp).
#pragma once

#include <string>
#include <string_view>

#include "scabo/analysis/state/sealed_file.hpp"

namespace scabo::analysis {

/// Digest of numbers and texts, one after the other.
class Fingerprint {
 public:
  void add(std::string_view text) { value_ = digest(text, digest(";", value_)); }
  void add(double number) {
    if (number == 0.0) number = 0.0;  // also -0
    value_ = digest({reinterpret_cast<const char*>(&number), sizeof number}, value_);
  }
  void add(const Vec2& x) { add(x.x()), add(x.y()); }
  void add(const Vector& values) {
    add(static_cast<double>(values.size()));
    for (const double value : values) add(value);
  }
  void add(const Matrix& values) { add(Vector(values.reshaped())); }
  std::string text() const { return hexadecimal(value_); }

 private:
  std::uint64_t value_ = digest_start;
};

}  // namespace scabo::analysis
