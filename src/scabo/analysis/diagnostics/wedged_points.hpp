// Points of a body that friction wedges between two others: a toe in a corner, the tip of a wedge.
//
// Of two contacts that meet in a node of a body, the sides enclose an angle beta. Where it is less than the angles of
// friction together, atan mu_1 + atan mu_2, both friction cones have a direction in common: forces r of any size along
// it balance each other. If the other two bodies do not give way either, r moves nothing, W r = 0 and G'r = 0. With
// q.r < 0 these bodies are driven towards each other along r, and no finite force makes room: Coulomb's law has in
// general no solution (contact/questions/infeasibility.hpp). In the continuum the stress in such a tip grows as 1 /
// distance.
#pragma once

#include <string>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// `problem`: of an attempt on these pairs that was not solved. A clause that names the first such point, the two pairs
/// and the body; empty if there is none.
std::string wedged_point(const Prepared& prepared, const contact::Problem& problem);

}  // namespace scabo::analysis
