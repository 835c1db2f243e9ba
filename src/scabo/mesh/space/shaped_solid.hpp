// Quadratic tetrahedra, or hexahedra with 20 nodes, of the simple shapes of bodies in space.
//
// A shape is a map of a grid of bricks in three parameters, each of which is a hexahedron, or divided into six
// tetrahedra along its diagonal away from the middle of the grid (Kuhn). Lines of the grid lie along the parameters at
// the wanted distances. Nodes of curved faces lie on them, those in the middle of edges too. Extrusions:
// mesh/extruded_solid.hpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scabo/mesh/space/solid_mesh.hpp"
#include "scabo/model/solid_shape.hpp"

namespace scabo::mesh {

struct ShapedSolid {
  SolidMesh mesh;
  std::map<std::string, std::vector<SolidFacet>> faces;  ///< of all model::face_names
};

/// Nodes of the mesh of a shape: known before it is made.
double count_nodes(const model::SolidShape& shape, const model::SolidSizes& sizes);

ShapedSolid solid_of_shape(const model::SolidShape& shape, const model::SolidSizes& sizes);

/// Values of a parameter from `first` to `last` at distances of at most `size`, or less near some of its values.
struct SizeAt {
  double at, size, growth;
};
std::vector<double> divided(double first, double last, double size, const std::vector<SizeAt>& near, int least);

}  // namespace scabo::mesh
