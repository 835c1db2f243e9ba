// Meshes of solids in unstructured grids of VTK in XML (.vtu).
#pragma once

#include <string>
#include <string_view>

#include "scabo/files/imported_solid_mesh.hpp"

namespace scabo::files {

/// The mesh in the bytes of a file of that name. Cell sets as in the plane (vtu.hpp), those of the array that tells
/// regions apart also as `region_3`; triangles and quadrilaterals become side sets `boundary_3` by its values, vertices
/// node sets `points_3`. Nodes in the middle of sides and cells are left out. Throws InputError.
ImportedSolidMesh parse_solid_vtu(std::string_view bytes, const std::string& file, Bricks bricks = Bricks::divided);

}  // namespace scabo::files
