#include "scabo/mesh/space/solid_edges.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "scabo/base/cell_topology.hpp"

namespace scabo::mesh {

namespace {

using Ends = std::pair<int, int>;  // ascending

/// The middle nodes of the edges of facets, by the ends.
using EdgesOfFacets = std::map<Ends, int>;

SolidEdge edge_from(const EdgesOfFacets::value_type& edge) {
  return {edge.first.first, edge.first.second, edge.second};
}

EdgesOfFacets edges_of_facets(const std::vector<SolidFacet>& facets) {
  EdgesOfFacets edges;
  for (const SolidFacet& facet : facets) {
    const std::size_t corners = mesh::corners_of(facet);
    for (std::size_t k = 0; k < corners; ++k)
      edges.emplace(Ends(std::minmax(facet[k], facet[(k + 1) % corners])), facet[corners + k]);
  }
  return edges;
}

/// Each without the facets that others have as well.
std::vector<std::vector<SolidFacet>> apart(std::vector<std::vector<SolidFacet>> faces) {
  std::map<SolidFacet, int> owners;
  const auto key_of = [](SolidFacet facet) {
    std::sort(facet.begin(), facet.end());
    return facet;
  };
  for (const std::vector<SolidFacet>& face : faces)
    for (const SolidFacet& facet : face) ++owners[key_of(facet)];
  for (std::vector<SolidFacet>& face : faces)
    std::erase_if(face, [&](const SolidFacet& facet) { return owners.at(key_of(facet)) > 1; });
  return faces;
}

std::set<int> corners_of_all(const std::vector<SolidFacet>& facets) {
  std::set<int> corners;
  for (const SolidFacet& facet : facets)
    corners.insert(facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(mesh::corners_of(facet)));
  return corners;
}

}  // namespace

std::vector<SolidEdge> edges_between(const std::vector<SolidFacet>& a, const std::vector<SolidFacet>& b) {
  const auto faces = apart({a, b});
  const EdgesOfFacets of_a = edges_of_facets(faces[0]), of_b = edges_of_facets(faces[1]);
  std::vector<SolidEdge> common;
  for (const auto& edge : of_a)
    if (of_b.count(edge.first) > 0) common.push_back(edge_from(edge));
  return common;
}

std::vector<int> corners_between(const std::vector<std::vector<SolidFacet>>& faces) {
  std::map<int, std::size_t> count;
  for (const std::vector<SolidFacet>& face : apart(faces))
    for (const int corner : corners_of_all(face)) ++count[corner];
  std::vector<int> common;
  for (const auto& [corner, of] : count)
    if (of == faces.size()) common.push_back(corner);
  return common;
}

std::vector<SolidEdge> edges_among(const std::vector<SolidFacet>& facets, const std::vector<int>& nodes, int given) {
  const std::set<int> among(nodes.begin(), nodes.end());
  std::vector<SolidEdge> chosen;
  for (const auto& edge : edges_of_facets(facets)) {
    const SolidEdge of = edge_from(edge);
    if (std::all_of(of.begin(), of.end(), [&](int node) { return node >= given || among.count(node) > 0; }))
      chosen.push_back(of);
  }
  return chosen;
}

std::vector<SolidEdge> edges_with_ends(const SolidMesh& mesh, const std::vector<std::array<int, 2>>& ends) {
  std::map<Ends, int> middles;
  for (const auto& [a, b] : ends) middles.emplace(std::minmax(a, b), -1);
  for (const std::vector<int>& cell : mesh.cells) {
    const auto& topology = CellTopology::of(cell.size());
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const auto at = middles.find(std::minmax(cell[topology.edges[e][0]], cell[topology.edges[e][1]]));
      if (at != middles.end()) at->second = cell[topology.corners + e];
    }
  }
  std::vector<SolidEdge> edges;
  for (const auto& edge : middles)
    if (edge.second >= 0) edges.push_back(edge_from(edge));
  return edges;
}

std::vector<SolidEdge> piece_nearest(const SolidMesh& mesh, const std::vector<SolidEdge>& edges,
                                     const Eigen::Vector3d& point) {
  std::map<int, std::vector<std::size_t>> at_node;
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const int node : edges[e]) {
      at_node[node].push_back(e);
      const double distance = (mesh.nodes.col(node) - point).squaredNorm();
      if (distance < least) least = distance, nearest = e;
    }
  std::set<std::size_t> piece;
  std::vector<std::size_t> next;
  if (!edges.empty()) next.push_back(nearest);
  while (!next.empty()) {
    const std::size_t e = next.back();
    next.pop_back();
    if (!piece.insert(e).second) continue;
    for (const int node : edges[e]) next.insert(next.end(), at_node[node].begin(), at_node[node].end());
  }
  std::vector<SolidEdge> found;
  for (const std::size_t e : piece) found.push_back(edges[e]);
  return found;
}

std::vector<int> nodes_of_edges(const std::vector<SolidEdge>& edges) {
  std::set<int> nodes;
  for (const SolidEdge& edge : edges) nodes.insert(edge.begin(), edge.end());
  return {nodes.begin(), nodes.end()};
}

}  // namespace scabo::mesh
