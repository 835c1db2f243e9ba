#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace scabo::files {

/// All bytes of a regular file; nothing if it is none or cannot be read.
std::optional<std::string> bytes_of_file(const std::filesystem::path& path);

/// Why there are no bytes: there is no such file, it is a directory or a pipe, or the reason of the system.
std::string why_unreadable(const std::filesystem::path& path);

}  // namespace scabo::files
