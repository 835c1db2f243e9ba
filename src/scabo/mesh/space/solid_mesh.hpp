// A body in space as tetrahedra: nodes and cells, and the facets of its boundary.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

/// 3 or 6 nodes (geometry::SimplexBasis), the corners counter-clockwise seen from outside.
using SolidFacet = std::vector<int>;

struct SolidMesh {
  Matrix nodes = Matrix(3, 0);          ///< 3 x N
  std::vector<std::vector<int>> cells;  ///< 4 or 10 nodes (geometry::SimplexBasis), their Jacobian positive
};

/// Columns of `nodes`.
Matrix nodes_of(const SolidMesh& mesh, const std::vector<int>& nodes);

/// Side 0 to 3 of a cell: that of the corners 123, 142, 243, 341.
SolidFacet facet_of(const std::vector<int>& cell, int side);

/// The facets that belong to one cell only, in the order of the cells.
std::vector<SolidFacet> boundary_facets(const SolidMesh& mesh);

/// Two cells that lie on the same side of a facet that both have; none: no such cells.
std::optional<std::array<int, 2>> overlapping_cells(const SolidMesh& mesh);

/// Of these facets, those whose corners lie at most `distance` from the plane through `point` across `normal`, a unit
/// vector, and whose outward normal is along it.
std::vector<SolidFacet> facets_in_plane(const SolidMesh& mesh, const std::vector<SolidFacet>& facets,
                                        const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double distance);

}  // namespace scabo::mesh
