#include "scabo/files/bytes_of_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "scabo/base/impossible_path.hpp"

namespace scabo::files {

std::optional<std::string> bytes_of_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return std::nullopt;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return std::nullopt;
  std::string bytes(size, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  return bytes;
}

std::string why_unreadable(const std::filesystem::path& path) {
  if (const std::string why = impossible_path(path); !why.empty()) return why;
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return "there is no such file; correct its name";
  if (std::filesystem::is_directory(status)) return "is a directory; name a file";
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return "is a pipe or a device, which is read only once; save what it gives as a file";
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  return std::string("cannot be read: ") + (errno != 0 ? std::strerror(errno) : "it changes meanwhile");
}

}  // namespace scabo::files
