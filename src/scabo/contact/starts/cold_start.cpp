#include "scabo/contact/starts/cold_start.hpp"

#include <optional>

#include "scabo/contact/newton.hpp"
#include "scabo/contact/newton_direction.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/starts/bonded_start.hpp"
#include "scabo/contact/starts/coarse_problem.hpp"
#include "scabo/contact/starts/gauss_seidel.hpp"
#include "scabo/contact/starts/sampled_problem.hpp"

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
struct Loosely {
  bool finite = false, converged = false;
  double residual = 0.0;  ///< relative to the largest force of the start
};
Loosely solve_loosely(const Problem& coarse, ColdStart& start) {
  // What is wrong with a floating body on few pairs stays wrong on more, and iterations on few pairs cost little.
  constexpr int of_held = 3, of_floating = 10;
  const double force = start.p.lpNorm<Eigen::Infinity>();
  NewtonOptions options;
  options.small = 5e-2 * force;
  options.iterations = coarse.G.cols() > 0 ? of_floating : of_held;
  options.stage = "newton, " + std::to_string(coarse.pairs()) + " pairs";
  NewtonEnd end = newton(BDifferentiableEquations(coarse, 1.0), std::move(start.p), std::move(start.a), options);
  for (Iteration& iteration : end.trace) {
    iteration.iteration += start.coarse_iterations;
    start.trace.push_back(std::move(iteration));
  }
  start.coarse_iterations += end.iterations;
  start.p = std::move(end.p);
  start.a = std::move(end.a);
  return {start.p.allFinite() && start.a.allFinite(), end.converged, force > 0.0 ? end.residual / force : 0.0};
}

/// Sweeps may leave a floating body where all pairs slip and Newton has no direction; forces of pairs that are all held
/// then are the better start. Of few pairs they cost little.
Loosely solve_from_either(const Problem& coarse, ColdStart& start) {
  constexpr int few = 400;
  const Loosely swept = solve_loosely(coarse, start);
  if (swept.converged || coarse.G.cols() == 0 || coarse.pairs() > few) return swept;
  std::optional<BondedStart> held = bonded_start(coarse, {});
  if (!held) return swept;
  ColdStart other{std::move(held->p), std::move(held->a), start.coarse_iterations, start.trace};
  const Loosely bonded = solve_loosely(coarse, other);
  start.coarse_iterations = other.coarse_iterations;
  start.trace = other.trace;
  if (!bonded.finite || (swept.finite && bonded.residual >= swept.residual)) return swept;
  start = std::move(other);
  return bonded;
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
  if (solve_from_either(coarse.problem, start).finite) {
    start.p = coarse.prolong(start.p);
    // Sweeps of a floating body go with soft springs, which shift it, the more so the more pairs there are.
    constexpr int most_swept = 300;
    if (problem.G.cols() == 0 || problem.pairs() <= most_swept) sweep(problem, sweeps_after, start);
    return start;
  }
  ColdStart swept = swept_start(problem, a);
  swept.coarse_iterations = start.coarse_iterations;
  swept.trace = std::move(start.trace);
  return swept;
}

namespace {

/// The branch of pair i becomes `branch`, and H what it is there: b_differentiable.hpp, away from ties.
void impose(const BDifferentiableEquations& equations, const Vector& p, Eigen::Index i, Branch branch, Residual& at) {
  const Problem& problem = equations.problem();
  const Eigen::Index n = 2 * i, t = n + 1;
  branch.normal_tie = branch.edge = branch.tip = branch.bound_tie = false;
  if (!branch.contact) {
    branch.tangent = Branch::Tangent::free;
    branch.slope = 0.0;
  }
  at.H[n] = branch.contact ? equations.r()[n] * at.motion[n] : p[n] + problem.tension_of(i);
  at.H[t] = p[t];
  if (branch.tangent == Branch::Tangent::stick) at.H[t] = equations.r()[t] * at.motion[t];
  if (branch.tangent == Branch::Tangent::slip)
    at.H[t] -= (problem.cohesion_of(i) + branch.slope * p[n]) * branch.along[0];
  at.branches[static_cast<std::size_t>(i)] = branch;
}

}  // namespace

std::optional<ColdStart> sampled_start(const Problem& problem, const Vector& a) {
  constexpr int most = 1500;
  const std::optional<SampledProblem> sampled = sampled_problem(problem, most);
  if (!sampled) return std::nullopt;
  ColdStart start = nested_start(sampled->problem, a);
  if (!solve_from_either(sampled->problem, start).finite) return std::nullopt;
  const Residual few = BDifferentiableEquations(sampled->problem, 1.0).residual(start.p, start.a);
  start.p = sampled->spread(start.p);
  const BDifferentiableEquations equations(problem, 1.0);
  Residual at = equations.residual(start.p, start.a);
  for (Eigen::Index i = 0; i < problem.pairs(); ++i)
    impose(equations, start.p, i, few.branches[static_cast<std::size_t>(sampled->nearest(i))], at);
  Vector d;
  if (NewtonDirection(equations).find(start.p, at, 0.0, NewtonDirection::Ties::as_d_takes_them, d)) {
    start.p += d.head(start.p.size());
    start.a += d.tail(start.a.size());
  }
  return start;
}

bool may_nest(const Problem& problem) {
  constexpr int least = 48;
  return problem.dimension == 2 && problem.W.is_dense() && problem.pairs() >= least;
}

}  // namespace scabo::contact
