// Consistent nodal forces of loads on elastic bodies, and forces on rigid bodies.
#pragma once

#include <functional>

#include "scabo/mesh/mesh.hpp"

namespace scabo::system {

/// Traction, force / length^2, at a boundary point `x` whose outward unit normal is `n`.
using TractionField = std::function<Vec2(const Vec2& x, const Vec2& n)>;

/// Nodal forces (two per node) of a traction on line elements, computed with their shape functions.
Vector traction_forces(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes, double thickness,
                       const TractionField& traction);

/// Length of the elements as divided.
double length_of(const std::vector<mesh::LineElement>& elements, const std::vector<Vec2>& nodes);

}  // namespace scabo::system
