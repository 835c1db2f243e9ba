#include <functional>
#include <optional>
#include <utility>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/newton/bonded_start.hpp"
#include "scabo/contact/newton/coarse_start.hpp"
#include "scabo/contact/newton/kept_states.hpp"
#include "scabo/contact/stages.hpp"

namespace scabo::contact {

namespace {

std::string why_of(const NewtonEnd& end, const Search& search) {
  if (search.late()) return "Newton's method was ended by its limit";
  if (end.singular) return "Newton's method found no direction in which the forces balance the loads";
  return "Newton's method stalled after " + std::to_string(end.iterations) + " iterations";
}

/// Newton's method. At crack tips forces and gaps are as small as |H|: where the states of many pairs still change at
/// its end, once more from where these stick.
NewtonEnd newton_until_settled(Search& search, Point from, const NewtonRun& run) {
  NewtonEnd end = search.newton_from(std::move(from), run);
  if (!end.converged || end.trace.back().states_changed == 0) return end;
  if (std::optional<Point> stuck = with_undecided_stuck(search.equations(), {end.p, end.a}))
    search.newton_from(*std::move(stuck), run);
  return end;
}

/// A start that took a factorisation of its own.
Point counted(Search& search, Point start) {
  search.add_trace({}, 1);
  return start;
}

/// From the last increment: of a body that contact alone holds first with the states as they were (kept_states.hpp).
/// Whether that ends the search, as `done` says of each start.
bool from_history(Search& search, const std::function<bool(Point, const char*)>& done) {
  const bool floats = search.problem().G.cols() > 0;
  const BDifferentiableEquations equations = search.equations();
  std::optional<Point> kept;
  if (floats) kept = with_states_kept(equations, search.start());
  if (kept && done(counted(search, *std::move(kept)), "newton from states kept")) return true;
  if (done(search.start(), "newton")) return true;
  if (!floats) kept = with_states_kept(equations, search.start());
  return !floats && kept && done(counted(search, *std::move(kept)), "newton from states kept");
}

/// Where nothing presses, no force is the solution.
bool is_solved_at_rest(Search& search) {
  const Point& rest = search.start();
  if (search.has_history() || !search.accepts(rest.p, rest.a, motion_of(search.problem(), rest.p, rest.a)))
    return false;
  search.offer(rest.p, rest.a, search.residual_at(rest.p, rest.a), true);
  return true;
}

}  // namespace

StageEnd newton_stage(Search& search) {
  const Problem& problem = search.problem();
  if (is_solved_at_rest(search)) return {true, {}};
  const int patience = may_take_interior_points(problem) ? newton_constants.patience : 0;
  NewtonEnd end;
  const auto done = [&](Point from, const char* stage) {
    end = newton_until_settled(search, std::move(from), {stage, 0, patience});
    return end.converged || search.late();
  };
  if (search.has_history() && from_history(search, done)) return {end.converged, why_of(end, search)};
  if (std::optional<CoarseStart> coarse = coarse_start(problem, search.start().a)) {
    search.add_coarse(std::move(coarse->trace), coarse->iterations);
    if (done(std::move(coarse->point), "newton from fewer pairs")) return {end.converged, why_of(end, search)};
  }
  if (problem.G.cols() > 0 || problem.W.bodies() != nullptr)
    if (std::optional<Point> bonded = bonded_start(problem, search.touching()))
      if (done(counted(search, *std::move(bonded)), "newton from bonded pairs"))
        return {end.converged, why_of(end, search)};
  done({Vector::Zero(problem.q.size()), search.start().a}, "newton from zero");
  return {end.converged, why_of(end, search)};
}

}  // namespace scabo::contact
