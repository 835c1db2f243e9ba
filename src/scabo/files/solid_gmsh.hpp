// Meshes of solids in files of Gmsh (.msh), versions 2.0 to 2.2 and 4.1, as text and binary.
#pragma once

#include <string>
#include <string_view>

#include "scabo/files/imported_solid_mesh.hpp"

namespace scabo::files {

/// The mesh in the bytes of a file of that name. Physical volumes become cell sets, physical surfaces side sets,
/// physical curves line sets, physical points node sets; without a name `region_7`, `boundary_7`, `curve_7`, `points_7`
/// by their tags. What is in no physical group is called after its entity: `volume_5`, `surface_5`, `curve_5`,
/// `point_5`. Nodes in the middle of sides and cells are left out. Throws InputError.
ImportedSolidMesh parse_solid_gmsh(std::string_view bytes, const std::string& file, Bricks bricks = Bricks::divided);

}  // namespace scabo::files
