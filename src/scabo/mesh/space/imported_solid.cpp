#include "scabo/mesh/space/imported_solid.hpp"

#include <algorithm>
#include <set>

namespace scabo::mesh {

SolidMesh solid_mesh_of(const files::ImportedSolidMesh& file) {
  SolidMesh mesh;
  mesh.nodes = file.nodes;
  for (const files::ImportedSolidCell& cell : file.cells) mesh.cells.push_back(cell.nodes);
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
    if (std::all_of(facet.begin(), facet.begin() + 3, [&](int node) { return among.count(node) > 0; }))
      chosen.push_back(facet);
  return chosen;
}

}  // namespace scabo::mesh
