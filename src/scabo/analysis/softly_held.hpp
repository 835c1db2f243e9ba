// Contact forces that are lost in the rounding of how far a body would move without contact.
//
// Where soft springs, or parts that are far softer, alone hold a body, W p and q are each the way that contact forces
// and loads would move it on them, which is many orders of magnitude more than it moves in contact. Their sum keeps the
// digits that are left. The displaced bodies, found from the contact forces, tell how many: the motions of the pairs
// that follow from them must be those of the contact problem. Its certificate measures gaps and slips by the way that
// loads would move bodies without contact; here they are measured by the displacements.
#pragma once

#include <string>

#include "scabo/analysis/increment.hpp"

namespace scabo::analysis {

/// Why the forces of a solution are not those of the displaced bodies `to`; empty where they are, and where no body in
/// contact is held softly. `drawn`: 2N, motions of the pairs where no body is displaced.
std::string lost_where_softly_held(const Prepared& prepared, const State& to, const contact::Problem& problem,
                                   const contact::Solution& solution, const Vector& drawn);

}  // namespace scabo::analysis
