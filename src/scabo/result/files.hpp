// Files that are written completely or not at all, and files that grow and can be read at any time, even if the program
// is killed. System calls are used because a stream does not preserve the reason for a failed write.
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

/// Writes a new file, or replaces one; if that fails, no file is left. Throws WriteError.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The same by writing `path.part` and renaming it: readers see the old or the new content, never a part.
void replace_file(const std::filesystem::path& path, std::string_view content);

/// Writes `content` over what a file has at `position`, for which a full disk has room. Throws WriteError.
void overwrite(const std::filesystem::path& path, std::string_view content, std::size_t position);

/// Waits until a file that was written is on the disk.
void synchronise_file(const std::filesystem::path& path);

/// Locks a directory for the run that writes into it, until this object is destroyed or the process ends. The system
/// releases the lock however the process ends, so that no stale lock remains. No file is written. On file systems
/// without locks there is no protection.
class DirectoryLock {
 public:
  /// Throws WriteError if another process has locked the directory.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// A file to which data are appended. An incomplete write is removed again.
class GrowingFile {
 public:
  explicit GrowingFile(std::filesystem::path path);  ///< creates it empty
  /// Continues one that exists after its first `size` bytes; what follows is cut off. Throws WriteError if it is
  /// shorter.
  GrowingFile(std::filesystem::path path, long long size);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  void append(std::string_view content);
  /// Writes `content` and `footer` over the previous footer in one operation, so that the file is always complete.
  void append_before_footer(std::string_view content, std::string_view footer);
  /// Removes what was appended after the first `size` bytes, as if it had not been; the last footer follows them.
  void cut_back(long long size);
  void synchronise();  ///< waits until the content is on the disk

  const std::filesystem::path& path() const { return path_; }
  long long size() const { return size_; }  ///< bytes without the footer

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  long long size_ = 0;  ///< without the footer
  std::string footer_;  ///< the last one
};

}  // namespace scabo::result
