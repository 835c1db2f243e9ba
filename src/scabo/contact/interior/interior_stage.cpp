#include <utility>

#include "scabo/contact/interior/held_slips.hpp"
#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/newton/undecided_pairs.hpp"
#include "scabo/contact/stages.hpp"

namespace scabo::contact {

namespace {

/// Products of the start over those that the loads suggest, tried in turn.
constexpr double starts[] = {1.0, 0.1, 10.0};
/// Iterations of Newton's method after interior points: what converges takes fewer.
constexpr int crossover = 40, crossover_patience = 4;
/// Of the fixed point of slips held.
constexpr int most_rounds = 60;
/// Natural map after which slips held are first crossed over, and how much it falls between two crossings.
constexpr double first_aim = 1e-5, next_aim = 0.1;

/// Newton's method makes the states of the pairs certain; where pairs are redundant it may not, and the point is kept
/// if it is a solution.
bool crossed_over(Search& search, InteriorPointEnd end) {
  search.add_trace(std::move(end.trace), end.iterations, Measure(search.problem()).reference());
  if (end.p.size() == 0) return false;
  const double residual = search.residual_at(end.p, end.a);
  const NewtonRun run{"newton after interior points", crossover, crossover_patience};
  const BDifferentiableEquations equations(search.problem(), search.options().r_factor);
  if (std::optional<Point> stuck = with_undecided_stuck(equations, {end.p, end.a}))
    if (search.newton_from(*std::move(stuck), run).converged) return true;
  if (search.newton_from({end.p, end.a}, run).converged) return true;
  if (end.content) search.offer(end.p, end.a, residual, true);
  return end.content;
}

void hold_slips(Search& search) {
  HeldSlips held(search.problem());
  for (double aim = first_aim; !search.solved() && !search.late();) {
    InteriorPointEnd end = held.advance(aim, most_rounds, HUGE_VAL, search.judge(), search.options().deadline);
    const double reached = end.residual;
    if (crossed_over(search, std::move(end)) || reached > aim) return;
    aim = next_aim * reached;
  }
}

}  // namespace

StageEnd interior_stage(Search& search) {
  if (!may_take_interior_points(search.problem()))
    return {false, "interior points need a matrix W that can be factorised"};
  int steps = 0;
  for (const double start : starts) {
    InteriorPointEnd end = interior_points(search.problem(), search.judge(), search.options().deadline, start);
    steps += end.iterations;
    if (crossed_over(search, std::move(end)) || search.late()) break;
  }
  if (!search.solved() && !search.late()) hold_slips(search);
  return {search.solved(), "interior points ended after " + std::to_string(steps) + " steps"};
}

}  // namespace scabo::contact
