#include "scabo/base/impossible_path.hpp"

#include <system_error>

namespace scabo {

std::string impossible_path(const std::filesystem::path& path) {
  std::error_code error;
  [[maybe_unused]] const auto status = std::filesystem::status(path, error);
  if (error == std::errc::too_many_symbolic_link_levels) return "the symbolic links in its path form a loop";
  if (error == std::errc::filename_too_long) return "the name is too long";
  return "";
}

}  // namespace scabo
