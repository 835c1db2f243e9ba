// Divides the two sides of one contact alike: a step of match_sides (match.hpp, where the rules stand).
#pragma once

#include <vector>

#include "scabo/mesh/plane/matched_side.hpp"

namespace scabo::mesh {

/// Gives both sides the union of their break points and fixes the nodes there. False if nothing had to change.
bool unite_sides(MatchedSide a, MatchedSide b, std::vector<BodyMesh>& bodies, FixedNodes& fixed);

}  // namespace scabo::mesh
