// Gmsh's library, which is loaded when the first CAD file is meshed.
#pragma once

#include <string>

#include "scabo/files/cad.hpp"

namespace scabo::files {

/// The mesh that Gmsh makes of a file; mesh_cad_file (cad.hpp) checks the file before.
ImportedMesh mesh_by_gmsh(const std::string& path, const CadOptions& options);

}  // namespace scabo::files
