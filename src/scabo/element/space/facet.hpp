// Integrals over facets of bodies in space: triangles with 3 or 6 nodes (geometry::SimplexBasis), 3 x n, whose corners
// are counter-clockwise seen from outside.
//
// Of plane facets with straight edges exact; of curved ones the sums over the nodes are.
#pragma once

#include "scabo/base/types.hpp"

namespace scabo::element {

/// int N dA, n numbers: times a traction, the nodal forces of it.
Vector area_weights(const Matrix& nodes);

/// int N normal dA, 3 x n, the normal outwards: times -1 and a pressure, the nodal forces of it.
Matrix normal_weights(const Matrix& nodes);

}  // namespace scabo::element
