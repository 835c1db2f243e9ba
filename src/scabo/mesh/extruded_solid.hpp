// Quadratic tetrahedra, or wedges with 15 nodes, of a plane outline that is drawn along an axis.
//
// Triangles of the outline (divide_into_cells) become a prism in every layer, each of which is a wedge, or divided into
// three tetrahedra. The diagonal of a side of a prism leads up from that of its two plane nodes with the smaller
// number, so that neighbours divide it alike. Nodes of curved edges lie on them.
#pragma once

#include <variant>

#include "scabo/base/error.hpp"
#include "scabo/mesh/space/shaped_solid.hpp"

namespace scabo::mesh {

/// About as many nodes.
double count_nodes(const model::SolidExtrusion& extrusion, const model::SolidSizes& sizes);

/// Or why the outline cannot be divided.
std::variant<ShapedSolid, Diagnostic> extruded_solid(const model::SolidExtrusion& extrusion,
                                                     const model::SolidSizes& sizes, double most_nodes);

}  // namespace scabo::mesh
