// Mouths of cracks on the two sides of a contact that are neither in one place nor apart.
#pragma once

#include <vector>

#include "scabo/mesh/plane/interface.hpp"

namespace scabo::mesh {

/// Crack mouths that lie opposite another one, or opposite the end of the other edge, almost but not exactly: nearer
/// than 1e-5 of the adjacent elements, farther than 1e-9. The sides are then joined as if there were no crack, by
/// elements that are too short, or by nodes that are not in one place, whose forces are not in equilibrium.
std::vector<Diagnostic> close_mouths(const model::Model& model, const std::vector<BodyMesh>& bodies);

}  // namespace scabo::mesh
