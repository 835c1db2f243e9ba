// The planar graph of the sides of the cells that lines touch and of the pieces of the lines between them. Its faces
// are the cut cells.
#pragma once

#include "scabo/mesh/plane/quadtree/curves.hpp"
#include "scabo/mesh/plane/quadtree/forest.hpp"
#include "scabo/mesh/plane/quadtree/pieces.hpp"

namespace scabo::mesh::quadtree {

/// The neighbourhood of a point that becomes the centre of an open cell: the leaves in a box are one cell.
struct Patch {
  int corner = -1;  ///< of Curves
  Box box;
};

/// Cells of all leaves. Where the lines leave no valid cells, a point of each such place is appended to `trouble`: the
/// leaves there are to be divided.
Pieces cut_leaves(const Forest& forest, const std::vector<int>& leaves, const std::vector<std::vector<int>>& lists,
                  const Curves& curves, const RegionFinder& regions, const std::vector<Patch>& patches,
                  std::vector<Vec2>& trouble);

}  // namespace scabo::mesh::quadtree
