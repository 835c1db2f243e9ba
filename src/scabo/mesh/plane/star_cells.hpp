// A shape that no point sees as a whole, divided into few parts that are each seen from one point.
//
// The corners of the lines are triangulated (coarse: arcs count as a few chords); then neighbouring parts of one region
// are joined, best first, as long as a point of the union sees its whole boundary well. New sides between parts are
// divided by the wanted size.
#pragma once

#include "scabo/mesh/plane/domain.hpp"

namespace scabo::mesh {

/// Cells with a node at every point of the lines. Throws InputError, without a place in a file, if lines cross.
PolygonMesh star_cells(const Domain& domain);

}  // namespace scabo::mesh
