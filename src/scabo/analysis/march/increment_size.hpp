// Size of automatic increments (docs/methods/07_history_and_increments.md).
//
// The result of a step depends on its increments only through history: friction and strengths that fall. So the size of
// the next increment follows from the share of pairs with such a law that changed their state in the last one:
//
//     size <- size * min( growth, wanted / changed ),   wanted = max( 1, share * pairs of such laws in contact )
//
// What an increment costs says nothing about its error, and does not count. An attempt that is not accepted, or that
// changes far more pairs than wanted, is made again with half the size. Where an attempt ends beyond what can be in
// equilibrium, increments close in on that limit: none goes farther than halfway to it, until it is within the smallest
// one. All figures are counts, so that the sizes depend neither on units nor on time, and the same model always gets
// the same.
#pragma once

#include "scabo/analysis/state/continuation.hpp"

namespace scabo::analysis {

/// Constants of the rule. Measured on cycles of friction (docs/decisions/0010-increments-and-resuming.md).
struct IncrementRule {
  double share = 0.05;      ///< of the pairs in contact that may change in an increment, 0 to 1
  double growth = 2.0;      ///< largest ratio of the sizes of successive increments, > 1: one halving is made good
  double reduction = 0.25;  ///< smallest one, < 1: a reversal of loads changes all pairs whatever the size
  double too_many = 3.0;    ///< changes relative to `wanted` beyond which an increment is made again
  int repeats = 3;          ///< at most; some changes (all pairs of a block begin to slide) do not become fewer
};

/// Pairs with friction or strength whose state differs between the ends of an increment, and those of them in contact
/// at one of its ends. Slip in the opposite direction is another state. Pairs that touch before the first increment
/// have no state yet and do not count.
struct Changes {
  int changed = 0;
  int released = 0;  ///< of them, from slip to stick: when loads turn, all do at once, whatever the size
  int in_contact = 0;

  double wanted(const IncrementRule& rule) const;
  bool too_many(const IncrementRule& rule) const;
};
Changes changes_between(const Prepared& prepared, const State& from, const State& to);

/// Size of the increment after one of `size` that was accepted; `halved`: only with a smaller size than planned, so
/// that the next one does not grow. Within the limits.
double next_size(const model::AutomaticIncrements& limits, double size, bool halved, const Changes& changes,
                 const IncrementRule& rule = {});

/// Part of the step at which the next increment ends; not beyond the next corner of a curve that a factor follows.
double next_end(const model::Step& step, const StepProgress& progress, const std::vector<double>& corners = {});

}  // namespace scabo::analysis
