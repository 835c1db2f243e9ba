// Meshes of bodies in space, of their shapes or files.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "scabo/mesh/space/shaped_solid.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::analysis {

/// Or why there is none.
std::variant<mesh::ShapedSolid, std::string> mesh_of_body(const model::SpaceBody& of);

/// Why a cell of a body has no stiffness, if there is one.
std::optional<std::string> wrong_cell(const model::SpaceBody& of, const mesh::SolidMesh& mesh);

}  // namespace scabo::analysis
