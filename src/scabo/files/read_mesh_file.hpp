// A mesh file of any format that Scabo reads (docs/mesh_files.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/files/imported_mesh.hpp"
#include "scabo/files/solid_abaqus.hpp"

namespace scabo::files {

/// Reads a .msh, .inp or .vtu file. The content decides where it shows its format, else the extension. Throws
/// InputError with the file, the line (text) or the byte or cell (binary), what is wrong and how to correct it.
/// `types`: of the cells, as Abaqus calls them (CPS4, CAX8R); none of other formats.
ImportedMesh read_mesh_file(const std::string& path, std::vector<std::string>* types = nullptr);

/// The same for the bytes of a file of that name; *INCLUDE is read beside it.
ImportedMesh parse_mesh(std::string_view bytes, const std::string& path, std::vector<std::string>* types = nullptr);

/// The same of solids.
ImportedSolidMesh read_solid_mesh_file(const std::string& path, Bricks bricks = Bricks::divided);
ImportedSolidMesh parse_solid_mesh(std::string_view bytes, const std::string& path, Bricks bricks = Bricks::divided);

}  // namespace scabo::files
