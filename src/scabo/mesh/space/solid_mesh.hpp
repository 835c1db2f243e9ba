// A body in space as cells, tetrahedra or hexahedra and wedges: nodes and cells, and the facets of its boundary.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

/// 3, 6 or 8 nodes (geometry::FacetBasis), the corners counter-clockwise seen from outside.
using SolidFacet = std::vector<int>;

struct SolidMesh {
  Matrix nodes = Matrix(3, 0);  ///< 3 x N
  /// Tetrahedra with 4 or 10 nodes, wedges with 15, hexahedra with 20 (CellTopology), not turned over.
  std::vector<std::vector<int>> cells;
};

/// Whether a cell with so many nodes is a scaled boundary super-element; else it is a finite element.
inline bool is_super_element(std::size_t nodes) { return nodes == 15 || nodes == 20; }

/// 3 or 4.
inline std::size_t corners_of(const SolidFacet& facet) { return facet.size() == 8 ? 4 : 3; }
/// Half of the cross product of the diagonals of a quadrilateral, or of two edges of a triangle: the area that the
/// corners enclose times its normal. `x`: at least the corners, 3 x n.
Eigen::Vector3d area_between_corners(const Matrix& x, std::size_t corners);

/// Columns of `nodes`.
Matrix nodes_of(const SolidMesh& mesh, const std::vector<int>& nodes);

/// A side of a cell, from 0: CellTopology::sides.
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
