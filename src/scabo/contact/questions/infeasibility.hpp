// Proof that a contact problem without rigid motions (m = 0) has no solution.
//
// Forces r in the friction cones that cause no motion, W r = 0, are in equilibrium with themselves: a wedged block, a
// column between a floor and a ceiling. For any contact forces p, r.u = q.r + (W'r).p = q.r. Let q.r < 0.
//
// 1. Along the normals alone, r_t = 0. A solution has u_n >= 0 in every pair, hence r.u >= 0: there is none, with any
//    friction, cohesion or tension. By Farkas's lemma such an r exists exactly when no forces at all, in the cones or
//    not, leave every gap u_n >= 0.
// 2. With tangents. No motion u then lies in the dual cone, u_n >= mu |u_t|, and the theorem that a solution exists
//    where one does (Klarbring, Pang, SIAM J. Optim. 8 (1998) 579; Acary, Cadoux, Lemarechal, Malick, ZAMM 91 (2011)
//    155) says nothing. That is no proof: Coulomb's law asks u_n >= 0 only, and with q = [1, -5], mu = 1/2 and
//    W = w w', w = [-1, 2], forces of zero solve the problem although r = [2, 1] has W r = 0 and q.r = -3. Of a pair
//    that no other pair moves the cases are few and are gone through: open (q_n < 0), stick (u = 0 contradicts q.r <
//    0), slip along every direction. Slip along an arc of directions e is relaxed to
//
//        p = p_n [1, -mu e'], e' in a triangle around the arc;   u = s [0, e''], e'' in the sector;   p_n, s >= 0
//
//    and excluded where u = q + W p has no such solution (non-negative least squares); other arcs are halved.
//
// Each proof is checked by proves_no_motion(), which shares nothing with the search.
#pragma once

#include <optional>
#include <string>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct Infeasibility {
  Vector r;             // dN; largest entry 1
  bool proven = false;  ///< there is no solution; otherwise only no motion in the dual cone
  std::string reason;   ///< a sentence
};

/// Whether r lies in the friction cones, q.r < 0 beyond rounding, and W'r = 0 within rounding: forces p with u in the
/// dual cone would have to exceed 1e10 times those that would cancel q.
bool proves_no_motion(const Problem& problem, const Vector& r);

/// Searches for a proof; nothing if none was found. There is no search with rigid motions, with a condensed W, or for
/// more than 1500 pairs (500 with a dense W). Dense work of about N^3 / 3.
std::optional<Infeasibility> find_infeasibility(const Problem& problem, const Deadline& deadline = {});

/// Sets the status of a solution that was not found to infeasible if the result is proven; otherwise adds it to the
/// reason.
void mark_infeasible(Solution& solution, const Infeasibility& found);

}  // namespace scabo::contact
