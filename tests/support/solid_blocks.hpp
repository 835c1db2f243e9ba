// Blocks of tetrahedra, wedges or hexahedra for tests.
#pragma once

#include <array>

#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::test {

/// A box from `low` to `high`, divided into n[0] x n[1] x n[2] bricks: of six tetrahedra with 4 or 10 nodes each, of
/// two wedges with 15, or hexahedra with 20. Its corners are moved at random by up to `moved` of a brick, on faces
/// within them and on edges along them; middle nodes stay in the middle.
mesh::SolidMesh solid_block(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const std::array<int, 3>& n,
                            int nodes_of_cell, double moved = 0.0, unsigned seed = 1);

/// The nodes whose coordinate `axis` is `value`, to 1e-9.
std::vector<int> nodes_at(const mesh::SolidMesh& mesh, int axis, double value);

/// The boundary facets in the plane through `point` whose normal is along `normal`.
std::vector<mesh::SolidFacet> facets_at(const mesh::SolidMesh& mesh, const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal);

}  // namespace scabo::test
