#include "scabo/mesh/space/solid_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scabo/geometry/simplex_basis.hpp"

namespace scabo::mesh {

namespace {

/// Corners of the facets of a tetrahedron, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 3>, 4> facets_of_cell{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

}  // namespace

Matrix nodes_of(const SolidMesh& mesh, const std::vector<int>& nodes) { return mesh.nodes(Eigen::all, nodes); }

SolidFacet facet_of(const std::vector<int>& cell, int side) {
  const std::array<int, 3>& corners = facets_of_cell[static_cast<std::size_t>(side)];
  SolidFacet facet;
  for (const int corner : corners) facet.push_back(cell[static_cast<std::size_t>(corner)]);
  const auto& edges = geometry::SimplexBasis::of(3, static_cast<int>(cell.size())).edges();
  if (edges.empty()) return facet;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<int, 2> edge{corners[k], corners[(k + 1) % 3]}, turned{edge[1], edge[0]};
    const auto at = std::find_if(edges.begin(), edges.end(), [&](const auto& e) { return e == edge || e == turned; });
    facet.push_back(cell[4 + static_cast<std::size_t>(at - edges.begin())]);
  }
  return facet;
}

std::vector<SolidFacet> boundary_facets(const SolidMesh& mesh) {
  std::map<std::array<int, 3>, int> cells_at;
  const auto key_of = [](const SolidFacet& facet) {
    std::array<int, 3> key{facet[0], facet[1], facet[2]};
    std::sort(key.begin(), key.end());
    return key;
  };
  for (const std::vector<int>& cell : mesh.cells)
    for (int side = 0; side < 4; ++side) ++cells_at[key_of(facet_of(cell, side))];
  std::vector<SolidFacet> facets;
  for (const std::vector<int>& cell : mesh.cells)
    for (int side = 0; side < 4; ++side)
      if (SolidFacet facet = facet_of(cell, side); cells_at[key_of(facet)] == 1) facets.push_back(std::move(facet));
  return facets;
}

std::optional<std::array<int, 2>> overlapping_cells(const SolidMesh& mesh) {
  std::vector<std::pair<std::array<int, 3>, int>> sides;  // corners in their order, the least one first
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const std::array<int, 3>& side : facets_of_cell) {
      std::array<int, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.cells[c][static_cast<std::size_t>(side[k])];
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      sides.emplace_back(corners, static_cast<int>(c));
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
    const Eigen::Matrix3d x = nodes_of(mesh, {facet[0], facet[1], facet[2]});
    const Eigen::RowVector3d heights = normal.transpose() * (x.colwise() - point);
    const Eigen::Vector3d a = x.col(1) - x.col(0), b = x.col(2) - x.col(0);
    if (heights.cwiseAbs().maxCoeff() <= distance && a.cross(b).dot(normal) > 0.0) chosen.push_back(facet);
  }
  return chosen;
}

}  // namespace scabo::mesh
