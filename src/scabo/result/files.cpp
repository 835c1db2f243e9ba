#include "scabo/result/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace scabo::result {

namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  throw WriteError("cannot write", path, std::system_category().message(error));
}

int open_empty(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(path, errno);
  return descriptor;
}

/// Only a regular file, never a device such as /dev/full.
void remove_regular(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
}

/// Zero, or the error that ended the write.
int write_at(int descriptor, std::string_view content, off_t position) {
  while (!content.empty()) {
    ssize_t written = ::pwrite(descriptor, content.data(), content.size(), position);
    if (written < 0 && errno == ESPIPE) written = ::write(descriptor, content.data(), content.size());  // a pipe
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
    position += written;
  }
  return 0;
}

}  // namespace

WriteError::WriteError(std::string_view what, std::filesystem::path path, std::string_view reason)
    : std::runtime_error(fmt::format("{} {}: {}", what, path.string(), reason)), path_(std::move(path)) {}

namespace {

/// Writes `at`, which becomes `path`, the name for messages. If that fails, nothing is left of it.
void write_as(const std::filesystem::path& at, const std::filesystem::path& path, std::string_view content) {
  const int descriptor = ::open(at.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(path, errno);
  int error = write_at(descriptor, content, 0);
  if (::close(descriptor) != 0 && error == 0) error = errno;  // network file systems report here that they are full
  if (error == 0) return;
  remove_regular(at);
  fail_to_write(path, error);
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view content) { write_as(path, path, content); }

void replace_file(const std::filesystem::path& path, std::string_view content) {
  std::error_code ignored;
  const auto there = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(there) && std::filesystem::is_other(there)) {  // a device or a pipe stays one
    write_file(path, content);
    return;
  }
  std::filesystem::path part = path;
  part += ".part";
  write_as(part, path, content);
  if (std::rename(part.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  remove_regular(part);
  fail_to_write(path, error);
}

void overwrite(const std::filesystem::path& path, std::string_view content, std::size_t position) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(path, errno);
  int error = write_at(descriptor, content, static_cast<off_t>(position));
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) fail_to_write(path, error);
}

void synchronise_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(path, errno);
  const int error = ::fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;  // some file systems cannot
  ::close(descriptor);
  if (error != 0) fail_to_write(path, error);
}

DirectoryLock::DirectoryLock(const std::filesystem::path& directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw WriteError("cannot write results to", directory,
                   "another run is writing there: wait until it ends, or choose another directory with -o");
}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

GrowingFile::GrowingFile(std::filesystem::path path) : path_(std::move(path)), descriptor_(open_empty(path_)) {}

GrowingFile::GrowingFile(std::filesystem::path path, long long size)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)), size_(size) {
  struct stat status {};
  int error = descriptor_ < 0 || ::fstat(descriptor_, &status) != 0 ? errno : 0;
  const bool shorter = error == 0 && status.st_size < size;
  if (error == 0 && !shorter && ::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) error = errno;
  if (error == 0 && !shorter) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  if (shorter)
    throw WriteError("cannot continue", path_,
                     "it is shorter than the run left it: run the model again with `scabo run`");
  throw WriteError("cannot continue", path_, std::system_category().message(error));
}

GrowingFile::~GrowingFile() { ::close(descriptor_); }

void GrowingFile::synchronise() {
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL) fail_to_write(path_, errno);
}

void GrowingFile::append(std::string_view content) { append_before_footer(content, {}); }

void GrowingFile::append_before_footer(std::string_view content, std::string_view footer) {
  std::string text(content);
  text += footer;
  const int error = write_at(descriptor_, text, size_);
  if (error != 0) {
    // Remove the part that was written, and restore the old footer, which has the same length.
    if (footer.empty() || write_at(descriptor_, footer, size_) == 0)
      (void)!::ftruncate(descriptor_, size_ + static_cast<off_t>(footer.size()));
    fail_to_write(path_, error);
  }
  size_ += static_cast<long long>(content.size());
  footer_ = footer;
}

void GrowingFile::cut_back(long long size) {
  if (size >= size_) return;
  size_ = size;
  // Over what is there, for which even a full disk has room.
  const int error = write_at(descriptor_, footer_, size_);
  if (error != 0 || ::ftruncate(descriptor_, size_ + static_cast<off_t>(footer_.size())) != 0)
    fail_to_write(path_, error != 0 ? error : errno);
}

}  // namespace scabo::result
