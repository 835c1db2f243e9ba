#include "scabo/files/read_mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "scabo/base/error.hpp"
#include "scabo/files/abaqus.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/bytes_of_file.hpp"
#include "scabo/files/gmsh.hpp"
#include "scabo/files/read_deck_file.hpp"
#include "scabo/files/solid_gmsh.hpp"
#include "scabo/files/solid_vtu.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/files/vtu.hpp"

namespace scabo::files {

namespace {

/// The bytes after the mark of UTF-8. Throws InputError for text that no format of meshes consists of.
std::string_view readable(std::string_view bytes, const std::string& path) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv))
    fail_in_file(path, 0, 0, "the file is text in UTF-16; save it as UTF-8");
  if (bytes.starts_with("\xEF\xBB\xBF"sv)) bytes.remove_prefix(3);
  const auto ends_text = [](char c) { return c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r'; };
  const std::string_view head = bytes.substr(0, 4096);
  const std::string_view text(
      head.data(), static_cast<std::size_t>(std::find_if(head.begin(), head.end(), ends_text) - head.begin()));
  const std::size_t end = text.find('\r');
  if (end != std::string_view::npos && end + 1 < text.size() && text.find('\n') == std::string_view::npos)
    fail_in_file(path, 0, 0, "its lines end with a carriage return alone; save it with line feeds");
  return bytes;
}

std::string bytes_at(const std::string& path) {
  std::optional<std::string> bytes = bytes_of_file(path);
  if (!bytes) fail_in_file(path, 0, 0, why_unreadable(path));
  return std::move(*bytes);
}

std::optional<IncludedFile> read_beside(const std::string& name, const std::string& from) {
  const std::filesystem::path path = std::filesystem::path(from).parent_path() / name;
  std::optional<std::string> text = bytes_of_file(path);
  if (!text) return std::nullopt;
  text->erase(0, text->size() - readable(*text, path.string()).size());
  return IncludedFile{path.string(), std::move(*text)};
}

/// How other formats of meshes begin, and which they are.
std::string other_format(std::string_view start) {
  const auto begins = [start](std::string_view with) { return start.substr(0, with.size()) == with; };
  if (begins("# vtk DataFile")) return "a legacy file of VTK; save it as .vtu";
  if (begins("$NOD")) return "a file of Gmsh in version 1; save it as version 4.1 or 2.2";
  if (begins("(0") || begins("(2")) return "a mesh of Fluent; convert it with Gmsh or meshio";
  if (begins("\x89HDF")) return "an HDF5 file such as .med; convert it with meshio (meshio convert part.med part.vtu)";
  if (begins("<?xml") || begins("<Xdmf") || begins("<")) return "an XML file without VTKFile; save the mesh as .vtu";
  return "of an unknown format";
}

enum class MeshFormat { gmsh, abaqus, vtu };

/// By the content where it shows its format, else by the extension. Throws InputError.
MeshFormat format_of(std::string_view text, const std::string& path) {
  std::string_view start = text;
  while (!start.empty() && static_cast<unsigned char>(start.front()) <= ' ') start.remove_prefix(1);
  if (start.empty()) fail_in_file(path, 0, 0, "the file is empty; save the mesh again");
  const std::string_view head = start.substr(0, 4096);
  std::string extension = upper(std::filesystem::path(path).extension().string());

  if (start.front() == '$' && head.find("$MeshFormat") != std::string_view::npos) return MeshFormat::gmsh;
  if (start.front() == '<' && head.find("<VTKFile") != std::string_view::npos) return MeshFormat::vtu;
  if (start.front() == '*') return MeshFormat::abaqus;
  if (extension == ".MSH" && start.front() == '$') return MeshFormat::gmsh;
  if (extension == ".INP") return MeshFormat::abaqus;
  if (extension == ".VTU" && start.front() == '<') return MeshFormat::vtu;
  fail_in_file(
      path, 0, 0,
      fmt::format("the file is {}; Scabo reads meshes of Gmsh (.msh 2.2 and 4.1), Abaqus and CalculiX (.inp) and "
                  "VTK (.vtu)",
                  other_format(start)));
}

}  // namespace

ImportedMesh parse_mesh(std::string_view bytes, const std::string& path, std::vector<std::string>* types) {
  const std::string_view text = readable(bytes, path);
  switch (format_of(text, path)) {
    case MeshFormat::gmsh:
      return parse_gmsh(text, path);
    case MeshFormat::abaqus:
      return parse_abaqus(text, path, read_beside, types);
    case MeshFormat::vtu:
      return parse_vtu(text, path);
  }
  throw BrokenInvariant("a format of meshes without a reader");
}

ImportedSolidMesh parse_solid_mesh(std::string_view bytes, const std::string& path, Bricks bricks) {
  const std::string_view text = readable(bytes, path);
  switch (format_of(text, path)) {
    case MeshFormat::gmsh:
      return parse_solid_gmsh(text, path, bricks);
    case MeshFormat::abaqus:
      return parse_solid_abaqus(text, path, read_beside, bricks);
    case MeshFormat::vtu:
      return parse_solid_vtu(text, path, bricks);
  }
  throw BrokenInvariant("a format of meshes without a reader");
}

AbaqusDeck read_deck_file(const std::string& path) {
  const std::string bytes = bytes_at(path);
  const std::string_view text = readable(bytes, path);
  return is_solid_deck(text, path, read_beside) ? parse_solid_deck(text, path, read_beside)
                                                : parse_abaqus_deck(text, path, read_beside);
}

ImportedSolidMesh read_solid_mesh_file(const std::string& path, Bricks bricks) {
  return parse_solid_mesh(bytes_at(path), path, bricks);
}

ImportedMesh read_mesh_file(const std::string& path, std::vector<std::string>* types) {
  return parse_mesh(bytes_at(path), path, types);
}

}  // namespace scabo::files
