// Small plane meshes as .vtu text, for tests of bodies from mesh files.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::test {

/// Cells by the types of VTK: 5 triangle, 9 quadrilateral, 22 and 23 the same with middle nodes, 7 polygon, 36
/// quadratic polygon; 3 a line, which names sides `boundary_N` by the value of `region`, and 1 a point.
struct MeshText {
  struct Cell {
    int type = 9;
    std::vector<int> nodes;
    int region = 1;
  };
  std::vector<Vec2> nodes;
  std::vector<Cell> cells;

  std::string vtu() const;
  /// Writes it into a new file in the folder for temporary files, which is removed when the program ends, and gives its
  /// path.
  std::string file() const;
};

/// Divides `width` x `height` into nx x ny quadrilaterals (types 9 and 23), pairs of triangles (5 and 22) or hexagons
/// (7 and 36: two quadrilaterals beside each other; nx even). Nodes inside are moved by up to a fifth of a cell, sides
/// inside are curved if they have middle nodes. `region`: of a cell by its column and row.
MeshText mesh_of_rectangle(int type, double width, double height, int nx, int ny,
                           const std::function<int(int, int)>& region = {});

/// A disc of radius 1 (region 1) in a ring up to radius 2 (region 2): a polygon of `sides` sides in the middle, then
/// quadrilaterals; with middle nodes on circles if `quadratic`.
MeshText mesh_of_disc_in_ring(int sides, bool quadratic);

}  // namespace scabo::test
