// Values in a group of an HDF5 file, with a digest that recognises accidental changes: for the file of a checkpoint
// (checkpoint.hpp) and that of the end of a run (restart.hpp). One function describes a value for both directions: with
// Sealing it is written, with Unsealing it is read.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scabo/analysis/state/increment_record.hpp"
#include "scabo/base/types.hpp"
#include "scabo/contact/files/hdf5_file.hpp"

namespace scabo::analysis {

inline std::string hexadecimal(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

/// Writes values and their digest.
class Sealing {
 public:
  Sealing(const std::string& file, std::string group) : file_(file), group_(std::move(group)) {}
  static constexpr bool reads = false;

  void text(const std::string& path, std::string& value) {
    add(path, value);
    file_.text(group_ + path, value);
  }
  void numbers(const std::string& path, std::vector<double>& values) {
    add(path, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
    file_.numbers(group_ + path, values.data(), values.size());
  }
  void integers(const std::string& path, std::vector<int>& values) {
    add(path, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(int)});
    file_.integers(group_ + path, values);
  }
  void finish() {
    file_.text(group_ + "digest", hexadecimal(digest_));
    file_.finish();
  }

 private:
  void add(const std::string& path, std::string_view bytes) { digest_ = digest(bytes, digest(path, digest_)); }
  contact::Hdf5Writer file_;
  std::string group_;
  std::uint64_t digest_ = digest_start;
};

/// Reads them back; finish() fails if anything differs from what was written.
class Unsealing {
 public:
  Unsealing(const std::string& file, std::string group) : file_(file), group_(std::move(group)) {}
  static constexpr bool reads = true;

  /// A text that is read before the others, without effect on the digest.
  std::string text_of(const std::string& path) const { return file_.text(group_ + path); }
  void text(const std::string& path, std::string& value) {
    value = file_.text(group_ + path);
    add(path, value);
  }
  void numbers(const std::string& path, std::vector<double>& values) {
    const Vector read = file_.numbers(group_ + path);
    values.assign(read.begin(), read.end());
    add(path, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
  }
  void integers(const std::string& path, std::vector<int>& values) {
    values.clear();
    for (const std::int64_t value : file_.integers(group_ + path)) values.push_back(static_cast<int>(value));
    add(path, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(int)});
  }
  void finish() const {
    if (file_.text(group_ + "digest") != hexadecimal(digest_)) file_.fail("digest", "does not belong to the values");
  }

 private:
  void add(const std::string& path, std::string_view bytes) { digest_ = digest(bytes, digest(path, digest_)); }
  contact::Hdf5Reader file_;
  std::string group_;
  std::uint64_t digest_ = digest_start;
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
