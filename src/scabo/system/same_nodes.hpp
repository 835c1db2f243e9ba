// Nodes of two meshes that are in the same place.
#pragma once

#include <vector>

#include "scabo/system/positions.hpp"

namespace scabo::system {

/// Of every node of a plane body that one of `before` in the same place, to the last bit, or -1. Where several are in
/// one place, as on the faces of a crack, they belong together in their order.
std::vector<int> same_nodes(const Positions& nodes, const Positions& before);

}  // namespace scabo::system
