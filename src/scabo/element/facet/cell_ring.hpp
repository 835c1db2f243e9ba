// The ring of a cell in memory that is there: of many cells one after the other.
#pragma once

#include "scabo/element/facet/coefficient_matrices.hpp"

namespace scabo::element {

/// `ring` becomes ring_of(cell, nodes).
void set_ring(Ring& ring, const mesh::Cell& cell, const std::vector<Vec2>& nodes);

}  // namespace scabo::element
