// Meshes of solids in input files of Abaqus and CalculiX (.inp): nodes, elements C3D4 and C3D10, C3D6, C3D8, C3D15 and
// C3D20, which are divided into tetrahedra or kept, sets and surfaces.
#pragma once

#include <string>
#include <string_view>

#include "scabo/files/abaqus.hpp"
#include "scabo/files/imported_solid_mesh.hpp"

namespace scabo::files {

/// The mesh in the text of a file of that name. Keywords that describe no mesh are passed over. Throws InputError.
ImportedSolidMesh parse_solid_abaqus(std::string_view text, const std::string& file,
                                     const ReadInclude& read_include = {}, Bricks bricks = Bricks::divided);

/// Whether a deck has elements C3D4 and so on, also in files that it includes.
bool is_solid_deck(std::string_view text, const std::string& file, const ReadInclude& read_include = {});

/// As parse_solid_abaqus, with everything else (abaqus.hpp).
AbaqusDeck parse_solid_deck(std::string_view text, const std::string& file, const ReadInclude& read_include = {});

}  // namespace scabo::files
