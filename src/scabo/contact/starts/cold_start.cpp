#include "scabo/contact/starts/cold_start.hpp"

#include "scabo/contact/starts/coarse_problem.hpp"
#include "scabo/contact/starts/gauss_seidel.hpp"
#include "scabo/contact/newton.hpp"
#include "scabo/contact/rigid_motions.hpp"

namespace scabo::contact {

namespace {

constexpr int sweeps_from_zero = 30, sweeps_after = 3;

/// Sweeps from start.p with the bodies held at start.a.
void sweep(const Problem& problem, int sweeps, ColdStart& start) {
  if (problem.G.cols() == 0) {
    start.p = gauss_seidel(problem, std::move(start.p), sweeps);
    return;
  }
  constexpr double soft = 0.7;
  start.p = gauss_seidel(held_at(problem, start.a, soft), std::move(start.p), sweeps);
  start.a += (problem.G.transpose() * start.p + problem.f) / soft;
}

/// Newton on the problem of fewer pairs from its own start, which is extended; the best iterate is sufficient.
bool solve_loosely(const Problem& coarse, ColdStart& start) {
  NewtonOptions options;
  options.small = 5e-2 * start.p.lpNorm<Eigen::Infinity>();
  options.iterations = 3;
  options.stage = "newton, " + std::to_string(coarse.pairs()) + " pairs";
  NewtonEnd end = newton(BDifferentiableEquations(coarse, 1.0), std::move(start.p), std::move(start.a), options);
  for (Iteration& iteration : end.trace) {
    iteration.iteration += start.coarse_iterations;
    start.trace.push_back(std::move(iteration));
  }
  start.coarse_iterations += end.iterations;
  start.p = std::move(end.p);
  start.a = std::move(end.a);
  return start.p.allFinite() && start.a.allFinite();
}

}  // namespace

ColdStart swept_start(const Problem& problem, const Vector& a) {
  ColdStart start{Vector::Zero(problem.q.size()), a, 0, {}};
  sweep(problem, sweeps_from_zero, start);
  return start;
}

ColdStart nested_start(const Problem& problem, const Vector& a) {
  if (!may_nest(problem)) return swept_start(problem, a);
  const CoarseProblem coarse = coarse_problem(problem);
  if (4 * coarse.problem.pairs() > 3 * problem.pairs()) return swept_start(problem, a);
  ColdStart start = nested_start(coarse.problem, a);
  if (solve_loosely(coarse.problem, start)) {
    start.p = coarse.prolong(start.p);
    sweep(problem, sweeps_after, start);
    return start;
  }
  ColdStart swept = swept_start(problem, a);
  swept.coarse_iterations = start.coarse_iterations;
  swept.trace = std::move(start.trace);
  return swept;
}

bool may_nest(const Problem& problem) {
  constexpr int least = 48;
  return problem.dimension == 2 && problem.W.is_dense() && problem.pairs() >= least;
}

}  // namespace scabo::contact
