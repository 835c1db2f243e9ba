// A mesh of solids as a file gives it: nodes, cells and named sets, in one form for all formats.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// What becomes of the hexahedra and wedges of a file: tetrahedra, or cells.
enum class Bricks { divided, kept };

/// A tetrahedron with 4 or 10 nodes; where these are kept, also a wedge with 6 or 15, or a hexahedron with 8 or 20
/// (CellTopology).
struct ImportedSolidCell {
  std::vector<int> nodes;
  long number = 0;  ///< as in the file; in .vtu files its position from 0
};

/// Side i of a cell, from 0: CellTopology::sides.
struct SolidSide {
  int cell = -1, side = 0;
};
struct SolidSideSet {
  std::string name;
  std::vector<SolidSide> sides;
};

/// A curve: the ends of its pieces, edges of cells.
struct SolidLineSet {
  std::string name;
  std::vector<std::array<int, 2>> edges;
};

/// Lengths are in the unit of the file. Guaranteed: there are cells, every node belongs to one, coordinates are finite,
/// and (x2 - x1) x (x3 - x1) . (x4 - x1) of the corners of a tetrahedron is positive. Other cells are not turned over.
struct ImportedSolidMesh {
  Matrix nodes = Matrix(3, 0);  ///< 3 x N
  std::vector<ImportedSolidCell> cells;
  std::vector<NodeSet> node_sets;       ///< without repetition, those of nodes that belong to cells
  std::vector<CellSet> cell_sets;       ///< without repetition, ascending
  std::vector<SolidSideSet> side_sets;  ///< without repetition; of a side between two cells, that of both may be there
  std::vector<SolidLineSet> line_sets;  ///< nodes that belong to cells
  std::vector<std::string> remarks;     ///< what of the file was left out though it may matter
};

int sides_of(const ImportedSolidCell& cell);
/// Corners of side i of a cell, counter-clockwise seen from outside.
std::vector<int> corners_of(const ImportedSolidCell& cell, int side);
/// The corners, and the nodes in the middle of its edges if the cell has them.
std::vector<int> nodes_of_side(const ImportedSolidCell& cell, int side);
/// The triangle that the corners of a side are, or the two of a quadrilateral.
std::vector<std::vector<int>> triangles_of_side(const ImportedSolidCell& cell, int side);

}  // namespace scabo::files
