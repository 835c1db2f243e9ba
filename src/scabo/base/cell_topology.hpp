// Corners, sides and edges of the cells of bodies in space: tetrahedra, wedges and hexahedra.
//
// Nodes are the corners, then the middles of the edges in their order (as Abaqus, CalculiX and VTK number them). Wedges
// and hexahedra have the corners of one end counter-clockwise seen from the other, which follows in the same order.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace scabo {

struct CellTopology {
  std::size_t corners;
  std::vector<std::vector<std::size_t>> sides;    ///< their corners, counter-clockwise seen from outside
  std::vector<std::array<std::size_t, 2>> edges;  ///< the corners between which the middle nodes are

  /// The node in the middle of the edge between two corners of a cell with middle nodes.
  std::size_t middle(std::size_t a, std::size_t b) const;
  /// Nodes of a side of a cell: its corners, then, if the cell has middle nodes, those of the edges 12, 23 and so on.
  std::vector<std::size_t> nodes_of_side(std::size_t side, bool with_middles) const;

  /// Of a cell with 4 or 10, 6 or 15, 8 or 20 nodes.
  static const CellTopology& of(std::size_t nodes);
};

}  // namespace scabo
