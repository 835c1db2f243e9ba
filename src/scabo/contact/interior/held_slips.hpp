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
// plain at first, and the next of them, in turn, where |s - |u_t|| has not fallen by a third in thirty rounds. On
// piles with much friction the extrapolated ones wander, and plain ones swing between two values on others.
//
// Two details decide. A pair that sticks must be given s = 0 exactly: with the least s > 0 it carries nothing at all;
// of the points of a round |u_t| is known to about sqrt(m) only, so that what is below 3 sqrt(m) counts as 0. And a
// round starts where the gap of the last was a hundred times the square of the change of s: from closer to the boundary
// the steps collapse.
#pragma once

#include <memory>

#include "scabo/contact/interior/interior_points.hpp"

namespace scabo::contact {

class HeldSlips {
 public:
  /// Of a problem that may_take_interior_points(). Keeps a reference to `problem`.
  explicit HeldSlips(const Problem& problem);
  ~HeldSlips();
  HeldSlips(HeldSlips&&) noexcept;
  HeldSlips& operator=(HeldSlips&&) noexcept;

  /// Goes on where it ended before, until `content` accepts forces and motions, the natural map is at most `aim` after
  /// a round, `rounds` rounds are done in all, or the slips' distance |s - |u_t|| is larger than `fall` per round times
  /// that of the first. The best point of this call.
  InteriorPointEnd advance(double aim, int rounds, double fall, const IsSolution& content,
                           const Deadline& deadline = {});

 private:
  struct Rounds;
  std::unique_ptr<Rounds> rounds_;
};

}  // namespace scabo::contact
