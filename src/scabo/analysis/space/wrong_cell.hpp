// Cells of bodies in space that have no stiffness.
#pragma once

#include <optional>
#include <string>

#include "scabo/mesh/space/solid_mesh.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::analysis {

/// Why a cell of a body has no stiffness, if there is one.
std::optional<std::string> wrong_cell(const model::SpaceBody& of, const mesh::SolidMesh& mesh);

}  // namespace scabo::analysis
