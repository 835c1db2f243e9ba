// Supports of a model in space, from the displacements that a deck of solids gives at its nodes.
#pragma once

#include "scabo/convert/solid_model_writer.hpp"

namespace scabo::convert {

/// Nodes of a body that are held alike are one set. Axes of nodes (deck_transforms.hpp) become directions; those of
/// nodes that are fixed along all three do not matter. Sides between nodes that are fixed along the radii of a cylinder
/// are held along their normals, which is refused for several cylinders at once, as other axes are that turn from node
/// to node.
void write_supports(SolidModelWriter& writer);

}  // namespace scabo::convert
