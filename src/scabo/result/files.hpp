// Files that are written completely or not at all, and files that grow and can be read at any time, even if the
// program is killed. System calls are used, because a stream loses the reason why data could not be written.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace scabo::result {

/// A file or directory of the results cannot be written: `cannot write out/contact.csv: No space left on
/// device`.
class WriteError : public std::runtime_error {
 public:
  WriteError(std::string_view what, std::filesystem::path path, std::string_view reason);
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes a new file, or replaces one; where that fails, nothing is left of it. Throws WriteError.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The same through `path.part` and a change of name: readers see the old or the new content, never a part.
void replace_file(const std::filesystem::path& path, std::string_view content);

/// Holds a directory for the one run that writes into it, until it is destroyed or the process ends: however it ends,
/// the system releases the lock, so that none is ever stale. Nothing is written for it. Where a file system knows no
/// locks, nothing is held.
class DirectoryLock {
 public:
  /// Throws WriteError where another process holds the directory.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// A file that grows at its end. What a failed write left there is taken away again.
class GrowingFile {
 public:
  explicit GrowingFile(std::filesystem::path path);  ///< creates it empty
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view content);
  /// Writes `content` and `footer` over the footer of the call before, in one piece: the file is always
  /// complete.
  void append_before_footer(std::string_view content, std::string_view footer);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  long long size_ = 0;  ///< without footer
};

}  // namespace scabo::result
