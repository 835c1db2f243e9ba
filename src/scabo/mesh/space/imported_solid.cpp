#include "scabo/mesh/space/imported_solid.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "scabo/base/cell_topology.hpp"

namespace scabo::mesh {

namespace {

using EdgeOfCell = std::pair<int, int>;  // corners, ascending

/// Calls `visit` with every edge of a cell and its place in the cell.
template <typename Visit>
void for_edges(const std::vector<int>& cell, const Visit& visit) {
  const auto& topology = CellTopology::of(cell.size());
  std::size_t place = topology.corners;
  for (const auto& edge : topology.edges) visit(EdgeOfCell(std::minmax(cell[edge[0]], cell[edge[1]])), place++);
}

bool is_quadratic(const std::vector<int>& cell) { return cell.size() > CellTopology::of(cell.size()).corners; }

/// Gives cells with corners only the nodes in the middle of their edges: that of a quadratic neighbour, or one on a
/// straight edge.
void raise_to_quadratic(SolidMesh& mesh) {
  std::map<EdgeOfCell, int> middle_of;
  for (const std::vector<int>& cell : mesh.cells)
    if (is_quadratic(cell))
      for_edges(cell, [&](const EdgeOfCell& edge, std::size_t place) { middle_of[edge] = cell[place]; });
  std::vector<Eigen::Vector3d> added;
  const auto before = static_cast<int>(mesh.nodes.cols());
  for (std::vector<int>& cell : mesh.cells) {
    if (is_quadratic(cell)) continue;
    for_edges(cell, [&](const EdgeOfCell& edge, std::size_t) {
      const auto [middle, is_new] = middle_of.try_emplace(edge, before + static_cast<int>(added.size()));
      if (is_new) added.push_back(0.5 * (mesh.nodes.col(edge.first) + mesh.nodes.col(edge.second)));
      cell.push_back(middle->second);
    });
  }
  mesh.nodes.conservativeResize(3, before + static_cast<Eigen::Index>(added.size()));
  for (std::size_t i = 0; i < added.size(); ++i) mesh.nodes.col(before + static_cast<Eigen::Index>(i)) = added[i];
}

}  // namespace

SolidMesh solid_mesh_of(const files::ImportedSolidMesh& file) {
  SolidMesh mesh;
  mesh.nodes = file.nodes;
  for (const files::ImportedSolidCell& cell : file.cells) mesh.cells.push_back(cell.nodes);
  raise_to_quadratic(mesh);
  return mesh;
}

std::vector<SolidFacet> facets_of_sides(const SolidMesh& mesh, const std::vector<files::SolidSide>& sides) {
  std::vector<SolidFacet> facets;
  for (const files::SolidSide& at : sides)
    facets.push_back(facet_of(mesh.cells[static_cast<std::size_t>(at.cell)], at.side));
  return facets;
}

std::vector<SolidFacet> facets_among(const std::vector<SolidFacet>& facets, const std::vector<int>& nodes) {
  const std::set<int> among(nodes.begin(), nodes.end());
  std::vector<SolidFacet> chosen;
  for (const SolidFacet& facet : facets)
    if (std::all_of(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(corners_of(facet)),
                    [&](int node) { return among.count(node) > 0; }))
      chosen.push_back(facet);
  return chosen;
}

}  // namespace scabo::mesh
