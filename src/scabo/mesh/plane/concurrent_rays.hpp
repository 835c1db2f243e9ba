// The lines along which the two sides of a contact press, if they are all parallel or meet in one point: those of
// rays.hpp between two edges that are lines or arcs. A body that slides or rolls without friction along the other one,
// about that point, then changes no gap.
#pragma once

#include <optional>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/rays.hpp"

namespace scabo::mesh {

/// Of a contact between edges of elastic bodies, one of them curved. A chain of a mesh file counts as an arc if all its
/// points are on one circle but for a hundredth of what its elements depart from it; with any other chain, nothing.
std::optional<Rays> concurrent_rays(const model::Model& model, const model::Contact& contact, const Mesh& mesh);

/// Area between the arcs of a body and the elements on them, relative to the body: what division changes of its shape.
double lost_of_arcs(const model::Model& model, int body, const Mesh& mesh);

}  // namespace scabo::mesh
