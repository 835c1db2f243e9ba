#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace scabo::files {

/// All bytes of a regular file; nothing if it is none or cannot be read.
std::optional<std::string> bytes_of_file(const std::filesystem::path& path);

}  // namespace scabo::files
