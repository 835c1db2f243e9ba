#include "scabo/mesh/space/solid_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "scabo/base/cell_topology.hpp"

namespace scabo::mesh {

Matrix nodes_of(const SolidMesh& mesh, const std::vector<int>& nodes) { return mesh.nodes(Eigen::all, nodes); }

Eigen::Vector3d area_between_corners(const Matrix& x, std::size_t corners) {
  const Eigen::Vector3d a = x.col(corners == 4 ? 2 : 1) - x.col(0),
                        b = x.col(corners == 4 ? 3 : 2) - x.col(corners == 4);
  return 0.5 * a.cross(b);
}

SolidFacet facet_of(const std::vector<int>& cell, int side) {
  const auto& topology = CellTopology::of(cell.size());
  SolidFacet facet;
  for (const std::size_t node : topology.nodes_of_side(static_cast<std::size_t>(side), cell.size() > topology.corners))
    facet.push_back(cell[node]);
  return facet;
}

std::vector<SolidFacet> boundary_facets(const SolidMesh& mesh) {
  std::map<std::vector<int>, int> cells_at;
  const auto key_of = [](const SolidFacet& facet) {
    std::vector<int> key(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(corners_of(facet)));
    std::sort(key.begin(), key.end());
    return key;
  };
  std::vector<SolidFacet> all, facets;
  for (const std::vector<int>& cell : mesh.cells)
    for (std::size_t side = 0; side < CellTopology::of(cell.size()).sides.size(); ++side) {
      all.push_back(facet_of(cell, static_cast<int>(side)));
      ++cells_at[key_of(all.back())];
    }
  for (SolidFacet& facet : all)
    if (cells_at[key_of(facet)] == 1) facets.push_back(std::move(facet));
  return facets;
}

std::optional<std::array<int, 2>> overlapping_cells(const SolidMesh& mesh) {
  std::vector<std::pair<SolidFacet, int>> sides;  // corners in their order, the least one first
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t side = 0; side < CellTopology::of(mesh.cells[c].size()).sides.size(); ++side) {
      SolidFacet corners = facet_of(mesh.cells[c], static_cast<int>(side));
      corners.resize(corners_of(corners));
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      sides.emplace_back(std::move(corners), static_cast<int>(c));
    }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].first == sides[i - 1].first) return std::array<int, 2>{sides[i - 1].second, sides[i].second};
  return std::nullopt;
}

std::vector<SolidFacet> facets_in_plane(const SolidMesh& mesh, const std::vector<SolidFacet>& facets,
                                        const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double distance) {
  std::vector<SolidFacet> chosen;
  for (const SolidFacet& facet : facets) {
    const Matrix x = nodes_of(mesh, facet).leftCols(static_cast<Eigen::Index>(corners_of(facet)));
    const Vector heights = (x.colwise() - point).transpose() * normal;
    if (heights.cwiseAbs().maxCoeff() <= distance && area_between_corners(x, corners_of(facet)).dot(normal) > 0.0)
      chosen.push_back(facet);
  }
  return chosen;
}

}  // namespace scabo::mesh
