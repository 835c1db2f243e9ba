#include "scabo/files/read_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "scabo/files/abaqus.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/gmsh.hpp"
#include "scabo/files/read_deck_file.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/files/vtu.hpp"

namespace scabo::files {

namespace {

std::optional<IncludedFile> read_beside(const std::string& name, const std::string& from) {
  const std::filesystem::path path = std::filesystem::path(from).parent_path() / name;
  std::optional<std::string> text = bytes_of_file(path);
  if (!text) return std::nullopt;
  return IncludedFile{path.string(), std::move(*text)};
}

/// How other formats of meshes begin, and which they are.
std::string other_format(std::string_view start) {
  const auto begins = [start](std::string_view with) { return start.substr(0, with.size()) == with; };
  if (begins("# vtk DataFile")) return "a legacy file of VTK; save it as .vtu";
  if (begins("$NOD")) return "a file of Gmsh in version 1; save it as version 4.1 or 2.2";
  if (begins("(0") || begins("(2")) return "a mesh of Fluent; convert it with Gmsh or meshio";
  if (begins("\x89HDF")) return "an HDF5 file such as .med; convert it with Gmsh";
  if (begins("<?xml") || begins("<Xdmf") || begins("<")) return "an XML file without VTKFile; save the mesh as .vtu";
  return "of an unknown format";
}

}  // namespace

ImportedMesh parse_mesh(std::string_view bytes, const std::string& path) {
  std::string_view start = bytes;
  if (start.substr(0, 3) == "\xEF\xBB\xBF") start.remove_prefix(3);
  const std::string_view text = start;
  while (!start.empty() && static_cast<unsigned char>(start.front()) <= ' ') start.remove_prefix(1);
  if (start.empty()) fail_in_file(path, 0, 0, "the file is empty; save the mesh again");
  const std::string_view head = start.substr(0, 4096);
  std::string extension = upper(std::filesystem::path(path).extension().string());

  if (start.front() == '$' && head.find("$MeshFormat") != std::string_view::npos) return parse_gmsh(text, path);
  if (start.front() == '<' && head.find("<VTKFile") != std::string_view::npos) return parse_vtu(text, path);
  if (start.front() == '*') return parse_abaqus(text, path, read_beside);
  if (extension == ".MSH" && start.front() == '$') return parse_gmsh(text, path);
  if (extension == ".INP") return parse_abaqus(text, path, read_beside);
  if (extension == ".VTU" && start.front() == '<') return parse_vtu(text, path);
  fail_in_file(
      path, 0, 0,
      fmt::format("the file is {}; Scabo reads meshes of Gmsh (.msh 2.2 and 4.1), Abaqus and CalculiX (.inp) and "
                  "VTK (.vtu)",
                  other_format(start)));
}

AbaqusDeck read_deck_file(const std::string& path) {
  const std::optional<std::string> bytes = bytes_of_file(path);
  if (!bytes) fail_in_file(path, 0, 0, "there is no such file, or it cannot be read; correct its name");
  std::string_view text = *bytes;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return parse_abaqus_deck(text, path, read_beside);
}

ImportedMesh read_mesh_file(const std::string& path) {
  const std::optional<std::string> bytes = bytes_of_file(path);
  if (!bytes) fail_in_file(path, 0, 0, "there is no such file, or it cannot be read; correct its name");
  return parse_mesh(*bytes, path);
}

}  // namespace scabo::files
