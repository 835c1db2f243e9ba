// Path of solutions of a plane problem from forces that need not solve it to those that do, one change of state after
// the other. Newton's method guesses the states of all pairs at once and may jump between guesses without end; where
// friction lets a load have several equilibria, or bodies are about to fall, this finds its way, and tells where the
// way ends.
//
// Any forces in the friction cones, with motions that agree with them (open: u_n > 0; stick: u = 0; slip: u_n = 0, u_t
// against p_t), solve the problem with other free motions q + dq and loads f + df. In between,
//
//     u = (q + t dq) + W p + G a,   0 = (f + t df) + G'p,   Coulomb's law,     t from 1 to 0
//
// is linear in (p, a, t) as long as no pair changes its state, and its solutions form a chain of straight pieces
// (Eaves, "A short course in solving equations with PL homotopies", SIAM-AMS Proc. 9 (1976) 73; of frictional contact:
// Klarbring, Bjorkman, Z. Angew. Math. Mech. 68 (1988) T55). At the end of a piece one pair is at its limit: it opens,
// closes, slips or sticks, and in the next piece moves on from there, which tells the direction, also where t grows
// again. The chain ends at t = 0, or its last piece leads to infinity, along a motion of the bodies that changes no
// force, or it goes back to larger t for good.
//
// One matrix is factorised for up to `changes` changes of state; each replaces a row (linalg/replaced_rows). To the
// diagonal of W `softness` times itself is added (of its mean where it is zero), because pairs of three bodies that
// meet in a point are redundant. Where no pair of a body sticks at the start, the matrix is singular unless the rows of
// balance are held as well (`hold`). Both are taken back at the end, the hold in tenths where that fails at once.
//
// Of thousands of pairs most of the way can be taken in leaps: past many limits at once, and at the t reached Newton's
// method with the factors at hand, where rows of all pairs beyond their limits are replaced together. Two or three
// iterations suffice, or it leads away: then a leap to half as many limits follows. A leap ends where the matrix has
// the same sign of its determinant as before: with the other sign, paths lead back. Where bodies are held, what
// Newton's method found before it led away begins a path of its own, whose dq and df are what is then missing; and so
// does, where asked for, a point from which a path does not come nearer to its end. What leaps do not pass, a body that
// begins to move or a path that turns back, is passed change by change.
#pragma once

#include <functional>
#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct PathStart {
  Vector p, a;                       ///< forces, moved into the friction cones here, and rigid motions
  std::vector<ContactState> states;  ///< N; the direction of slip follows from p
  /// Of the mean force: pairs start this far from their limits, each at another distance, also where a path begins
  /// again.
  double margin = 1e-2;
  double pressure = 0.0;  ///< of the mean force: added to the normal forces of the pairs in contact
};

struct PathOptions {
  double softness = 1e-6;
  double hold = 0.0;  ///< of the rows of balance, G'p - hold g a, g the square of each column of G; taken back as well
  int rounds = 8;     ///< paths that take the softness back, most
  int changes = 250;  ///< of state with one factorisation
  int most = 0;       ///< changes of state in all; 0: 100, and four for each pair
  int patience = 0;   ///< changes without a smaller t after which the path has turned back; 0: an eighth of `most`
  int together = 0;   ///< changes of state in a leap, most; 0: no leaps
  int again = 0;      ///< times that a path which turns back begins again where it is
  Deadline deadline = {};
  std::function<void(const Vector& p, const Vector& a)> on_factorisation = {};  ///< may be empty
};

struct PathEnd {
  /// arrived: t = 0. endless: no pair comes to a limit any more, bodies move on without end; of bodies that are held,
  /// what holds them stays the same however far they move. turned_back: t has grown again and `patience` changes, or
  /// more, do not lead below its least. broken: rounding, `most`, or the deadline.
  enum class How { arrived, endless, turned_back, broken } how = How::broken;
  Vector p, a;        ///< where the path ends
  double left = 1.0;  ///< the least t met; of bodies that fall when they are let go, what held them (each motion over
                      ///< the norm of what it moves pairs by) over the largest force
  Vector motion;      ///< rigid motions where t was least, or of the endless piece, of length 1; empty if arrived
  int factorisations = 0, changes = 0;
  int leaps = 0;  ///< that succeeded
};

/// Pairs of many bodies up to which a path comes before interior points, and up to which it follows them. Above the
/// first number a path near the limit load needs memory for its replaced rows (run/plan).
inline constexpr int most_of_paths_first = 1000, most_of_crossing = 16000;

/// Coulomb's law alone in the plane; W sparse, or dense with at most 2,000 rows.
bool may_follow_path(const Problem& problem);

/// W is symmetric and scaled to a mean W_ii of 1.
PathEnd follow_path(const Problem& problem, const PathStart& start, const PathOptions& options = {});

}  // namespace scabo::contact
