#include "scabo/contact/newton/coarse_start.hpp"

#include <utility>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/newton/bonded_start.hpp"
#include "scabo/contact/newton/coarse_problem.hpp"

namespace scabo::contact {

namespace {

/// Newton on `problem` from `start`; its best iterate replaces it. False where that is not finite.
bool solve_loosely(const Problem& problem, CoarseStart& start) {
  NewtonOptions options;
  options.relative = newton_constants.coarse_aim;
  options.iterations = problem.G.cols() > 0 ? newton_constants.of_floating : newton_constants.of_held;
  options.stage = "newton, " + std::to_string(problem.pairs()) + " pairs";
  NewtonEnd end =
      newton(BDifferentiableEquations(problem, 1.0), std::move(start.point.p), std::move(start.point.a), options);
  for (Iteration& iteration : end.trace) {
    iteration.iteration += start.iterations;
    start.trace.push_back(std::move(iteration));
  }
  start.iterations += end.iterations;
  start.point = {std::move(end.p), std::move(end.a)};
  return start.point.p.allFinite() && start.point.a.allFinite();
}

}  // namespace

std::optional<CoarseStart> coarse_start(const Problem& problem, const Vector& a) {
  if (problem.dimension != 2 || !problem.W.is_dense() || problem.pairs() < newton_constants.least_pairs ||
      problem.G.cols() > system_constants.motions_of_one_body)
    return std::nullopt;
  const CoarseProblem coarse = coarse_problem(problem);
  if (4 * coarse.problem.pairs() > 3 * problem.pairs()) return std::nullopt;
  std::optional<CoarseStart> start = coarse_start(coarse.problem, a);
  if (!start) {
    start.emplace();
    const std::optional<Point> bonded = problem.G.cols() > 0 ? bonded_start(coarse.problem, {}) : std::nullopt;
    start->point = bonded.value_or(Point{Vector::Zero(coarse.problem.q.size()), a});
  }
  if (!solve_loosely(coarse.problem, *start)) return std::nullopt;
  // What nothing moves may have any force: none, because it would be a tie at the bound of friction.
  start->point.p = (problem.W.diagonal().array() > 0.0).select(coarse.prolong(start->point.p), 0.0);
  return start;
}

}  // namespace scabo::contact
