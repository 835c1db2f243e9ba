#include <utility>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/interior/held_slips.hpp"
#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/newton/kept_states.hpp"
#include "scabo/contact/stages.hpp"

namespace scabo::contact {

namespace {

/// Newton's method makes the states of the pairs certain; where pairs are redundant it may not, and the point is kept
/// if it is a solution.
bool crossed_over(Search& search, InteriorPointEnd end) {
  search.add_trace(std::move(end.trace), end.iterations, Measure(search.problem()).reference());
  if (end.p.size() == 0) return false;
  const double residual = search.residual_at(end.p, end.a);
  const NewtonRun run{"newton after interior points", interior_constants.crossover,
                      interior_constants.crossover_patience};
  if (std::optional<Point> stuck = with_undecided_stuck(search.equations(), {end.p, end.a}))
    if (search.newton_from(*std::move(stuck), run).converged) return true;
  if (search.newton_from({end.p, end.a}, run).converged) return true;
  if (end.accepted) search.offer(end.p, end.a, residual, true);
  return end.accepted;
}

}  // namespace

StageEnd interior_stage(Search& search) {
  if (!may_take_interior_points(search.problem()))
    return {false, "interior points need a matrix W that can be factorised"};
  int steps = 0;
  for (const double start : interior_constants.starts) {
    InteriorPointEnd end = interior_points(search.problem(), search.judge(), search.options().deadline, start);
    steps += end.iterations;
    if (crossed_over(search, std::move(end)) || search.late()) break;
  }
  return {search.solved(), "interior points ended after " + std::to_string(steps) + " steps"};
}

StageEnd held_slips_stage(Search& search) {
  if (!may_take_interior_points(search.problem())) return {false, "slips held need interior points"};
  hold_slips(search.problem(), search.judge(), search.options().deadline,
             [&](InteriorPointEnd end) { return crossed_over(search, std::move(end)) || search.late(); });
  return {search.solved(), "slips held did not settle"};
}

}  // namespace scabo::contact
