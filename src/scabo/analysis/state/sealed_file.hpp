// Named values one after the other in a file, with a digest that recognises accidental changes: for the file of a
// checkpoint (checkpoint.hpp) and that of the end of a run (restart.hpp). One function describes a value for both
// directions: with Sealing it is written, with Unsealing it is read. Of this machine: numbers as they are in memory.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/analysis/state/increment_record.hpp"
#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::analysis {

inline std::string hexadecimal(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

/// Collects values, and writes them with their digest.
class Sealing {
 public:
  /// `mark`: the first line of the file, which says what it is.
  explicit Sealing(std::string_view mark) : bytes_(mark) {}
  static constexpr bool reads = false;

  void text(std::string_view name, const std::string& value) { add(name, value.data(), value.size()); }
  void numbers(std::string_view name, const std::vector<double>& values) {
    add(name, values.data(), values.size() * sizeof(double));
  }
  void integers(std::string_view name, const std::vector<int>& values) {
    add(name, values.data(), values.size() * sizeof(int));
  }
  /// Throws std::runtime_error, and leaves no part of the file, if it cannot be written.
  void write(const std::filesystem::path& file);

 private:
  void add(std::string_view name, const void* values, std::size_t size);
  std::string bytes_;
};

/// Reads them back in the same order. Throws InputError if the file cannot be read and std::out_of_range if it is not
/// what was written: finish() at the latest.
class Unsealing {
 public:
  Unsealing(const std::filesystem::path& file, std::string_view mark);
  static constexpr bool reads = true;

  /// The first value, a text, before the others are read: also of a file that another version wrote.
  std::string first_text() const;
  void text(std::string_view name, std::string& value) { value = next(name); }
  void numbers(std::string_view name, std::vector<double>& values) { take(name, values); }
  void integers(std::string_view name, std::vector<int>& values) { take(name, values); }
  void finish() const;

 private:
  std::string_view next(std::string_view name);
  template <typename T>
  void take(std::string_view name, std::vector<T>& values);
  std::string bytes_;
  std::string_view left_;  // of bytes_
};

template <typename Io, typename T>
void exchange_integer(Io& io, const std::string& path, T& value) {
  std::vector<int> list{static_cast<int>(value)};
  io.integers(path, list);
  value = static_cast<T>(list.at(0));
}

/// Number of texts or files.
template <typename Io>
std::size_t exchange_count(Io& io, const std::string& path, std::size_t count) {
  constexpr std::size_t most = 1'000'000;  // only of a damaged file
  exchange_integer(io, path, count);
  if (count > most) throw std::out_of_range("a number of values is out of range");
  return count;
}

template <typename Io>
void exchange_texts(Io& io, const std::string& path, std::vector<std::string>& texts) {
  texts.resize(exchange_count(io, path + "/count", texts.size()));
  for (std::size_t i = 0; i < texts.size(); ++i) io.text(fmt::format("{}/{}", path, i), texts[i]);
}

template <typename Io>
void exchange_vector(Io& io, const std::string& path, Vector& values) {
  std::vector<double> list(values.begin(), values.end());
  io.numbers(path, list);
  if constexpr (Io::reads) values = Eigen::Map<const Vector>(list.data(), static_cast<Eigen::Index>(list.size()));
}

template <typename Io>
void exchange_scalars(Io& io, const std::string& path, const std::vector<double*>& values) {
  std::vector<double> list;
  for (const double* value : values) list.push_back(*value);
  io.numbers(path, list);
  for (std::size_t i = 0; i < values.size(); ++i) *values[i] = list.at(i);
}

}  // namespace scabo::analysis
