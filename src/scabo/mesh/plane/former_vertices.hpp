// What polygons were made from, so that the mesh of a body whose cracks have become longer keeps those that are far
// from the new pieces, to the last bit.
//
// Pieces of lines stay as they were divided, and vertices inside stay where they were, except where they are too coarse
// or too fine by now (is_near() of interior_points.hpp), and vertices next to segments that are new. Others are laid in
// the room of those that went, and only these are smoothed. As vertices that stay keep their order, too, cells between
// them have the same corners in the same order. A mesh then depends on all those before it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scabo/geometry/plane/outline.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/interior_points.hpp"

namespace scabo::mesh {

/// A line of a body, and the fractions of its length at which it was divided, 0 and 1 included.
struct FormerLine {
  geometry::Edge edge;
  std::vector<double> breaks;
};

/// Of one body, in coordinates of its own (unit_free.hpp); empty where there was no mesh of polygons.
struct FormerVertices {
  int attempt = 0;  ///< of those to divide the body (many_cells.cpp): another one lays other vertices
  std::vector<FormerLine> lines;
  std::vector<std::array<double, 4>> segments;  ///< on lines, sorted
  InteriorPoints inside;

  /// A segment between two points, in whichever order.
  static std::array<double, 4> segment(const Vec2& a, const Vec2& b) {
    const std::array<double, 4> one{a.x(), a.y(), b.x(), b.y()}, other{b.x(), b.y(), a.x(), a.y()};
    return std::min(one, other);
  }
  bool has(const std::array<double, 4>& segment) const {
    return std::binary_search(segments.begin(), segments.end(), segment);
  }
};

/// make_mesh() (mesh.hpp) of a model of whose bodies there were other meshes, `former`: one for each body, which become
/// those of this mesh. Where they are empty, the mesh is that of make_mesh().
Mesh make_mesh(const model::Model& model, std::vector<FormerVertices>& former);

/// Whether there is a body of which such a mesh keeps something.
bool has_polygons(const model::Model& model);

}  // namespace scabo::mesh
