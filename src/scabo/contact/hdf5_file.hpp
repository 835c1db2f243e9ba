// An HDF5 file, read or written: what fclib.cpp needs of the format and nothing more. The library behind
// (HDF5's C interface) stays in hdf5_file.cpp; it prints nothing while we use it. Calls are made one at a
// time, on any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::contact {

/// Reads datasets by their path from the root, `fclib_local/vectors/q`. Everything that is not as it must be
/// is an InputError that names the file, the dataset and the remedy.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& path) const;
  std::vector<std::string> names(const std::string& group) const;  ///< of what a group holds
  std::vector<std::int64_t> integers(const std::string& path) const;
  std::int64_t integer(const std::string& path) const;
  Vector numbers(const std::string& path) const;    ///< finite or not: the caller knows what may be infinite
  std::string text(const std::string& path) const;  ///< empty where there is none

  /// Throws the InputError `file: path: message`.
  [[noreturn]] void fail(const std::string& path, std::string message) const;

 private:
  std::string file_;
  std::int64_t id_ = -1;
};

/// Writes a file under another name (`.part`) and gives it its own when it is whole. Groups on the way to a
/// dataset are made as needed. The same content gives the same bytes. Throws std::runtime_error.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::string file);
  ~Hdf5Writer();  ///< without finish(): nothing is left
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void integers(const std::string& path, const std::vector<int>& values);
  void integer(const std::string& path, int value) { integers(path, {value}); }
  void numbers(const std::string& path, const double* values, std::size_t count);
  void numbers(const std::string& path, const Vector& values) {
    numbers(path, values.data(), static_cast<std::size_t>(values.size()));
  }
  void text(const std::string& path, const std::string& value);
  void finish();

 private:
  template <typename Write>
  void dataset(const std::string& path, std::int64_t type, std::int64_t space, Write write);
  [[noreturn]] void fail(const std::string& reason) const;

  std::string file_, part_;
  std::int64_t id_ = -1;
};

/// True where the file starts (at 0, or after a user block) as HDF5 files do.
bool is_hdf5(const std::string& file);

}  // namespace scabo::contact
