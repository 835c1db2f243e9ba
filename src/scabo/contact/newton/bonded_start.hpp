// A start for Newton where contact alone holds many bodies: every touching pair held in both directions.
//
//     [ W + eps diag(W)   G ] [ p ]     [ q ]
//     [ G'                0 ] [ a ] = - [ f ]           on the pairs that touch; p = 0 on the others
//
// This is one linear system. It gives the forces of a wall or a tower in all courses at once, whereas sweeps carry them
// from one body to the next: a tower of 50 blocks under a push of 8 kPa takes 4 Newton iterations instead of 1676.
// eps W_ii (1e-3) keeps the system regular where pairs of three bodies that meet in a point are redundant. Where all
// bodies together are free to move, as in a press fit without supports, -delta on the diagonal of the lower rows holds
// them: forces are kept if they balance the loads.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Where W has a holder of its pairs (pair_operator.hpp) and is known by its products alone, the bodies are joined
/// there, and the pairs are held exactly: no eps.
///
/// `touching`: N, or empty: all. W scaled so that its diagonal is 1 in the mean. Nothing where the loads
/// act along a rigid motion that the touching pairs leave free, or numbers are out of range.
std::optional<Point> bonded_start(const Problem& problem, const std::vector<bool>& touching);

}  // namespace scabo::contact
