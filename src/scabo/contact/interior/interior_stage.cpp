#include <optional>
#include <utility>

#include "scabo/contact/interior/held_slips.hpp"
#include "scabo/contact/interior/interior_point.hpp"
#include "scabo/contact/interior/plane_interior_points.hpp"
#include "scabo/contact/newton/bonded_start.hpp"
#include "scabo/contact/newton/undecided_pairs.hpp"
#include "scabo/contact/stages.hpp"

namespace scabo::contact {

namespace {

/// Products of the start over those that the loads suggest, tried in turn.
constexpr double starts[] = {1.0, 0.1, 10.0};
/// Iterations of Newton's method after interior points: what converges takes fewer.
constexpr int crossover = 40, crossover_patience = 4;
/// Of the fixed point of slips held.
constexpr int most_rounds = 300;

/// Newton's method makes the states of the pairs certain; where pairs are redundant it may not, and the point is kept
/// if it is a solution.
bool crossed_over(Search& search, InteriorPointEnd end) {
  if (end.p.size() == 0) return false;
  if (end.a.size() != search.problem().G.cols()) end.a.setZero(search.problem().G.cols());
  const double residual = search.residual_at(end.p, end.a);
  const NewtonRun run{"newton after interior points", crossover, crossover_patience};
  const BDifferentiableEquations equations(search.problem(), search.options().r_factor);
  if (std::optional<Point> stuck = with_undecided_stuck(equations, {end.p, end.a}))
    if (search.newton_from(*std::move(stuck), run).converged) return true;
  if (search.newton_from({end.p, end.a}, run).converged) return true;
  if (end.content) search.offer(end.p, end.a, residual, true);
  return end.content;
}

}  // namespace

StageEnd interior_stage(Search& search) {
  const Problem& problem = search.problem();
  const bool cones = may_take_interior_points(problem), plane = may_take_plane_interior_points(problem);
  if (!cones && !plane) return {false, "interior points need a matrix W that can be factorised"};
  const double force = Measure(problem).reference();
  std::optional<Point> bonded;
  if (!cones && problem.G.cols() > 0) bonded = bonded_start(problem, search.touching());
  const Point near = bonded ? *bonded : search.start();
  int steps = 0;
  for (const double start : starts) {
    InteriorPointEnd end =
        cones ? interior_points(problem, search.judge(), search.options().deadline, start)
              : PlaneInteriorPoints(problem, near.p, near.a, start).advance(1e-8, search.judge(), search.options().deadline);
    search.add_trace(std::move(end.trace), end.iterations, force);
    steps += end.iterations;
    if (crossed_over(search, std::move(end)) || search.late()) break;
  }
  if (cones && !search.solved() && !search.late()) {
    HeldSlips held(problem);
    double aim = 1e-5;
    while (!search.solved() && !search.late()) {
      InteriorPointEnd end = held.advance(aim, most_rounds, HUGE_VAL, search.judge(), search.options().deadline);
      search.add_trace(std::move(end.trace), end.iterations, force);
      const double reached = end.residual;
      if (crossed_over(search, std::move(end)) || reached > aim) break;
      aim = 0.1 * reached;
    }
  }
  return {search.solved(), "interior points ended after " + std::to_string(steps) + " steps"};
}

}  // namespace scabo::contact
