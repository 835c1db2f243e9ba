// Paths at which nothing can be.
#pragma once

#include <filesystem>
#include <string>

namespace scabo {

/// Why nothing can be at `path`: its symbolic links form a loop, or its name is too long. Empty if something may be
/// there.
std::string impossible_path(const std::filesystem::path& path);

}  // namespace scabo
