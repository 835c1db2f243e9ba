// Files that are written whole or not at all, and files that grow so that they can be read at any moment,
// even when the program is killed. The system's own calls, because a stream loses the reason why a disk did
// not take the data.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

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
