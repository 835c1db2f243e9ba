// Integrals over facets of bodies in space: triangles with 3 or 6 nodes and quadrilaterals with 8
// (geometry::FacetBasis), 3 x n, whose corners are counter-clockwise seen from outside.
//
// Of plane facets with straight edges exact; of curved ones the sums over the nodes are.
#pragma once

#include <functional>

#include "scabo/base/types.hpp"

namespace scabo::element {

/// int N dA, n numbers: times a traction, the nodal forces of it.
Vector area_weights(const Matrix& nodes);

/// int N normal dA, 3 x n, the normal outwards: times -1 and a pressure, the nodal forces of it.
Matrix normal_weights(const Matrix& nodes);

/// A traction at a point of a facet with an outward unit normal.
using TractionAt = std::function<Eigen::Vector3d(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)>;

/// int N traction dA, 3 x n: the nodal forces. Exact for tractions that are linear, of plane facets with straight
/// edges.
Matrix traction_integrals(const Matrix& nodes, const TractionAt& traction);

/// int N' (k_n n n' + k_t (1 - n n')) N dA, 3n x 3n: springs on a facet with the normal n, exact where it is plane and
/// its edges are straight.
Matrix spring_integrals(const Matrix& nodes, double k_n, double k_t);

}  // namespace scabo::element
