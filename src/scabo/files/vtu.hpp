// Unstructured grids of VTK in XML (.vtu): text, base64 and appended data, uncompressed or by zlib.
#pragma once

#include <string>
#include <string_view>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// The mesh in the bytes of a file of that name. An array of integers with one value per cell tells the regions apart:
/// the first that is called `region`, `material`, `gmsh:physical`, `MaterialIds`, `CellEntityIds` or
/// `gmsh:geometrical`, else the first one. Regions are `region_3` by its values; lines and vertices become facet sets
/// `boundary_3` and node sets `points_3`. Every such array with at most 1000 values gives cell sets as well, `NAME_3`.
/// Throws InputError.
ImportedMesh parse_vtu(std::string_view bytes, const std::string& file);

}  // namespace scabo::files
