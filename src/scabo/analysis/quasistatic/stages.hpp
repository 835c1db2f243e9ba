// Staged construction: bodies and supports that are put in place, or taken away, in a step.
//
// A body that is absent has neither stiffness nor weight nor loads, and its pairs do not act. Bodies are joined by
// contacts alone, and W is a sum over bodies, so that a stage of construction is the same system with fewer pairs and
// rigid motions (system/contact_system.hpp); nothing is factorised again.
//
//     put in place: its displacement and its stress are zero at the start of its step. A pair counts its motion from
//                   there: motion = B (u - u_0), u_0 the displacements of its two bodies when the second one came; its
//                   gap is then the gap as drawn, whatever the bodies below have settled. Of a reference point
//                   (outside.hpp) only what it moves from then on counts for the body. Its loads grow over the step
//                   from zero to their factors.
//     taken away:   the body and its pairs vanish at the start of its step. The forces p that its pairs exerted on what
//                   remains still act, and fall linearly to zero over the step:  f += (1 - s) B' p,  s from 0 to 1
//
// so that both are continuous, and increments follow them as they follow loads. The elastic energy of a body that is
// taken away, and of springs in its pairs, leaves with it: it is taken off the work of the loads. The stiffness of a
// bar with preload (system/bars.hpp) is a pair that is put in place after the step in which it is tightened. A support
// that begins or ends (system/held_points.hpp) is pairs as well: it holds its place where that is when it comes, and
// what it exerted falls to zero over the step in which it ends.
#pragma once

#include <optional>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// The system of the present stage.
class Stages {
 public:
  /// At `step`, whose state is known or is the initial one. `whole` has all bodies and outlives this.
  Stages(const Prepared& whole, std::size_t step);
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  const Prepared& now() const { return now_ ? *now_ : whole_; }
  /// Goes on to a step, from the accepted state at the end of the step before it.
  void enter(std::size_t step, State& state);

 private:
  void set(std::vector<char> absent, std::vector<char> waiting);

  const Prepared& whole_;
  std::vector<char> waiting_;  // per bar and held point: it does not act; empty: all do
  std::optional<system::ContactSystem> contact_;
  std::optional<Prepared> now_;  // empty: all bodies are there
};

}  // namespace scabo::analysis
