// A contact problem whose rigid motions have units that do not matter.
//
// A problem of another program may measure its rigid motions, the columns of G, in any units: metres, millimetres,
// radians. Neither forces nor motions of the pairs depend on them: with D diagonal, G a = (G D) (D^-1 a) and
// (G D)' p + D f = D (G' p + f). What a solver does and how the balance G' p + f = 0 is judged do depend on them, so
// that such problems are solved with columns whose largest entry lies in [1, 2). The factors are powers of two and
// therefore exact. A motion that moves no pair is to be left out: its column is nothing but rounding. The rigid motions
// of Scabo's own problems are translations and rotations over the size of the body, and stay.
#pragma once

#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct UnitMotions {
  Problem problem;  ///< with G D and D f
  Start start;      ///< with D^-1 a
  Vector unit;      ///< m, diagonal of D

  /// A solution of `problem` as one of the given problem.
  Solution given(Solution solution) const;
};

UnitMotions in_unit_motions(const Problem& problem, const Start& start);

}  // namespace scabo::contact
