// Triangles in place of cells that are no finite elements any more: where the sides of a contact or tie are matched, a
// cell beside them gets more sides than four. Bodies of revolution have no super-elements.
#pragma once

#include <optional>

#include "scabo/base/error.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Divides every super-element of a body into triangles, one for each of its line elements, with a corner in its
/// centre; no node changes its number. A mistake if sides of one cell have two orders, or an order that no triangle
/// has.
std::optional<Diagnostic> divide_into_triangles(BodyMesh& mesh, const model::Body& body);

}  // namespace scabo::mesh
