// Parts of a mesh whose sides have nodes of their own in the same places, as meshes of patches have them.
#pragma once

#include <vector>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::model {

/// Joins the nodes of whole sides of two parts that lie on each other: both ends, and the middle nodes of quadratic
/// ones, within 1e-6 of the length of the side. `part`: per cell, -1 for those that stay as they are. Sides that meet
/// in one point, and those of a part with itself (a slit), stay apart. Returns how many nodes were joined to others;
/// the mesh with them is then in `joined`.
int join_equal_sides(const files::ImportedMesh& mesh, const std::vector<int>& part, files::ImportedMesh& joined);

}  // namespace scabo::model
