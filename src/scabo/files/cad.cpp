#include "scabo/files/cad.hpp"

#include <cctype>
#include <filesystem>
#include <fstream>

#include "scabo/base/error.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/geo_commands.hpp"
#include "scabo/files/gmsh_library.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// OpenCASCADE never ends reading a truncated .brep file. A whole one ends, after its shapes, with a line such as `+1
/// 0`.
void refuse_truncated_brep(const std::string& path) {
  const std::string text = bytes_of_file(path).value_or("");
  const std::size_t shapes = text.find("\nTShapes ");
  const std::size_t last = text.find_last_not_of(" \r\n");
  const std::size_t line = last == std::string::npos ? last : text.find_last_of('\n', last);
  const bool whole = shapes != std::string::npos && line != std::string::npos && line > shapes && line < last &&
                     (text[line + 1] == '+' || text[line + 1] == '-') && text[last] != '*';
  if (!whole) fail_in_file(path, 0, 0, "the file does not end as a BREP file of OpenCASCADE does; write it again");
}

}  // namespace

void check_cad_file(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || !std::ifstream(path)) fail_in_file(path, 0, 0, why_unreadable(path));
  if (extension_of(path) == ".brep") refuse_truncated_brep(path);
}

bool is_cad_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".geo" || extension == ".step" || extension == ".stp" || extension == ".brep";
}

bool has_own_sizes(const std::string& path) { return extension_of(path) == ".geo"; }

ImportedMesh mesh_cad_file(const std::string& path, const CadOptions& options) {
  ensure(options.order == 1 || options.order == 2, "the order of a CAD mesh is 1 or 2");
  check_cad_file(path);
  if (has_own_sizes(path)) refuse_commands(path);
  return mesh_by_gmsh(path, options);
}

}  // namespace scabo::files
