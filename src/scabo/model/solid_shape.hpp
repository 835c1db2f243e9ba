// Shapes of bodies in space that need no mesh file, and the names of their faces.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::model {

/// Along the axes. Faces left and right (x), front and back (y), bottom and top (z).
struct SolidBox {
  Eigen::Vector3d corner, size;  ///< the corner with the least coordinates; > 0
};

/// Faces bottom (at `from`), top (at `to`) and side.
struct SolidCylinder {
  Eigen::Vector3d from, to;  ///< centres of the ends
  double radius = 0.0;       ///< > 0
};

/// Faces bottom, top, inside and outside.
struct SolidTube {
  Eigen::Vector3d from, to;
  double inner = 0.0, outer = 0.0;  ///< radii, 0 < inner < outer
};

/// A sphere, or the half, quarter or eighth of it on one side of planes through its centre across the axes. Faces
/// surface, and of these planes cut_x, cut_y, cut_z.
struct SolidSphere {
  Eigen::Vector3d centre;
  double radius = 0.0;  ///< > 0
  /// For each axis: 1 and -1, what is above and below the centre; 0, both.
  std::array<int, 3> kept{0, 0, 0};
};

/// A plane outline, in two of the axes, drawn along the third one. Faces start and end, and those of the edges of the
/// outline by their names.
struct SolidExtrusion {
  geometry::Outline outline;
  std::array<int, 3> axes{0, 1, 2};  ///< of the first and second coordinate of the outline, and across
  double from = 0.0, to = 0.0;       ///< coordinate across, from < to
};

using SolidShape = std::variant<SolidBox, SolidCylinder, SolidTube, SolidSphere, SolidExtrusion>;

/// Whether it can be divided into hexahedra or wedges.
bool has_hexahedra(const SolidShape& shape);

/// In the order of their creation by mesh::solid_of_shape.
std::vector<std::string> face_names(const SolidShape& shape);

/// Distances of nodes of the bricks that are divided into tetrahedra, or are cells themselves.
struct SolidSizes {
  struct Near {
    Eigen::Vector3d point;
    double size = 0.0;    ///< there, > 0
    double growth = 0.3;  ///< of the size with the distance
  };
  double size = 0.0;  ///< at most, > 0
  std::vector<Near> near;
  bool hexahedra = false;  ///< and wedges, instead of tetrahedra: of boxes, tubes and extrusions
};

}  // namespace scabo::model
