#include "scabo/base/cell_topology.hpp"

#include "scabo/base/error.hpp"

namespace scabo {

std::size_t CellTopology::middle(std::size_t a, std::size_t b) const {
  for (std::size_t e = 0; e < edges.size(); ++e)
    if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a)) return corners + e;
  throw BrokenInvariant("no edge leads from one of these corners to the other");
}

std::vector<std::size_t> CellTopology::nodes_of_side(std::size_t side, bool with_middles) const {
  std::vector<std::size_t> nodes = sides[side];
  const std::size_t count = nodes.size();
  for (std::size_t k = 0; with_middles && k < count; ++k) nodes.push_back(middle(nodes[k], nodes[(k + 1) % count]));
  return nodes;
}

const CellTopology& CellTopology::of(std::size_t nodes) {
  static const CellTopology tetrahedron{
      4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  static const CellTopology wedge{6,
                                  {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                                  {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
  static const CellTopology brick{
      8,
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  for (const CellTopology* of : {&tetrahedron, &wedge, &brick})
    if (nodes == of->corners || nodes == of->corners + of->edges.size()) return *of;
  throw BrokenInvariant("no cell in space has that many nodes");
}

}  // namespace scabo
