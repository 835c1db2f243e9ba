// The face of a body in space that is nearest to a point.
#pragma once

#include <string>
#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/model/solid_shape.hpp"

namespace scabo::model {

/// One name; several where faces are equally near, as at an edge. Of sets of sides that share the nearest side, and of
/// names of one edge of an outline, the first. Sides are seen as plane triangles. None: there are no faces.
std::vector<std::string> nearest_faces(const files::ImportedSolidMesh& mesh, const Eigen::Vector3d& point);
std::vector<std::string> nearest_faces(const SolidShape& shape, const Eigen::Vector3d& point);

}  // namespace scabo::model
