// Reading and writing of HDF5 files, limited to what fclib.cpp needs. The C interface of HDF5 is used only in
// hdf5_file.cpp, and its messages are suppressed. Calls are serialised and allowed from any thread.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::contact {

/// Reads datasets by their path from the root, such as `fclib_local/vectors/q`. Anything invalid is an InputError that
/// names the file, the dataset and the remedy.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& path) const;
  std::vector<std::string> names(const std::string& group) const;  ///< names of the members of a group
  std::vector<std::int64_t> integers(const std::string& path) const;
  std::int64_t integer(const std::string& path) const;
  Vector numbers(const std::string& path) const;    ///< may be infinite; the caller decides what is allowed
  std::string text(const std::string& path) const;  ///< empty if there is none

  /// Throws an InputError `file: path: message`.
  [[noreturn]] void fail(const std::string& path, std::string message) const;

 private:
  std::string file_;
  std::int64_t id_ = -1;
};

/// Collects a file in memory and writes it at the end, first to a temporary file (`.part`), which is renamed when it is
/// complete: HDF5 itself never meets a full disk, after which it would crash at the end of the process. Groups in the
/// path of a dataset are created as needed. The same content gives the same bytes. Throws std::runtime_error.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::string file);
  ~Hdf5Writer();  ///< without finish(), removes the temporary file
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
  std::FILE* out_ = nullptr;
  std::int64_t id_ = -1;
};

/// Whether the file starts (at 0, or after a user block) like an HDF5 file.
bool is_hdf5(const std::string& file);

}  // namespace scabo::contact
