// Pairs whose states a point does not tell: a step in which they all stick.
//
// Interior points know forces and motions to within |H|, which is more than pairs have at the tip of a crack: 1e-9 of
// the largest force, where sides are divided towards it. Their branches there are those of errors, of which Newton's
// method mends one ring of pairs after the other (13 to 28 iterations). Where they all stick, one step finds the field
// around the tip, which tells their states: 1 to 3 iterations follow. Where the faces slip at the tip the step leads
// away, and Newton's method is to begin at the point itself.
#pragma once

#include <optional>

#include "scabo/contact/newton/b_differentiable.hpp"

namespace scabo::contact {

struct UndecidedPairs {
  double below =
      30.0;      ///< times |H|: forces and motions below it. At crack tips 10 and 100 do as well, with 1 there are none
  int few = 10;  ///< of so many pairs not more than one is undecided: Newton's method finds its state itself
};
inline constexpr UndecidedPairs undecided_pairs;

/// The point after that step; nothing where less than a tenth of the pairs are undecided, or there is no step.
std::optional<Point> with_undecided_stuck(const BDifferentiableEquations& equations, const Point& from);

}  // namespace scabo::contact
