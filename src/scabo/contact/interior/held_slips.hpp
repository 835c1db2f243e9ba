// Interior points with slips held: the law as a fixed point of convex problems, for stacks of rigid bodies where
// interior points of the law itself (interior_points.hpp) reach no solution.
//
// With the lifts mu s of the pairs held, s their slips, the conditions of interior_steps.hpp with
//
//     u_n = y + mu (sigma - s)
//
// are those of a convex problem for a positive semidefinite W (of pairs without tensile strength): its motions u are
// unique, and interior points always lead to them (Acary, Cadoux, Lemarechal, Malick, ZAMM 91 (2011) 155). With s =
// |u_t| it is the law. A round solves it for one s; the next s are
//
//     plain            |u_t|
//     extrapolated     from the last four rounds (Anderson, J. ACM 12 (1965) 547; type II)
//     halved           half way between s and |u_t|
//
// plain at first, and the next of them, in turn, where |s - |u_t|| has not fallen by a third in thirty rounds; an end
// where it was not halved in sixty.
//
// Two details decide. A pair that sticks must be given s = 0 exactly: with the least s > 0 it carries nothing at all;
// of the points of a round |u_t| is known to about sqrt(m) only, so that what is below 3 sqrt(m) counts as 0. And a
// round starts where the gap of the last was a hundred times the square of the change of s: from closer to the boundary
// the steps collapse.
#pragma once

#include <functional>

#include "scabo/contact/interior/interior_points.hpp"

namespace scabo::contact {

/// Of a problem that may_take_interior_points(), until `accepts` says yes to forces and motions, the most rounds are
/// done or the deadline has passed. After each round whose natural map is at most an aim, the best point since is
/// handed to `cross_over`, and at the end; that returns true where the search is over, else the aim is a part of that
/// map.
void hold_slips(const Problem& problem, const IsSolution& accepts, const Deadline& deadline,
                const std::function<bool(InteriorPointEnd)>& cross_over);

}  // namespace scabo::contact
